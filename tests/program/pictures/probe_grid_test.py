# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""`gloam bake --probes N` captures diffuse light of a scene without probes, keeps it, and pictures show it."""
import re

from program_case import ProgramCase, main
from rgb_picture import read_png
from scene_file import SceneFile, turned


def scene_with_a_red_wall():
    scene = SceneFile(sky=(0.0, 0.0, 0.0), exposure=0.0)
    scene.quad(3.0, scene.material((0.8, 0.8, 0.8)))
    scene.box((0.1, 1.5, 3.0), scene.material((0.8, 0.05, 0.05)), at=(-1.5, 1.5, 0))
    scene.light("point", at=(0.5, 1.5, 0), intensity=20.0)
    scene.camera((0.0, 1.5, 3.0), turned(0, -0.4), 0.8)
    return scene


class ProbeGrid(ProgramCase):
    def baked(self, *options):
        """Probes of the grid that a bake reports."""
        said = self.expect(0, "bake", self.path, "--beside", *options).stdout
        found = re.search(r"(\d+) probes? of a grid", said)
        return int(found.group(1)) if found else 0

    def picture(self, name, *knobs):
        out = self.folder / (name + ".png")
        sets = [word for knob in knobs for word in ("--set", knob)]
        self.expect(0, "render", self.path, "--size", "96x54", "--out", out, "--validate", *sets)
        return bytes(read_png(out).rgb)

    def test_grid_is_kept_and_shown(self):
        self.path = self.folder / "wall.gltf"
        scene_with_a_red_wall().write(self.path)
        self.assertEqual(self.baked(), 0)
        without = self.picture("without", "lighting.indirect=probes")
        probes = self.baked("--probes", "8")
        self.assertTrue(1 <= probes <= 8, probes)
        shown = self.picture("shown", "lighting.indirect=probes")
        self.assertNotEqual(shown, without, "the floor gets light of the lit wall")
        self.assertEqual(self.picture("sky", "lighting.indirect=sky"), without)
        self.assertEqual(self.picture("off", "lighting.indirect=probes", "reflections.mode=off"), shown)
        self.assertEqual(self.baked(), probes, "a bake without --probes keeps the grid")
        self.assertEqual(self.picture("kept", "lighting.indirect=probes"), shown)


if __name__ == "__main__":
    main()
