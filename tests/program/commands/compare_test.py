# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `compare`: what it says of two pictures, and how it ends."""
import re
import struct
import zlib

from program_case import ProgramCase, main
from rgb_picture import Picture


class Compare(ProgramCase):
    def picture(self, name, color, width=8, height=6, spot=None):
        rgb = bytearray(bytes(color) * (width * height))
        if spot:
            rgb[0:3] = bytes(spot)
        Picture(width, height, bytes(rgb)).write(self.folder / name)

    def figures(self, *arguments, code=0):
        found = re.search(r"FLIP ([\d.]+), root mean square ([\d.]+) of 255, largest difference (\d+) of 255",
                          self.expect(code, "compare", *arguments).stdout)
        self.assertIsNotNone(found)
        return float(found[1]), float(found[2]), int(found[3])

    def test_a_picture_equals_itself(self):
        self.picture("a.png", (10, 200, 30))
        self.assertEqual(self.figures("a.png", "a.png", "--most", "0"), (0.0, 0.0, 0))

    def test_differences_are_counted_over_all_pixels(self):
        self.picture("a.png", (100, 100, 100))
        self.picture("b.png", (100, 100, 100), spot=(148, 100, 100))
        flip, mean, largest = self.figures("b.png", "a.png")
        self.assertAlmostEqual(mean, (48 * 48 / (3 * 48)) ** 0.5, 3)
        self.assertEqual(largest, 48)
        self.assertGreater(flip, 0.0)
        self.picture("c.png", (200, 20, 100))
        self.assertGreater(self.figures("c.png", "a.png")[0], flip)

    def test_the_legend_of_a_view_is_left_out(self):
        """Two pictures that differ only in the rows that one of them states to be its legend."""
        self.picture("a.png", (100, 100, 100))
        rows = [bytes((100, 100, 100)) * 8] * 4 + [bytes((0, 0, 0)) * 8] * 2
        Picture(8, 6, b"".join(rows)).write(self.folder / "plain.png")
        data = (self.folder / "plain.png").read_bytes()
        self.assertGreater(self.figures("plain.png", "a.png")[2], 0)
        for text, largest in ((b"gloam legend rows\x002", 0), (b"gloam legend rows\x001", 100),
                              (b"gloam legend rows\x00999", 0), (b"Comment\x002", 100)):
            chunk = struct.pack(">I", len(text)) + b"tEXt" + text + struct.pack(">I", zlib.crc32(b"tEXt" + text))
            (self.folder / "legend.png").write_bytes(data[:33] + chunk + data[33:])
            for names in (("legend.png", "a.png"), ("a.png", "legend.png")):
                self.assertEqual(self.figures(*names)[2], largest, text)

    def test_a_difference_above_the_most_fails(self):
        self.picture("a.png", (0, 0, 0))
        self.picture("b.png", (255, 255, 255))
        self.figures("a.png", "b.png", "--most", "0.5", code=1)
        self.picture("c.png", (0, 0, 0), width=9)
        self.expect(1, "compare", "a.png", "c.png", says="8x6 and 9x6")

    def test_what_is_no_picture_is_an_input_error(self):
        self.picture("a.png", (0, 0, 0))
        (self.folder / "b.png").write_bytes(b"no picture")
        self.expect(3, "compare", "a.png", "b.png", says="b.png")
        self.expect(3, "compare", "missing.png", "a.png", says="missing.png")
        self.expect(2, "compare", "a.png")
        self.expect(2, "compare", "a.png", "a.png", "--most", "2")


if __name__ == "__main__":
    main()
