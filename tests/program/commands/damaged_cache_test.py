# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Files of the cache folder that are damaged in any way: the picture stays, each file is told once and made again."""
import os
import shutil
import tempfile
from pathlib import Path

from program_case import ProgramCase, main

# Has captures, particle light, a list of pipelines and a pipeline cache.
SCENE = ("render", "builtin:smoke", "--size", "32x18", "--out", "p.png")


def changed(data, at):
    return data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]


def other_version(data):
    for version, other in ((b"gloam sealed 1", b"gloam sealed 0"), (b'"pipelines":1', b'"pipelines":0')):
        if version in data:
            return data.replace(version, other, 1)
    return changed(data, 0)  # the magic number of the pipeline cache


def write(damage):
    return lambda path, data: path.write_bytes(damage(data))


def put_folder(path, _):
    path.unlink()
    path.mkdir()


DAMAGES = {
    "cut short": write(lambda data: data[:len(data) // 2]),
    "zeros": write(lambda data: bytes(len(data))),
    "a bit": write(lambda data: changed(data, len(data) * 3 // 4)),
    "another version": write(other_version),
    "unreadable": lambda path, _: path.chmod(0),
    "a folder": put_folder,
}


class DamagedCache(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()
        folder = tempfile.TemporaryDirectory(prefix="gloam-damaged-")
        self.addCleanup(folder.cleanup)
        self.cache = Path(folder.name)
        self.damages = dict(DAMAGES)
        self.prefix = ()
        if os.getuid() == 0:  # root reads every file
            self.prefix = ("setpriv", "--bounding-set=-dac_override,-dac_read_search")
            if shutil.which("setpriv") is None:
                self.prefix = ()
                self.damages.pop("unreadable")

    def draw(self):
        run = self.expect(0, *SCENE, "--cache-dir", self.cache, prefix=self.prefix)
        return (self.folder / "p.png").read_bytes(), run.stderr.splitlines()

    def files(self):
        return {path: path.read_bytes() for path in sorted(self.cache.rglob("*")) if path.is_file()}

    # Hard case: program.damaged_cache
    def test_damaged_files_are_told_once_and_made_again(self):
        picture, warnings = self.draw()
        self.assertEqual(warnings, [])
        sound = self.files()
        self.assertEqual(sorted(path.suffix for path in sound), [".bin", ".captures", ".json", ".light"])
        for first in range(len(self.damages)):
            damages = {path: list(self.damages)[(first + i) % len(self.damages)] for i, path in enumerate(sound)}
            with self.subTest(str(damages)):
                for path, damage in damages.items():
                    self.damages[damage](path, sound[path])
                again, warnings = self.draw()
                self.assertEqual(again, picture)
                for path in sound:
                    self.assertEqual(sum(str(path) in line for line in warnings), 1, f"{path}: {warnings}")
                self.assertEqual(len(warnings), len(sound), warnings)
                for path in (path for path, damage in damages.items() if damage == "a folder"):
                    path.rmdir()  # what is no file is not replaced
                    path.write_bytes(sound[path])
                self.assertEqual(self.files(), sound, "every file is made again, and there are no others")
        self.assertEqual(self.draw(), (picture, []), "files that were made again are used")


if __name__ == "__main__":
    main()
