# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Files that the program writes: to the standard streams, and on a disk that is full."""
import json
import os
import resource
import signal
import subprocess

from program_case import CACHE, ProgramCase, main

SMALL = ("render", "builtin:plain", "--size", "16x16")
PNG = b"\x89PNG\r\n\x1a\n"


class OutputFiles(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def run_bytes(self, *arguments, **options):
        return subprocess.run([self.program, *SMALL, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=dict(os.environ, XDG_CACHE_HOME=CACHE.name), timeout=280, check=False, **options)

    # Hard case: program.streams
    def test_standard_streams_receive_the_data(self):
        (self.folder / "out.json").symlink_to("/dev/stdout")
        (self.folder / "errors.json").symlink_to("/dev/stderr")
        (self.folder / "twice.json").symlink_to("out.json")
        for path, stream in (("/dev/stdout", "stdout"), ("/dev/stderr", "stderr"), ("/dev/fd/1", "stdout"), ("/proc/self/fd/2", "stderr"),
                             ("out.json", "stdout"), ("errors.json", "stderr"), ("twice.json", "stdout")):
            with self.subTest(path):
                run = self.run_bytes("--out", "p.png", "--stats", path, "--quiet")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(json.loads(getattr(run, stream))["version"], 1)
        self.assertTrue((self.folder / "out.json").is_symlink())

    # Hard case: program.streams
    def test_standard_output_receives_pictures(self):
        (self.folder / "out.png").symlink_to("/dev/stdout")
        for path in ("/dev/stdout", "out.png"):
            for view in ("none", "normal"):
                run = self.run_bytes("--out", path, "--view", view, "--quiet")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertTrue(run.stdout.startswith(PNG), run.stdout[:80])

    def test_a_redirected_stream_holds_everything_once(self):
        with open(self.folder / "all.txt", "wb") as file:
            run = subprocess.run([self.program, *SMALL, "--out", "p.png", "--stats", "/dev/stdout", "--pick", "3,3"], cwd=self.folder,
                                 stdout=file, stderr=subprocess.PIPE, env=dict(os.environ, XDG_CACHE_HOME=CACHE.name), timeout=280, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        text = (self.folder / "all.txt").read_text(encoding="utf-8")
        self.assertEqual(text.count('"version": 1'), 1)
        self.assertIn("pixel 3,3", text)

    # Hard case: program.closed_stream
    def test_a_closed_stream_is_an_error(self):
        run = subprocess.run(["sh", "-c", 'exec "$@" >&-', "sh", self.program, *SMALL, "--out", "p.png", "--stats", "/dev/stdout"],
                             cwd=self.folder, stderr=subprocess.PIPE, text=True, env=dict(os.environ, XDG_CACHE_HOME=CACHE.name), timeout=280,
                             check=False)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("/dev/stdout: cannot be written", run.stderr)

    # Hard case: program.full_disk
    def test_a_full_disk_leaves_old_files_whole_and_nothing_else(self):
        names = {"p.png": "--out", "p.exr": "--out", "s.json": "--stats", "t.json": "--trace"}
        for name in names:
            (self.folder / name).write_text("old", encoding="utf-8")

        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

        for name, option in names.items():
            with self.subTest(name):
                picture = () if option == "--out" else ("--out", "/dev/stdout")
                run = self.run_bytes(option, name, *picture, preexec_fn=limit_files)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertEqual((self.folder / name).read_text(encoding="utf-8"), "old")
        left = {path.name for path in self.folder.rglob("*") if path.is_file()} - {"probe.png"}
        self.assertEqual(left, set(names))

    def test_seconds_have_a_decimal_point(self):
        self.expect(2, *SMALL, "--time", "1,5", says="--time wants a finite number of seconds, not '1,5'")
        self.expect(2, *SMALL, "--dt", "", says="--dt wants a finite number of seconds, not ''")


if __name__ == "__main__":
    main()
