# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests the cache of baked particle light: it is written once, read again, replaced when damaged, and not needed. Needs a
Vulkan device."""
from program_case import ProgramCase, main

OPTIONS = ("--size", "96x54", "--time", "4", "--set", "shadows.mode=off", "--set", "reflections.mode=off")


class ParticleLight(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def render(self, cache, name):
        """The picture's bytes and the run."""
        run = self.expect(0, "render", "builtin:smoke", *OPTIONS, "--cache-dir", cache, "--out", name)
        return (self.folder / name).read_bytes(), run

    def maps(self, cache):
        return sorted((self.folder / cache / "particles").glob("*.light"))

    def test_the_second_run_reads_the_maps_of_the_first(self):
        first, _ = self.render("cache", "a.png")
        files = self.maps("cache")
        self.assertEqual(len(files), 1)
        before, content = files[0].stat(), files[0].read_bytes()
        second, run = self.render("cache", "b.png")
        self.assertEqual(second, first)
        self.assertEqual(run.stderr, "")
        self.assertEqual(self.maps("cache"), files)
        after = files[0].stat()
        self.assertEqual((after.st_mtime_ns, after.st_ino), (before.st_mtime_ns, before.st_ino), "the file was rewritten")
        # Damage in the head, in the middle and at the end.
        for at, length in ((0, len(content)), (len(content) // 2, len(content)), (len(content), len(content) // 3)):
            damaged = bytearray(content[:length])
            if at < length:
                damaged[at] ^= 0xFF
            files[0].write_bytes(damaged)
            picture, run = self.render("cache", "c.png")
            self.assertEqual(picture, first, f"damage at {at}")
            self.assertRegex(run.stderr, r"^gloam: warning: \S+\.light: is damaged; the particle light is made again\n$")
            self.assertEqual(self.maps("cache"), files)
            self.assertEqual(files[0].read_bytes(), content, f"damage at {at}: the file was not replaced")

    def test_a_cache_that_cannot_be_written_is_a_warning(self):
        first, _ = self.render("cache", "a.png")
        (self.folder / "blocked").mkdir()
        (self.folder / "blocked" / "particles").write_bytes(b"a file in the place of the folder")
        picture, run = self.render("blocked", "b.png")
        self.assertEqual(picture, first)
        self.assertIn("gloam: warning: ", run.stderr)
        self.assertIn("particles", run.stderr)

    def test_a_scene_without_particles_bakes_none(self):
        self.expect(0, "render", "builtin:plain", "--size", "16x16", "--cache-dir", "cache", "--out", "p.png")
        self.assertFalse((self.folder / "cache" / "particles").exists())


if __name__ == "__main__":
    main()
