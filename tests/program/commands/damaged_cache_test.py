# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Files of the cache folder that are damaged in any way: the picture stays, each file is told once and made again."""
import os
import re
import shutil
import tempfile
from pathlib import Path

from program_case import ProgramCase, main

# Has captures, particle light, a list of pipelines and a pipeline cache.
SCENE = ("render", "builtin:smoke", "--size", "32x18", "--out", "p.png")


def changed(data, at):
    return data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]


# Name of the damage, and what becomes of a file's bytes.
DAMAGES = {
    "cut short": lambda data: data[:len(data) // 2],
    "empty": lambda data: b"",
    "zeros": lambda data: bytes(len(data)),
    "a bit in the first half": lambda data: changed(data, len(data) // 3),
    "a bit in the last byte": lambda data: changed(data, len(data) - 1),
    "another version": lambda data: data.replace(b"gloam sealed 1", b"gloam sealed 0", 1).replace(b'"pipelines":1', b'"pipelines":0', 1)
                                    .replace(b"gloPipc1"[::-1], b"gloPipc0"[::-1], 1),
}


class DamagedCache(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        folder = tempfile.TemporaryDirectory(prefix="gloam-damaged-")
        self.addCleanup(folder.cleanup)
        self.cache = Path(folder.name)
        self.cache.chmod(0o777)

    def draw(self, **options):
        run = self.expect(0, *SCENE, env={"XDG_CACHE_HOME": str(self.cache)}, **options)
        return (self.folder / "p.png").read_bytes(), run.stderr.splitlines()

    def files(self):
        return {path: path.read_bytes() for path in sorted(self.cache.rglob("*")) if path.is_file()}

    # Hard case: program.damaged_cache
    def test_damaged_files_are_told_once_and_made_again(self):
        picture, warnings = self.draw()
        self.assertEqual(warnings, [])
        sound = self.files()
        kinds = {path.parent.name if path.parent.parent != self.cache else path.stem.split("-")[0] for path in sound}
        self.assertEqual(kinds, {"captures", "particles", "pipelines"})
        self.assertEqual(len(sound), 4, "the list of pipelines and the pipeline cache are two files")
        for name, damage in DAMAGES.items():
            with self.subTest(name):
                for path, data in sound.items():
                    damaged = damage(data) if damage(data) != data else changed(data, 0)
                    path.write_bytes(damaged)
                again, warnings = self.draw()
                self.assertEqual(again, picture)
                self.assert_each_is_told_once(sound, warnings)
                self.assertEqual(self.files(), sound, "every file is made again, and there are no others")
        self.assertEqual(self.draw(), (picture, []), "files that were made again are used")

    def assert_each_is_told_once(self, files, warnings):
        for path in files:
            self.assertEqual(sum(str(path) in line for line in warnings), 1, f"{path}: {warnings}")
        self.assertEqual(len(warnings), len(files), warnings)

    # Hard case: program.damaged_cache
    def test_a_folder_in_the_place_of_a_file_changes_nothing_but_the_time(self):
        picture, _ = self.draw()
        for path in self.files():
            path.unlink()
            path.mkdir()
        again, warnings = self.draw()
        self.assertEqual(again, picture)
        for line in warnings:
            self.assertRegex(line, r"is not a file|cannot be written|is a folder")

    # Hard case: program.damaged_cache
    def test_a_file_that_cannot_be_read_is_made_again(self):
        if os.getuid() == 0 and shutil.which("setpriv") is None:
            self.skipTest("root reads every file, and there is no setpriv")
        picture, _ = self.draw()
        sound = self.files()
        for path in sound:
            path.chmod(0)
        prefix = ()
        if os.getuid() == 0:  # another user, who owns the folders but not the files
            prefix = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
            for folder in (self.folder, self.cache, *(path for path in self.cache.rglob("*") if path.is_dir())):
                folder.chmod(0o777)
        again, warnings = self.draw(prefix=prefix)
        self.assertEqual(again, picture)
        self.assert_each_is_told_once(sound, warnings)


if __name__ == "__main__":
    main()
