# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""In a locale with decimal commas, which a library or a host may set, the program reads and writes points."""
import os
import shutil
import subprocess

from program_case import ProgramCase, main

SETTER = """
#include <locale>
#include <cstdio>
__attribute__((constructor)) static void set() {
  std::locale::global(std::locale("de_DE.UTF-8"));
  char text[8];
  std::snprintf(text, sizeof text, "%.1f", 0.5);
  if (text[1] != ',') std::abort();
}
"""


class Locale(ProgramCase):
    def setUp(self):
        super().setUp()
        compiler = os.environ.get("CXX") or shutil.which("g++")
        if not compiler or not shutil.which("localedef"):
            self.skipTest("there is no compiler or no localedef")
        (self.folder / "setter.cpp").write_text("#include <cstdlib>\n" + SETTER, encoding="utf-8")
        built = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.folder / "de_DE.UTF-8"], check=False, capture_output=True)
        if built.returncode != 0:
            self.skipTest("the sources of locales are absent")
        subprocess.run([compiler, "-shared", "-fPIC", "setter.cpp", "-o", "setter.so"], cwd=self.folder, check=True)
        self.commas = {"LD_PRELOAD": str(self.folder / "setter.so"), "LOCPATH": str(self.folder)}

    def test_tables_and_errors_are_the_same(self):
        for arguments in (("knobs",), ("knobs", "--json"), ("knobs", "--markdown"), ("inspect", "builtin:shadows"),
                          ("inspect", "builtin:shadows", "--json"), ("render", "builtin:plain", "--set", "shadows.bias_mm=50.25"),
                          ("play", "builtin:plain", "--scale", "1.5"), ("render", "builtin:plain", "--time", "1,5")):
            with self.subTest(arguments):
                plain, commas = self.run_program(*arguments), self.run_program(*arguments, env=self.commas)
                self.assertEqual((commas.returncode, commas.stdout, commas.stderr), (plain.returncode, plain.stdout, plain.stderr))

    def test_pictures_and_statistics_are_the_same(self):
        self.require_device()
        stats = []
        for env in (None, self.commas):
            run = self.expect(0, "render", "builtin:shadows", "--size", "64x36", "--time", "1.5", "--dt", "0.25", "--frames", "2", "--set",
                              "shadows.texels_per_pixel=0.5", "--pick", "30,20", "--out", "p.png", "--stats", "s.json", env=env)
            stats.append((run.stdout, self.read_json("s.json")["knobs"], (self.folder / "p.png").read_bytes()))
        self.assertEqual(stats[0], stats[1])
        self.assertRegex(stats[1][0], r"view depth \d+\.\d+ m")


if __name__ == "__main__":
    main()
