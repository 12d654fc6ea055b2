# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Four processes use one cache folder at once: while it is empty, while all write it, and when it is full. All show the same
picture and say nothing, and what they leave behind is whole: a later process reads it."""
import os
import subprocess

from program_case import CACHE, ProgramCase, main

PROCESSES = 4
SCENE = ("builtin:smoke", "--size", "64x36", "--quiet")  # has captures, light of particles and pipelines in the cache


class SharedCache(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        self.cache = self.folder / "cache"

    def draw_at_once(self, count):
        """The pictures of processes that begin at the same time."""
        environment = dict(os.environ, XDG_CACHE_HOME=CACHE.name)
        runs = [subprocess.Popen([self.program, "render", *SCENE, "--cache-dir", self.cache, "--out", f"{i}.png"],
                                 cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True) for i in range(count)]
        for run in runs:
            output, errors = run.communicate(timeout=280)
            self.assertEqual((run.returncode, output, errors), (0, "", ""))
        return [(self.folder / f"{i}.png").read_bytes() for i in range(count)]

    def files(self):
        return {str(path.relative_to(self.cache)): path.stat().st_size for path in self.cache.rglob("*") if path.is_file()}

    # Hard case: passes.shared_cache
    def test_four_processes_share_it(self):
        cold = self.draw_at_once(PROCESSES)
        files = self.files()
        self.assertGreater(len(files), 1)
        self.assertEqual([name for name in files if ".tmp" in name or "partial" in name], [], "unfinished files are left")
        warm = self.draw_at_once(PROCESSES)
        self.assertEqual(self.files().keys(), files.keys())
        later = self.draw_at_once(1)
        self.assertEqual(set(cold + warm + later), {later[0]}, "the pictures differ")


if __name__ == "__main__":
    main()
