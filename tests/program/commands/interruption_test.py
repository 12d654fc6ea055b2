# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Places that cannot be written, and signals: the documented code, one line, and no file that is not whole."""
import os
import resource
import signal
import subprocess
import time

from program_case import CACHE, ProgramCase, main
from rgb_picture import Picture

SMALL = ("--size", "16x16")
# Every command that writes a file, with @ for the folder. `bench` and `bake --fit-proxies` need no device.
WRITERS = {
    "picture": ("render", "builtin:plain", *SMALL, "--out", "@/p.png"),
    "light": ("render", "builtin:plain", *SMALL, "--out", "@/p.exr"),
    "frames": ("render", "builtin:plain", *SMALL, "--frames", "2", "--out", "@/p_%02d.png"),
    "stats": ("render", "builtin:plain", *SMALL, "--out", "/dev/stdout", "--stats", "@/s.json"),
    "trace": ("render", "builtin:plain", *SMALL, "--out", "/dev/stdout", "--trace", "@/t.json"),
    "cost": ("cost", "builtin:plain", *SMALL, "--quick", "--points", "0", "--knobs", "lighting.tone_map", "--out", "@/ledger"),
    "bench": ("bench", "jobs.empty", "--json", "@/b.json"),
    "selftest": ("selftest", "--quick", "--only", "kernel.srgb*", "--out", "@/report"),
    "bake": ("bake", "builtin:plain", "--fit-proxies", "1", "--out", "@/fit.json"),
    "log": ("scenes", ),  # with GLOAM_LOG
}
# Where a write fails for every user: below a file, and in a file system of the kernel.
FAILING = ("afile", "/proc/1")
PNG_END = b"IEND\xaeB`\x82"


def limit_files():
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))


class Interruption(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def environment(self, **more):
        return dict(os.environ, XDG_CACHE_HOME=CACHE.name, **more)

    def write_to(self, writer, folder, **options):
        """Runs a command whose files cannot be written: 1, one line of error."""
        env = self.environment(**({"GLOAM_LOG": f"{folder}/log.txt"} if writer == "log" else {}))
        arguments = [word.replace("@", folder) for word in WRITERS[writer]]
        run = subprocess.run([self.program, *arguments], cwd=self.folder, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True, timeout=280, check=False, **options)
        self.assertEqual(run.returncode, 1, run.stderr)
        errors = [line for line in run.stderr.splitlines() if not line.startswith("gloam: warning: ")]
        self.assertEqual(len(errors), 1, run.stderr)
        self.assertRegex(errors[0], r"^gloam: error: \S.*(cannot be (written|made)).*: \S")

    def left(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file() and path.name != "probe.png")

    # Hard case: program.failing_writes
    def test_a_place_that_cannot_be_written_is_1_for_every_command(self):
        (self.folder / "afile").write_text("a file", encoding="utf-8")
        for index, writer in enumerate(WRITERS):
            folder = FAILING[index % len(FAILING)]
            with self.subTest(f"{writer} in {folder}"):
                self.write_to(writer, folder)
        self.assertEqual(self.left(), ["afile"])
        self.assertEqual((self.folder / "afile").read_text(encoding="utf-8"), "a file")

    # Hard case: program.full_disk
    def test_a_full_disk_leaves_nothing_of_any_command(self):
        for writer in WRITERS:
            if writer == "log":  # shorter than the limit
                continue
            with self.subTest(writer):
                self.write_to(writer, ".", preexec_fn=limit_files)
                self.assertEqual(self.left(), [])

    # Hard case: program.missing_folder
    def test_folders_that_are_missing_are_made(self):
        for writer, file in (("picture", "p.png"), ("stats", "s.json"), ("bench", "b.json"), ("bake", "fit.json"),
                             ("selftest", "report/selftest.json")):
            arguments = [word.replace("@", f"no/such/{writer}") for word in WRITERS[writer]]
            subprocess.run([self.program, *arguments], cwd=self.folder, env=self.environment(), stdout=subprocess.DEVNULL, timeout=280, check=True)
            self.assertTrue((self.folder / f"no/such/{writer}/{file}").is_file())

    def interrupt(self, arguments, number, ready):
        """Starts a command, sends it a signal once ready() holds, and expects its end within 2 s, without a word."""
        with subprocess.Popen([self.program, *arguments], cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as run:
            end = time.monotonic() + 60
            while run.poll() is None and not ready() and time.monotonic() < end:
                pass
            self.assertIsNone(run.poll(), f"{arguments} ended before its signal")
            run.send_signal(number)
            sent = time.monotonic()
            _, errors = run.communicate(timeout=60)
        # A shell makes 130 and 143 of these.
        self.assertEqual(run.returncode, -number, f"{arguments}: {errors}")
        self.assertEqual([line for line in errors.splitlines() if not line.startswith("gloam: warning: ")], [])
        self.assertLess(time.monotonic() - sent, 2.0, arguments)

    # Hard case: program.signals
    def test_signals_end_every_command(self):
        """But `play`, which answers within its frames: program.play and program.play_answers."""
        Picture(2048, 2048, b"\x80" * 3 * 2048**2).write(self.folder / "large.png")
        for arguments in (("render", "builtin:plain", *SMALL, "--frames", "1000000", "--out", "p.png", "--stats", "s.json"),
                          ("bake", "builtin:wet_street", "--cache-dir", "cache"),
                          ("cost", "builtin:plain", *SMALL, "--out", "ledger"),
                          ("bench", "ecs", "--json", "b.json"),
                          ("selftest", "--quick", "--out", "report"),
                          ("compare", "large.png", "large.png"),
                          ("inspect", "builtin:many_lights")):
            late = 0.02 if arguments[0] == "inspect" else 0.4  # it ends soon
            for seconds, number in ((0.02, signal.SIGINT), (late, signal.SIGTERM)):
                with self.subTest(f"{arguments} after {seconds} s"):
                    begin = time.monotonic()
                    self.interrupt(arguments, number, lambda: time.monotonic() - begin > seconds)
        self.assertEqual([name for name in self.left() if not name.startswith(("ledger/", "cache/"))], ["large.png"])
        self.assertEqual([name for name in self.left() if name.endswith(".partial")], [])

    # Hard case: program.signals
    def test_a_signal_in_the_middle_of_a_file_leaves_none_that_is_not_whole(self):
        old = {f"p_{i:03d}.png" for i in range(40)}
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for name in old:
                (self.folder / name).write_bytes(b"old")
            self.interrupt(("render", "builtin:plain", "--size", "256x144", "--frames", "40", "--out", "p_%03d.png"), number,
                           lambda: any(name.endswith(".partial") for name in os.listdir(self.folder)))
            self.assertEqual(set(self.left()), old)
            for name in old:
                data = (self.folder / name).read_bytes()
                self.assertTrue(data == b"old" or data.endswith(PNG_END), name)


if __name__ == "__main__":
    main()
