# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Builds small glTF files for the program's tests."""
import base64
import json
import math
import struct

UNIT_EXPOSURE = math.log2(1 / 1.2)  # EV100 at which 1 cd/m² is white
FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
CODES = {FLOAT: "f", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I"}

# One triangle and a camera: a small scene for tests of the commands.
TRIANGLE = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0, "name": "leaf"}, {"camera": 0, "name": "eye"}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                 "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
}


def turn_x(degrees):
    """The rotation about +X as a glTF quaternion."""
    half = math.radians(degrees) / 2
    return [math.sin(half), 0, 0, math.cos(half)]


def turn_y(degrees):
    half = math.radians(degrees) / 2
    return [0, math.sin(half), 0, math.cos(half)]


class GltfScene:
    """A scene whose numbers lie in one buffer. Methods that add something return its index."""

    def __init__(self, exposure=UNIT_EXPOSURE, sky=(0, 0, 0)):
        self.data = b""
        extras = {}
        if exposure is not None:
            extras["gloam.exposure"] = exposure
        if sky is not None:
            extras |= {f"gloam.sky.{part}": list(sky) for part in ("zenith", "horizon", "ground")}
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [], "extras": extras}], "nodes": [],
                     "cameras": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": []}

    def add(self, kind, item):
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def numbers(self, kind, values, component=FLOAT, normalized=False):
        """An accessor. values: flat."""
        packed = struct.pack(f"<{len(values)}{CODES[component]}", *values)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed + bytes(-len(packed) % 4)
        accessor = {"bufferView": view, "componentType": component, "count": len(values) // WIDTHS[kind], "type": kind}
        if normalized:
            accessor["normalized"] = True
        if kind in ("SCALAR", "VEC3") and component == FLOAT:
            width = WIDTHS[kind]
            accessor["min"] = [struct.unpack("f", struct.pack("f", min(values[c::width])))[0] for c in range(width)]
            accessor["max"] = [struct.unpack("f", struct.pack("f", max(values[c::width])))[0] for c in range(width)]
        return self.add("accessors", accessor)

    def node(self, parent=None, **members):
        index = self.add("nodes", members)
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def material(self, color=(1, 1, 1, 1), **members):
        surface = {"baseColorFactor": list(color), "metallicFactor": 0, "roughnessFactor": 1}
        return self.add("materials", {"pbrMetallicRoughness": surface, **members})

    def card(self, material, half=1.0, normal=(0, 0, 1), reversed_winding=False, more=None, targets=None):
        """A mesh: a square in the XY plane that faces +Z. normal None: without normals."""
        corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
        attributes = {"POSITION": self.numbers("VEC3", [x for c in corners for x in (*c, 0.0)])}
        if normal is not None:
            attributes["NORMAL"] = self.numbers("VEC3", list(normal) * 4)
        order = [0, 2, 1, 0, 3, 2] if reversed_winding else [0, 1, 2, 0, 2, 3]
        primitive = {"attributes": attributes | (more or {}), "indices": self.numbers("SCALAR", order, UNSIGNED_INT),
                     "material": material}
        if targets:
            primitive["targets"] = targets
        return self.add("meshes", {"primitives": [primitive]})

    def camera(self, parent=None, lens=None, **members):
        camera = self.add("cameras", lens or {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}})
        return self.node(parent, camera=camera, **members)

    def light(self, parent=None, light=None, **members):
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(light)
        self.json["extensionsUsed"] = ["KHR_lights_punctual"]
        return self.node(parent, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}}, **members)

    def animate(self, node, path, times, values):
        kind = "VEC4" if path == "rotation" else "VEC3"
        sampler = {"input": self.numbers("SCALAR", times), "output": self.numbers(kind, values)}
        self.add("animations", {"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]})

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        whole = {**self.json, "buffers": [{"byteLength": len(self.data), "uri": uri}]}
        return json.dumps({name: value for name, value in whole.items() if value != []})
