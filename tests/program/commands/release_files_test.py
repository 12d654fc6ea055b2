# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests what a release adds to the program: completion in bash, and manual pages."""
import os
import re
import shutil
import subprocess

from program_case import ProgramCase, main

COMPLETE = """
source "$1"
COMP_LINE=$2 COMP_POINT=${#2} COMPREPLY=()
_gloam "$3"
printf '%s\\n' "${COMPREPLY[@]}"
"""


class ReleaseFiles(ProgramCase):
    def completions(self, line):
        run = subprocess.run(["bash", "-c", COMPLETE, "bash", self.source / "scripts/completion.bash", line, self.program],
                             capture_output=True, text=True, check=True, env=dict(os.environ, VK_ICD_FILENAMES="/nonexistent"))
        return run.stdout.split()

    def test_completion_knows_commands_options_scenes_knobs_and_values(self):
        self.assertEqual(self.completions("gloam rend"), ["render"])
        self.assertIn("selftest", self.completions("gloam "))
        self.assertEqual(self.completions("gloam render --cam"), ["--camera"])
        self.assertEqual(self.completions("gloam render builtin:wet"), ["wet_street"])  # readline keeps `builtin:`
        self.assertIn("shadows.filter=", self.completions("gloam render builtin:plain --set shadows.fil"))
        self.assertEqual(self.completions("gloam render builtin:plain --set shadows.filter=p"), ["pcf", "pcss"])
        self.assertEqual(self.completions("gloam render builtin:nothing"), [])

    def test_manual_pages_hold_every_command_and_option(self):
        if shutil.which("help2man") is None:
            self.skipTest("help2man is not installed (scripts/packages-dev.txt)")
        subprocess.run([self.source / "scripts/manual.sh", self.program, "manual"], cwd=self.folder, check=True)
        pages = {path.stem: path.read_text(encoding="utf-8").replace("\\-", "-") for path in self.folder.glob("manual/*.1")}
        help_text = self.expect(0, "--help").stdout
        commands = re.findall(r"^  ([a-z]+) ", help_text.partition("Subcommands:")[2], re.M)
        self.assertGreaterEqual(len(commands), 10)
        self.assertEqual(set(pages), {"gloam", *("gloam-" + command for command in commands)})
        for command in commands:
            self.assertIn(command, pages["gloam"])
            for option in re.findall(r"^  (?:-h,)?(--[a-z-]+)", self.expect(0, command, "--help").stdout, re.M):
                self.assertIn(option, pages["gloam-" + command])


if __name__ == "__main__":
    main()
