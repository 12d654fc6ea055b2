# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Base of the program's tests: runs the program and checks what holds for every run."""
import json
import os
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


class ProgramCase(unittest.TestCase):
    program = ""
    source = Path()

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gloam-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, env=None, prefix=(), stdin=subprocess.DEVNULL, timeout=280):
        """Runs the program in the test's folder, which starts empty. A failure must print exactly one error line."""
        environment = dict(os.environ, XDG_CACHE_HOME=CACHE.name, **(env or {}))
        environment.pop("GLOAM_LOG", None)
        run = subprocess.run([*prefix, self.program, *map(str, arguments)], cwd=self.folder, env=environment, stdin=stdin,
                             capture_output=True, text=True, timeout=timeout, check=False)
        errors = [line for line in run.stderr.splitlines() if not line.startswith("gloam: warning: ")]
        if run.returncode == 0:
            self.assertEqual(errors, [], f"{arguments}: an error line without a failure")
        else:
            self.assertEqual(len(errors), 1, f"{arguments}: not one error line: {run.stderr!r}")
            self.assertRegex(errors[0], r"^gloam: error: \S.*\S$")
        return run

    def expect(self, code, *arguments, says="", **options):
        run = self.run_program(*arguments, **options)
        self.assertEqual(run.returncode, code, f"{arguments}: {run.stdout!r} {run.stderr!r}")
        self.assertIn(says, run.stdout + run.stderr, str(arguments))
        return run

    def read_json(self, name):
        with open(self.folder / name, encoding="utf-8") as file:
            return json.load(file)

    def require_device(self):
        """Skips the test if no Vulkan device is usable."""
        run = self.run_program("render", "builtin:plain", "--size", "16x16", "--out", "probe.png")
        if run.returncode == NO_DEVICE:
            self.skipTest(run.stderr.strip())
        self.assertEqual(run.returncode, 0, run.stderr)


def main():
    """usage: TEST.py PROGRAM SOURCE_FOLDER"""
    ProgramCase.program, ProgramCase.source = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    for test, reason in result.skipped:
        print(f"SKIPPED: {test.id()}: {reason}")
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if result.testsRun == len(result.skipped) else 0)
