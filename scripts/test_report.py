# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Reports the results of ctest runs: failures, skips, the slowest tests, counts. usage: test_report.py NAME=BUILD_FOLDER…

Each folder holds junit.xml and Testing/Temporary/LastTest.log of its run. Each case of GoogleTest and unittest counts as one
test; any other CTest entry counts as one. The exit code is 1 if a test failed or nothing ran. Time alone fails nothing."""
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SLOWEST = 20
SLOW_S = 30.0  # entries above this are marked; time alone fails no test

BLOCK = re.compile(r'^\d+/\d+ Testing: (?P<name>.+?)$(?P<body>.*?)^"[^"\n]*" end time:', re.MULTILINE | re.DOTALL)
CASE = re.compile(r"^\[ +(OK|FAILED|SKIPPED) +\] (?P<case>[\w/]+\.[\w/]+)(?:,.*)? \(\d+ ms\)$", re.MULTILINE)
SKIP_MESSAGE = re.compile(r"^\S+:\d+: Skipped\n(?P<message>.*?)\n*^\[  SKIPPED \] (?P<case>\S+) \(\d+ ms\)", re.MULTILINE | re.DOTALL)
PYTHON_RUN = re.compile(r"^Ran (\d+) tests? in ", re.MULTILINE)
PYTHON_SKIP = re.compile(r"^SKIPPED: (.*)$", re.MULTILINE)
PYTHON_FAULTS = re.compile(r"^FAILED \((.*)\)$", re.MULTILINE)


class Tally:
    def __init__(self):
        self.passed = self.failed = 0
        self.failures, self.skips, self.times = [], [], []


def outputs(folder):
    """The output of each test by name; of a test that ran more than once, the last output."""
    log = folder / "Testing" / "Temporary" / "LastTest.log"
    text = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    return {match["name"].strip(): match["body"] for match in BLOCK.finditer(text)}


def count_cases(output):
    """(passed, failed, skipped with reasons) of the cases in a test's output; None if it contains no cases."""
    cases = [(match[1], match["case"]) for match in CASE.finditer(output)]
    if cases:
        reasons = {match["case"]: " ".join(match["message"].split()) for match in SKIP_MESSAGE.finditer(output)}
        skipped = [f"{case}: {reasons.get(case, 'no reason given')}" for state, case in cases if state == "SKIPPED"]
        states = [state for state, _ in cases]
        return states.count("OK"), states.count("FAILED"), skipped
    ran = PYTHON_RUN.search(output)
    if not ran:
        return None
    skipped = PYTHON_SKIP.findall(output)
    faults = PYTHON_FAULTS.search(output)
    failed = sum(int(n) for n in re.findall(r"(?:failures|errors)=(\d+)", faults[1])) if faults else 0
    return int(ran[1]) - failed - len(skipped), failed, skipped


def add_test(tally, run, case, output):
    name = f"{run}: {case.get('name')}"
    seconds = float(case.get("time") or 0.0)
    status = case.get("status")
    skip = case.find("skipped")
    counted = count_cases(output)
    if counted is None:
        skipped = [(skip.get("message") or "skipped") if skip is not None else "did not run"] if status in ("notrun", "disabled") else []
        counted = (0 if skipped or status == "fail" else 1, 0, skipped)
    passed, failed, skipped = counted
    if status == "fail" or (skip is not None and "Unable to find" in (skip.get("message") or "")):
        failed = max(failed, 1)  # the process may have died between two cases
        tally.failures.append((name, output))
    tally.passed += passed
    tally.failed += failed
    tally.skips += [f"{name}: {reason}" for reason in skipped]
    tally.times.append((seconds, name))


def tail(text, lines=40):
    return "\n".join(text.strip().splitlines()[-lines:])


def report(tally):
    print(f"slowest {min(SLOWEST, len(tally.times))}:")
    for seconds, name in sorted(tally.times, reverse=True)[:SLOWEST]:
        print(f"  {seconds:7.2f} s  {name}{'  (slow)' if seconds > SLOW_S else ''}")
    for skip in tally.skips:
        print(f"skipped {skip}")
    for name, output in tally.failures:
        print(f"FAILED {name}")
        if output:
            print(tail(output))
    print(f"{tally.passed} passed, {tally.failed} failed, {len(tally.skips)} skipped")


def main(arguments):
    tally = Tally()
    for argument in arguments:
        run, _, folder = argument.partition("=")
        texts = outputs(Path(folder))
        for case in ElementTree.parse(Path(folder) / "junit.xml").getroot().iter("testcase"):
            add_test(tally, run, case, texts.get(case.get("name"), ""))
    if not tally.times:
        print("no test was run")
    report(tally)
    return 1 if tally.failed or not tally.times else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
