# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Writes small scenes as glTF, at any scale and place."""
import base64
import copy
import json
import math
import struct

UP_Y, DOWN = (0.0, 1.0, 0.0), (-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
# Keys whose numbers are lengths in units of the scene. Keys of physics (fog, focus) are in metres: see gloam.scale.
LENGTHS = ("gloam.light.width", "gloam.ibr_proxy.size", "gloam.ibr_room.size", "gloam.cube_probe.size",
           "gloam.particles.size", "gloam.particles.box", "gloam.collider.radius", "gloam.collider.height", "gloam.collider.size")


def turned(axis, angle):
    """The quaternion of a rotation about one of the axes 0, 1, 2."""
    q = [0.0, 0.0, 0.0, math.cos(0.5 * angle)]
    q[axis] = math.sin(0.5 * angle)
    return q


def scaled_keys(extras, scale):
    def times(value, factor):
        return [times(v, factor) for v in value] if isinstance(value, list) else value * factor
    return {key: times(value, scale) if key in LENGTHS else value for key, value in extras.items()}


class SceneFile:
    """A scene in metres. write() multiplies all lengths, and adds an offset in multiplied units. The intensities of lamps
    grow with the square of the scale, so that their illuminance stays. physics: gloam.scale does that instead."""

    def __init__(self, sky=(0.0, 0.0, 0.0), exposure=3.0, **keys):
        self.extras = {"gloam.sky.zenith": list(sky), "gloam.sky.horizon": list(sky), "gloam.sky.ground": list(sky),
                       "gloam.exposure": exposure, **keys}
        self.nodes, self.meshes, self.materials, self.lights, self.cameras = [], [], [], [], []

    def copy(self):
        return copy.deepcopy(self)

    def material(self, color=(0.5, 0.5, 0.5), roughness=1.0, metallic=0.0, **extras):
        self.materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "roughnessFactor": roughness,
                                                        "metallicFactor": metallic}, "extras": extras})
        return len(self.materials) - 1

    def mesh(self, positions, normals, indices, material, at=(0, 0, 0), rotation=(0, 0, 0, 1), **extras):
        self.meshes.append((positions, normals, indices, material))
        self.nodes.append({"mesh": len(self.meshes) - 1, "translation": list(at), "rotation": list(rotation), "extras": extras})

    def quad(self, half, material, at=(0, 0, 0), rotation=(0, 0, 0, 1), **extras):
        """A horizontal square that faces up."""
        corners = [(-half, 0, -half), (-half, 0, half), (half, 0, half), (half, 0, -half)]
        self.mesh(corners, [UP_Y] * 4, [0, 1, 2, 0, 2, 3], material, at, rotation, **extras)

    def box(self, half, material, at=(0, 0, 0), rotation=(0, 0, 0, 1), **extras):
        positions, normals, indices = [], [], []
        for axis in range(3):
            for side in (-1, 1):
                first = len(positions)
                for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    p = [0.0] * 3
                    p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, u * side, v
                    positions.append([p[i] * half[i] for i in range(3)])
                    normals.append([side if i == axis else 0 for i in range(3)])
                indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
        self.mesh(positions, normals, indices, material, at, rotation, **extras)

    def light(self, kind, at=(0, 0, 0), rotation=DOWN, name="key", cone=1.0, extras=None, **values):
        light = {"type": kind, "name": name, **values}
        if kind == "spot":
            light["spot"] = {"outerConeAngle": cone, "innerConeAngle": 0.9 * cone}
        self.lights.append(light)
        self.nodes.append({"name": name, "translation": list(at), "rotation": list(rotation), "extras": extras or {},
                           "extensions": {"KHR_lights_punctual": {"light": len(self.lights) - 1}}})

    def camera(self, at, rotation, yfov=0.8, znear=0.05, **extras):
        self.cameras.append({"type": "perspective", "perspective": {"yfov": yfov, "znear": znear}})
        self.nodes.append({"camera": len(self.cameras) - 1, "translation": list(at), "rotation": list(rotation), "extras": extras})

    def orthographic_camera(self, at, rotation, half, znear, zfar):
        self.cameras.append({"type": "orthographic", "orthographic": {"xmag": 1.5 * half, "ymag": half, "znear": znear, "zfar": zfar}})
        self.nodes.append({"camera": len(self.cameras) - 1, "translation": list(at), "rotation": list(rotation), "extras": {}})

    def write(self, path, scale=1.0, offset=(0.0, 0.0, 0.0), physics=False):
        buffer, views, accessors, meshes = b"", [], [], []

        def accessor(data, component, kind, count, **bounds):
            nonlocal buffer
            views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
            accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind, "count": count, **bounds})
            buffer += data
            return len(accessors) - 1

        for positions, normals, indices, material in self.meshes:
            flat = [struct.unpack("<f", struct.pack("<f", c * scale))[0] for p in positions for c in p]
            bounds = {"min": [min(flat[i::3]) for i in range(3)], "max": [max(flat[i::3]) for i in range(3)]}
            attributes = {"POSITION": accessor(struct.pack(f"<{len(flat)}f", *flat), 5126, "VEC3", len(positions), **bounds),
                          "NORMAL": accessor(b"".join(struct.pack("<3f", *n) for n in normals), 5126, "VEC3", len(normals))}
            meshes.append({"primitives": [{"attributes": attributes, "material": material,
                                           "indices": accessor(struct.pack(f"<{len(indices)}I", *indices), 5125, "SCALAR", len(indices))}]})
        nodes = copy.deepcopy(self.nodes)
        for node in nodes:
            node["translation"] = [t * scale + o for t, o in zip(node["translation"], offset)]
            node["extras"] = scaled_keys(node["extras"], scale)
        lights = copy.deepcopy(self.lights)
        for light in lights:
            if light["type"] != "directional" and not physics:
                light["intensity"] *= scale * scale
            if "range" in light:
                light["range"] *= scale
        cameras = copy.deepcopy(self.cameras)
        for camera in cameras:
            lens = camera[camera["type"]]
            for key in ("znear", "zfar", "xmag", "ymag"):
                if key in lens:
                    lens[key] *= scale
        scene = {"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes, "meshes": meshes, "materials": self.materials,
                 "scenes": [{"nodes": list(range(len(nodes))), "extras": {**self.extras, **({"gloam.scale": 1.0 / scale} if physics else {})}}],
                 "accessors": accessors, "bufferViews": views, "cameras": cameras, "extensionsUsed": ["KHR_lights_punctual"],
                 "buffers": [{"byteLength": len(buffer), "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}]}
        if lights:
            scene["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
        path.write_text(json.dumps(scene))
        return path.name
