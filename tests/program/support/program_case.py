# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Base of the program's tests: runs the program and checks what holds for every run."""
import json
import os
import select
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NO_DEVICE = 4
SKIPPED = 77
LONG = bool(os.environ.get("GLOAM_LONG_TESTS"))  # all cases of tests that draw a share of them otherwise
# Shared by all runs of a test file, so that each pipeline is compiled once.
CACHE = tempfile.TemporaryDirectory(prefix="gloam-test-cache-")


class ManyRuns:
    """The program gloam_many_runs: runs command lines one after the other in one process, on one device."""

    def __init__(self, program, env):
        self.folder = tempfile.TemporaryDirectory(prefix="gloam-many-")
        self.process = subprocess.Popen([program.with_name("gloam_many_runs")], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env=env, text=True)

    def run(self, arguments, folder, timeout):
        """As subprocess.run. A run that ends the process has the process's return code."""
        streams = [Path(self.folder.name) / name for name in ("stdout", "stderr")]
        print(*map(str, (folder, *streams, *arguments)), sep="\x1f", file=self.process.stdin, flush=True)
        if not select.select([self.process.stdout], [], [], timeout)[0]:
            self.close()
            raise subprocess.TimeoutExpired(arguments, timeout)
        answer = self.process.stdout.readline()
        code = int(answer) if answer else self.process.wait()
        return subprocess.CompletedProcess(arguments, code, *(stream.read_text(encoding="utf-8") for stream in streams))

    def ended(self):
        return self.process.poll() is not None

    def close(self):
        self.process.kill()
        self.process.communicate()
        self.folder.cleanup()


class ProgramCase(unittest.TestCase):
    program = ""
    source = Path()
    shares_process = False  # the plain runs of `render` share a process, its device and its compiled pipelines
    many_runs = {}  # by the environment that a test adds
    probe = None  # the run by which require_device found out whether there is a device

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gloam-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, env=None, prefix=(), stdin=subprocess.DEVNULL, timeout=280):
        """Runs the program in the test's folder, which starts empty. A failure must print exactly one error line."""
        environment = dict(os.environ, XDG_CACHE_HOME=CACHE.name, **(env or {}))
        environment.pop("GLOAM_LOG", None)
        if self.shares_process and arguments[0] == "render" and not prefix and stdin == subprocess.DEVNULL:
            run = self.run_in_shared_process(arguments, environment, timeout)
        else:
            run = subprocess.run([*prefix, self.program, *map(str, arguments)], cwd=self.folder, env=environment, stdin=stdin,
                                 capture_output=True, text=True, timeout=timeout, check=False)
        errors = [line for line in run.stderr.splitlines() if not line.startswith("gloam: warning: ")]
        if run.returncode == 0:
            self.assertEqual(errors, [], f"{arguments}: an error line without a failure")
        else:
            self.assertEqual(len(errors), 1, f"{arguments}: not one error line: {run.stderr!r}")
            self.assertRegex(errors[0], r"^gloam: error: \S.*\S$")
        return run

    def run_in_shared_process(self, arguments, environment, timeout):
        key = tuple(sorted(environment.items()))
        if key in self.many_runs and self.many_runs[key].ended():
            self.many_runs.pop(key).close()
        if key not in self.many_runs:
            self.many_runs[key] = ManyRuns(Path(self.program), environment)
        return self.many_runs[key].run(arguments, self.folder, timeout)

    def expect(self, code, *arguments, says="", **options):
        run = self.run_program(*arguments, **options)
        self.assertEqual(run.returncode, code, f"{arguments}: {run.stdout!r} {run.stderr!r}")
        self.assertIn(says, run.stdout + run.stderr, str(arguments))
        return run

    def read_json(self, name):
        with open(self.folder / name, encoding="utf-8") as file:
            return json.load(file)

    def require_device(self):
        """Skips the test if no Vulkan device is usable. One run of the program finds out, for all tests of a file."""
        if ProgramCase.probe is None:
            shared, self.shares_process = self.shares_process, False
            ProgramCase.probe = self.run_program("render", "builtin:plain", "--size", "16x16", "--out", "probe.png")
            self.shares_process = shared
        run = ProgramCase.probe
        if run.returncode == NO_DEVICE:
            self.skipTest(run.stderr.strip())
        self.assertEqual(run.returncode, 0, run.stderr)


def main():
    """usage: TEST.py PROGRAM SOURCE_FOLDER"""
    ProgramCase.program, ProgramCase.source = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    for shared in ProgramCase.many_runs.values():
        shared.close()
    for test, reason in result.skipped:
        print(f"SKIPPED: {test.id()}: {reason}")
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if result.testsRun == len(result.skipped) else 0)
