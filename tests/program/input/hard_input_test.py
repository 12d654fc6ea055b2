# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Loads files that ask for too much and writes to places that refuse. Nothing here may crash, hang or take much memory."""
import base64
import copy
import json
import os
import resource
import struct
import subprocess
import threading
import time

from gltf_scene import TRIANGLE
from program_case import ProgramCase, main

SECONDS = 60  # an input that takes longer counts as a hang; on an idle machine each takes less than two
MEMORY = 2 << 30  # bytes


def with_lights(scene, lights):
    """Adds nodes with point lights to a scene."""
    scene["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10, "range": 5}]}}
    scene["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": 0}}}] * lights
    return scene


def every_node(scene):
    scene["scenes"] = [{"nodes": list(range(len(scene["nodes"])))}]
    return scene


class HardInput(ProgramCase):
    def write(self, name, scene):
        (self.folder / name).write_text(json.dumps(scene))
        return name

    def refused(self, name, says, command="inspect"):
        self.expect(3, command, name, says=says, timeout=SECONDS)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024  # of the largest run so far
        self.assertLess(peak, MEMORY, name)

    # Hard case: scene.gigantic_count
    def test_joints_of_many_skins_that_wrap_32_bits(self):
        scene = copy.deepcopy(TRIANGLE)
        data = base64.b64decode(scene["buffers"][0]["uri"].split(",")[1]) + bytes(12) + struct.pack("<4f", 1, 0, 0, 0) * 3
        scene["buffers"] = [{"byteLength": len(data),
                             "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]
        scene["bufferViews"] += [{"buffer": 0, "byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 48}]
        scene["accessors"] += [{"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4"},
                               {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"}]
        scene["meshes"][0]["primitives"][0]["attributes"] |= {"JOINTS_0": 1, "WEIGHTS_0": 2}
        scene["skins"] = [{"joints": [1] * 65536}]
        scene["nodes"] += [{"mesh": 0, "skin": 0}] * 65536
        self.refused(self.write("skins.gltf", every_node(scene)), "joints of skinned nodes")

    def test_deformed_vertices_that_wrap_32_bits(self):
        scene = copy.deepcopy(TRIANGLE)
        scene["accessors"] += [{"componentType": 5126, "count": 65538, "type": "VEC3"}]
        scene["meshes"] = [{"primitives": [{"attributes": {"POSITION": 1}, "targets": [{}]}]}]
        scene["nodes"] += [{"mesh": 0}] * 65535
        for command in ("inspect", "render"):
            self.refused(self.write("morphs.gltf", every_node(scene)), "skinned and morphed vertices", command)

    def test_closeup_subjects_times_lights(self):
        scene = with_lights(copy.deepcopy(TRIANGLE), 4000)
        scene["nodes"] += [{"mesh": 0, "extras": {"gloam.closeup": True}}] * 4000
        self.refused(self.write("pairs.gltf", every_node(scene)), "gloam.closeup: the subjects up to here")

    def test_more_reflection_proxies_than_an_image_has_layers(self):
        scene = copy.deepcopy(TRIANGLE)
        scene["nodes"] += [{"extras": {"gloam.ibr_proxy.size": [1, 1]}}] * 2049
        self.refused(self.write("proxies.gltf", every_node(scene)), "the scene has 2049 reflection proxies")

    # Hard case: scene.cycle, scene.path_leaves, scene.gigantic_count
    def test_a_node_cycle_a_gigantic_count_and_a_path_that_leaves(self):
        cycle = copy.deepcopy(TRIANGLE)
        cycle["nodes"] = [{"children": [1]}, {"children": [0]}]
        self.refused(self.write("cycle.gltf", cycle), "its own ancestor")
        count = copy.deepcopy(TRIANGLE)
        count["accessors"][0]["count"] = 10_000_000_000
        self.refused(self.write("count.gltf", count), "count must be in 1")
        leaves = copy.deepcopy(TRIANGLE)
        leaves["buffers"][0]["uri"] = "../../etc/passwd"
        self.refused(self.write("leaves.gltf", leaves), "leaves the scene's folder")

    # Hard case: scene.no_image
    def test_a_picture_that_is_none_and_a_folder_in_the_place_of_a_file(self):
        (self.folder / "fake.png").write_text("not a picture")
        (self.folder / "folder.png").mkdir()
        for uri, says in (("fake.png", "is not a PNG, JPEG or WebP"), ("folder.png", "is not a file"), ("/dev/zero", "leaves")):
            scene = {**copy.deepcopy(TRIANGLE), "images": [{"uri": uri}]}
            self.refused(self.write("picture.gltf", scene), says)
        (self.folder / "scene.gltf").mkdir()
        self.refused("scene.gltf", "is not a file")

    def test_a_bomb_behind_many_images_is_decoded_once(self):
        # A PNG header of 16384×2720 pixels of one bit, and just enough bytes.
        png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBBI", 13, b"IHDR", 16384, 2720, 1, 0, 0, 0, 0, 0) + bytes(5400)
        (self.folder / "bomb.png").write_bytes(png)
        started = time.monotonic()
        scene = {**copy.deepcopy(TRIANGLE), "images": [{"uri": "./" * i + "bomb.png"} for i in range(1000)]}
        self.refused(self.write("bomb.gltf", scene), "bomb.png")
        self.assertLess(time.monotonic() - started, SECONDS)

    # Hard case: scene.lying_draco, scene.damaged_draco
    def test_a_draco_stream_of_billions_and_one_that_is_cut(self):
        def varint(value):
            return (bytes([value & 127 | 128]) + varint(value >> 7)) if value > 127 else bytes([value])

        head = b"DRACO" + bytes([2, 2, 1])  # version 2.2, a mesh
        for method, counts in ((0, (1_400_000_000, 3)), (0, (1, 4_000_000_000)), (1, (3, 1_400_000_000)), (1, (3, 1))):
            stream = head + bytes([method, 0, 0]) + bytes(method) + b"".join(map(varint, counts)) + bytes(9)
            (self.folder / "mesh.bin").write_bytes(stream)
            triangles = counts[method]
            scene = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "extensionsRequired": ["KHR_draco_mesh_compression"],
                     "buffers": [{"uri": "mesh.bin", "byteLength": len(stream)}],
                     "bufferViews": [{"buffer": 0, "byteLength": len(stream)}],
                     "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"},
                                   {"componentType": 5125, "count": 3 * triangles, "type": "SCALAR"}],
                     "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions": {
                         "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}]}
            self.refused(self.write("draco.gltf", scene), "draco.gltf: mesh 0, primitive 0, KHR_draco_mesh_compression: it")

    # Hard case: scene.damaged_webp
    def test_a_webp_of_the_largest_size_in_a_few_bytes(self):
        chunk = b"\x2f" + struct.pack("<I", 16383 | 16383 << 14) + bytes(20)  # lossless, width − 1 and height − 1 in 14 bits each
        body = b"WEBPVP8L" + struct.pack("<I", len(chunk)) + chunk + bytes(len(chunk) % 2)
        (self.folder / "bomb.webp").write_bytes(b"RIFF" + struct.pack("<I", len(body)) + body)
        scene = {**copy.deepcopy(TRIANGLE), "images": [{"uri": "bomb.webp"}]}
        self.refused(self.write("webp.gltf", scene), "webp.gltf: image 0 \"bomb.webp\": is a damaged image")

    def test_a_scene_that_is_replaced_while_it_is_read(self):
        whole, cut = json.dumps(TRIANGLE), json.dumps(TRIANGLE)[:200]
        path = self.folder / "moving.gltf"
        path.write_text(whole)
        stop = threading.Event()

        def replace():
            for turn in range(1_000_000):
                if stop.is_set():
                    return
                path.write_text(cut if turn % 2 else whole)
                temporary = self.folder / "next.gltf"
                temporary.write_text(whole)
                os.replace(temporary, path)

        writer = threading.Thread(target=replace)
        writer.start()
        try:
            codes = {self.run_program("inspect", "moving.gltf", timeout=SECONDS).returncode for _ in range(20)}
        finally:
            stop.set()
            writer.join()
        self.assertLessEqual(codes, {0, 3})

    def test_places_that_refuse_what_is_written(self):
        self.require_device()
        (self.folder / "picture.png").mkdir()
        run = ("render", "builtin:plain", "--size", "64x36", "--frames", "1")
        self.expect(1, *run, "--out", "picture.png")
        self.expect(1, *run, "--out", "/proc/picture.png")
        self.expect(1, *run, "--stats", "/proc/stats.json")
        mount = ("unshare", "-m", "sh", "-c",
                 'mkdir full && mount -t tmpfs -o size=4k none full && '
                 'head -c 4096 /dev/zero >full/filler && "$@"', "sh")
        probe = subprocess.run([*mount, "true"], cwd=self.folder, capture_output=True, check=False)
        if probe.returncode == 0:
            os.rmdir(self.folder / "full")
            self.expect(1, *run, "--out", "full/picture.png", prefix=mount)
        # A limit on file sizes fails a write in its middle, as a full disk does; SIGXFSZ is ignored by the shell's trap.
        limited = ("sh", "-c", 'trap "" XFSZ; ulimit -f 1; exec "$@"', "sh")
        self.expect(1, *run, "--out", "large.png", prefix=limited)

    def test_it_reads_a_folder_that_may_only_be_read(self):
        self.write("scene.gltf", TRIANGLE)
        os.chmod(self.folder, 0o555)
        try:
            self.expect(0, "inspect", "scene.gltf")
        finally:
            os.chmod(self.folder, 0o755)


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    main()
