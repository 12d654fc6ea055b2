# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""lighting.indirect is chosen in a window: the captures that it needs are made then. Needs Vulkan and Xvfb."""
import shutil

from program_case import main
from scene_file import SceneFile, turned
from window_case import WindowCase

WIDTH, HEIGHT, PANEL = 760, 740, 480  # PANEL: columns that the panel covers


def stop(name):
    """The window is photographed here."""
    return f"move {WIDTH - 10} 20\nwait 3\nsay {name}\nuntil {name}.seen\n"


class PlayIndirect(WindowCase):
    def test_captures_are_made_when_the_knob_changes(self):
        self.assertIsNotNone(shutil.which("Xvfb"), "Xvfb is not installed (package xvfb)")
        self.require_device()
        scene = SceneFile(sky=(0.0, 0.0, 0.0), exposure=0.0)
        scene.quad(3.0, scene.material((0.8, 0.8, 0.8)))
        scene.box((3.0, 1.5, 0.1), scene.material((0.8, 0.05, 0.05)), at=(0, 1.5, -1.5))
        scene.light("point", at=(0.5, 1.5, 0), intensity=20.0)
        scene.camera((0.0, 1.5, 3.0), turned(0, -0.4), 0.8)
        scene.nodes.append({"translation": [0, 1.5, 0], "extras": {"gloam.cube_probe.size": [7, 4, 7]}})
        scene.write(self.folder / "s.gltf")
        choose = "click_widget lighting.indirect\nwait 2\nclick_widget lighting.indirect {}\nwait 3\n".format
        script = ("key tab\nwait 3\nclick_widget search\ntype lighting.indirect\nwait 2\n" + stop("sky") + choose("probes") +
                  stop("probes") + choose("sky") + stop("again") + "close\n")
        run = self.start("s.gltf", "--size", f"{WIDTH}x{HEIGHT}", "--scale", "1", "--dt", "0", "--validate", script=script,
                         size=(800, 760))
        sky, probes, again = (run.photograph_at(name) for name in ("sky", "probes", "again"))
        run.end()
        places = [(x, y) for y in range(HEIGHT // 2, HEIGHT, 7) for x in range(PANEL + 8, WIDTH, 7)]
        gain = [probes.pixel(x, y)[0] - sky.pixel(x, y)[0] for x, y in places]
        self.assertGreater(sum(gain) / len(gain), 1.0, "the floor has light of the red wall")
        self.assertTrue(all(again.pixel(x, y) == sky.pixel(x, y) for x, y in places))


if __name__ == "__main__":
    main()
