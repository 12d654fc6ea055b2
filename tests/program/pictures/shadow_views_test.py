# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `render` with the shadow visualizers. Needs a Vulkan device."""
from program_case import ProgramCase, main


class ShadowViewsTest(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def test_traced_views_are_drawn_the_same_whatever_the_threads(self):
        for view in ("error", "shadow_reference:lamp"):
            for threads in ("1", "3"):
                self.expect(0, "render", "builtin:shadows", "--size", "96x54", "--view", view, "--threads", threads, "--validate",
                            "--out", f"{threads}.png")
            pictures = [(self.folder / f"{threads}.png").read_bytes() for threads in ("1", "3")]
            self.assertEqual(*pictures, view)


if __name__ == "__main__":
    main()
