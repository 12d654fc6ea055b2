# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Writes a steel helmet with brass rims as a .glb file without lights and cameras, as models are downloaded.

usage: helmet.py FILE.glb"""
import json
import math
import struct
import sys

RADIUS_M, TOP_M, BOTTOM_M = 0.115, 0.175, -0.16
THICKNESS_M = 0.004
EYES = (0.006, 0.052, 0.86)  # lower and upper edge in metres, half the angle
BREATH = (-0.16, 0.006, 0.16)


def shell_point(angle, height, inset=0.0):
    """A point of the shell; angle 0 is the front, +Z."""
    along = (height - BOTTOM_M) / (TOP_M - BOTTOM_M)
    dome = max(0.0, (height - 0.045) / (TOP_M - 0.045))
    radius = RADIUS_M * math.sqrt(max(0.0, 1.0 - dome ** 2.3)) * (1.0 + 0.10 * (1.0 - along) ** 2 - 0.06 * math.sin(math.pi * along))
    keel = 0.010 * max(0.0, math.cos(angle)) ** 24 * (1.0 - dome)
    radius = max(radius - inset, 0.0)
    return (radius * 0.92 * math.sin(angle), height - inset * dome, (radius * 1.12 + keel) * math.cos(angle))


def is_open(angle, height):
    bottom, top, half = EYES
    if bottom < height < top and abs(angle) < half:
        return True
    bottom, top, half = BREATH
    return bottom < height < top and abs(angle) < half


class Mesh:
    def __init__(self):
        self.points, self.triangles = [], []

    def grid(self, rows):
        """Joins rows of points of one length; None leaves a cell out."""
        first, width = len(self.points), len(rows[0])
        for row in rows:
            self.points += row
        return first, width

    def quad(self, a, b, c, d):
        for triangle in ((a, b, c), (a, c, d)):
            if len({self.points[i] for i in triangle}) == 3:
                self.triangles.append(triangle)

    def tube(self, path, radius, sides=10, closed=False):
        """A tube around a path of points."""
        count, first = len(path), len(self.points)
        for i in range(count):
            before, after = (path[(i + step) % count] if closed else path[min(max(i + step, 0), count - 1)] for step in (-1, 1))
            along = normalized(tuple(b - a for a, b in zip(before, after)))
            side = normalized(cross(along, (0.31, 0.9, 0.2)))
            up = cross(side, along)
            for s in range(sides):
                angle = 2 * math.pi * s / sides
                self.points.append(tuple(p + radius * (math.cos(angle) * x + math.sin(angle) * y) for p, x, y in zip(path[i], side, up)))
        for i in range(count if closed else count - 1):
            for s in range(sides):
                row, next_row, t = first + i * sides, first + (i + 1) % count * sides, (s + 1) % sides
                self.quad(row + s, row + t, next_row + t, next_row + s)

    def ball(self, center, radius, rings=8, sides=12):
        first = len(self.points)
        for r in range(rings + 1):
            for s in range(sides):
                a, b = math.pi * r / rings, 2 * math.pi * s / sides
                self.points.append(tuple(c + radius * d for c, d in zip(center, (math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b)))))
        for r in range(rings):
            for s in range(sides):
                t = (s + 1) % sides
                self.quad(first + r * sides + s, first + r * sides + t, first + (r + 1) * sides + t, first + (r + 1) * sides + s)

    def normals(self):
        """Of smooth surfaces: points at one place share a normal."""
        sums = {}
        for a, b, c in self.triangles:
            p, q, r = (self.points[i] for i in (a, b, c))
            face = cross(tuple(y - x for x, y in zip(p, q)), tuple(y - x for x, y in zip(p, r)))
            for point in (p, q, r):
                sums[point] = tuple(x + y for x, y in zip(sums.get(point, (0.0, 0.0, 0.0)), face))
        return [normalized(sums.get(point, (0.0, 1.0, 0.0))) for point in self.points]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v) if length > 0 else (0.0, 1.0, 0.0)


def steps(*edges, finest):
    """Numbers from the first edge to the last that contain all edges."""
    values = []
    for low, high in zip(edges, edges[1:]):
        count = max(1, math.ceil((high - low) / finest))
        values += [low + (high - low) * i / count for i in range(count)]
    return values + [edges[-1]]


def shell(inset, inside):
    mesh = Mesh()
    angles = steps(-math.pi, -EYES[2], -BREATH[2], 0.0, BREATH[2], EYES[2], math.pi, finest=0.04)
    heights = steps(BOTTOM_M, EYES[0], EYES[1], 0.12, finest=0.006) + [TOP_M - 0.055 * (1 - i / 16) ** 2 for i in range(1, 17)]
    first, width = mesh.grid([[shell_point(angle, height, inset) for angle in angles] for height in heights])
    for row, (low, high) in enumerate(zip(heights, heights[1:])):
        for column, (left, right) in enumerate(zip(angles, angles[1:])):
            if is_open((left + right) / 2, (low + high) / 2):
                continue
            a = first + row * width + column
            corners = (a, a + 1, a + width + 1, a + width)
            mesh.quad(*(reversed(corners) if inside else corners))
    return mesh


def opening():
    """The edge of the opening as angles and heights, from the bottom's left to its right."""
    low, high, eyes = EYES
    corners = [(-BREATH[2], BOTTOM_M), (-BREATH[2], low), (-eyes, low), (-eyes, high), (eyes, high), (eyes, low), (BREATH[2], low), (BREATH[2], BOTTOM_M)]
    path = []
    for (a, h), (b, k) in zip(corners, corners[1:]):
        count = max(2, math.ceil(max(abs(b - a) / 0.03, abs(k - h) / 0.004)))
        path += [(a + (b - a) * i / count, h + (k - h) * i / count) for i in range(count)]
    return path + [corners[-1]]


def brass():
    mesh = Mesh()
    middle = THICKNESS_M / 2
    mesh.tube([shell_point(a, h, middle) for a, h in opening()], 0.0042)
    around = [BREATH[2] + (2 * math.pi - 2 * BREATH[2]) * i / 120 for i in range(121)]
    mesh.tube([shell_point(a, BOTTOM_M, middle) for a in around], 0.0048)
    for i in range(18):
        mesh.ball(shell_point(0.5 + (2 * math.pi - 1.0) * i / 17, 0.078, -0.001), 0.0042)
    ridge = [shell_point(a, h, -0.002) for a, h in [(0.0, 0.066 + 0.108 * i / 40) for i in range(41)]]
    back = [shell_point(math.pi, 0.174 - 0.274 * i / 60, -0.002) for i in range(61)]
    mesh.tube(ridge + [shell_point(0.0, TOP_M, -0.002)] + back, 0.0055)
    return mesh


def main(path):
    materials = [("steel", (0.56, 0.57, 0.58), 1.0, 0.34), ("lining", (0.035, 0.022, 0.016), 0.0, 0.9), ("brass", (0.80, 0.52, 0.20), 1.0, 0.28)]
    meshes = [shell(0.0, False), shell(THICKNESS_M, True), brass()]
    data, views, accessors, primitives = b"", [], [], []
    for material, mesh in enumerate(meshes):
        indices = [i for triangle in mesh.triangles for i in triangle]
        for values, kind in ((mesh.points, "VEC3"), (mesh.normals(), "VEC3"), (indices, "SCALAR")):
            flat = [x for v in values for x in v] if kind == "VEC3" else values
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(flat)})
            accessor = {"bufferView": len(views) - 1, "componentType": 5126 if kind == "VEC3" else 5125, "count": len(values), "type": kind}
            if values is mesh.points:
                accessor |= {"min": [min(p[i] for p in values) for i in range(3)], "max": [max(p[i] for p in values) for i in range(3)]}
            accessors.append(accessor)
            data += struct.pack(f"<{len(flat)}{'f' if kind == 'VEC3' else 'I'}", *flat)
        primitives.append({"attributes": {"POSITION": 3 * material, "NORMAL": 3 * material + 1}, "indices": 3 * material + 2, "material": material})
    scene = {
        "asset": {"version": "2.0", "copyright": "The gloam authors, MIT"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "helmet", "mesh": 0, "translation": [0, -BOTTOM_M, 0]}], "meshes": [{"primitives": primitives}],
        "materials": [{"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": metal, "roughnessFactor": rough}}
                      for name, color, metal, rough in materials],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}],
    }
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


if __name__ == "__main__":
    main(sys.argv[1])
