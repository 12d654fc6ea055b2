# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `render`: pictures, stats, traces, reproducibility, errors. Needs a Vulkan device."""
import base64
import json
import os
import re
import struct

from gltf_scene import TRIANGLE
from program_case import ProgramCase, main
from rgb_picture import read_png

SMALL = ("--size", "160x90")
NO_SHADOWS = ("--set", "shadows.mode=off")  # for tests in which shadows only take time
LIGHT_VIEWS = ("tile_masks", "lights_approx", "lights_accurate", "lights_difference", "light_culling:light 0", "light_list:light 0")
STATS = {"version", "scene", "device", "size", "frames", "frame_ms", "systems", "passes", "memory", "gpu_memory", "modules", "counters", "knobs"}


def approaching_lamp():
    """A triangle before the camera, and a lamp without a fixed exposure that is 8 m away, one second later 2 m."""
    data = struct.pack("<9f", -2, -1, 0, 2, -1, 0, 0, 2, 0) + struct.pack("<3f", 0, 1, 9) + struct.pack("<9f", 0, 0, 8, 0, 0, 2, 0, 0, 2)
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}], "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 200}]}},
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}], "samplers": [{"input": 1, "output": 2}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-2, -1, 0], "max": [2, 2, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [9]},
                      {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 36}],
        "buffers": [{"byteLength": 84, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }


class Render(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_the_default_picture_is_named_after_the_scene(self):
        run = self.expect(0, "render", "builtin:plain", *SMALL)
        self.assertIn("out/plain.png", run.stdout)
        self.assertTrue(self.bytes_of("out/plain.png").startswith(b"\x89PNG"))

    # Hard case: program.same_twice, selftest.twice
    def test_the_same_twice_to_the_bit(self):
        for scene in ("plain", "shadows"):
            for name in ("a", "b"):
                self.expect(0, "render", f"builtin:{scene}", *SMALL, "--frames", "2", "--time", "1.5", "--seed", "7",
                            "--out", f"{name}.png")
            self.assertEqual(self.bytes_of("a.png"), self.bytes_of("b.png"), scene)

    # Hard case: selftest.threads
    def test_threads_do_not_change_the_picture(self):
        for threads in ("1", "4"):
            self.expect(0, "render", "builtin:shadows", *SMALL, "--threads", threads, "--out", f"{threads}.png")
        self.assertEqual(self.bytes_of("1.png"), self.bytes_of("4.png"))

    def test_cameras_differ(self):
        for camera in ("main", "steps"):
            self.expect(0, "render", "builtin:lanterns", *SMALL, *NO_SHADOWS, "--camera", camera, "--out",
                        f"{camera}.png")
        self.assertNotEqual(self.bytes_of("main.png"), self.bytes_of("steps.png"))

    def test_an_exr_is_written(self):
        self.expect(0, "render", "builtin:plain", *SMALL, "--out", "deep/light.exr")
        self.assertTrue(self.bytes_of("deep/light.exr").startswith(b"\x76\x2f\x31\x01"))

    # Hard case: program.nan_pixels
    def test_stats_hold_the_schema(self):
        self.expect(0, "render", "builtin:lanterns", *SMALL, *NO_SHADOWS, "--frames", "3", "--stats", "stats.json", "--quiet")
        stats = self.read_json("stats.json")
        self.assertEqual(set(stats), STATS)
        self.assertEqual((stats["version"], stats["scene"], stats["size"], stats["frames"]),
                         (1, "builtin:lanterns", [160, 90], 3))
        self.assertEqual(set(stats["device"]), {"name", "driver", "type", "subgroup_size"})
        for clock in ("cpu", "gpu", "wall"):
            times = stats["frame_ms"][clock]
            self.assertEqual(set(times), {"median", "p10", "p90"})
            self.assertLessEqual(times["p10"], times["median"])
            self.assertLessEqual(times["median"], times["p90"])
        self.assertGreater(stats["frame_ms"]["wall"]["median"], 0)
        self.assertTrue(stats["systems"])
        for row in stats["systems"]:
            self.assertEqual(set(row), {"name", "module", "median_ms", "p90_ms", "calls"})
        self.assertTrue(stats["passes"])
        for row in stats["passes"]:
            self.assertEqual(set(row), {"name", "module", "median_ms", "p90_ms", "dispatches", "draws"})
        for row in stats["memory"]:
            self.assertEqual(set(row), {"module", "gpu_bytes"})
        totals = stats["gpu_memory"]
        self.assertEqual(set(totals), {"used_bytes", "reserved_bytes", "blocks"})
        self.assertEqual(totals["used_bytes"], sum(row["gpu_bytes"] for row in stats["memory"]))
        self.assertGreaterEqual(totals["reserved_bytes"], totals["used_bytes"])
        for row in stats["modules"]:
            self.assertEqual(set(row), {"name", "demanded", "reason", "pipelines"})
            if not row["demanded"]:
                self.assertEqual(row["pipelines"], 0, row)
        self.assertEqual(stats["counters"]["nan_pixels"], 0)
        self.assertEqual(stats["counters"]["lights.total"], 256)

    def test_a_trace_holds_systems_and_passes(self):
        self.expect(0, "render", "builtin:plain", *SMALL, "--trace", "trace.json")
        categories = {event.get("cat") for event in self.read_json("trace.json")["traceEvents"]}
        self.assertIn("engine", categories)

    def gpu_frames(self, trace):
        """The passes of a trace by frame as (begin, end) in µs, with the span of the frame."""
        events = trace["traceEvents"]
        row = next(e["tid"] for e in events if e["ph"] == "M" and e["args"]["name"] == "GPU")
        begins = [e["ts"] for e in events if e["ph"] == "b"]
        ends = [e["ts"] for e in events if e["ph"] == "e"]
        frames = [[] for _ in begins]
        frame = -1
        for event in events:
            if event["ph"] == "b":
                frame += 1
            elif event["ph"] == "X" and event["tid"] == row:
                frames[frame].append((event["ts"], event["ts"] + event["dur"]))
        return list(zip(begins, ends, frames))

    def test_a_trace_shows_when_passes_begin_and_end(self):
        slack = 0.002  # µs: times are whole nanoseconds in a double
        for in_flight in ("1", "2"):
            self.expect(0, "render", "builtin:shadows", *SMALL, "--frames", "4", "--in-flight", in_flight, "--trace",
                        "trace.json", "--stats", "stats.json")
            in_turn = self.read_json("stats.json")["device"]["type"] == "cpu"  # DeviceInfo::threads_in_turn
            trace = self.read_json("trace.json")
            frames = self.gpu_frames(trace)
            self.assertEqual(len(frames), 4)
            records = [e for e in trace["traceEvents"] if e["name"] == "record_passes"]
            self.assertEqual(len(records), 4)
            before = 0.0
            for (begin, end, passes), record in zip(frames, records):
                self.assertGreater(len(passes), 10)
                self.assertGreaterEqual(record["ts"], begin)
                self.assertGreaterEqual(passes[0][0], record["ts"] + record["dur"] - slack, "a pass begins before it is recorded")
                self.assertLessEqual(passes[-1][1], end + slack)
                for first, last in passes:
                    self.assertGreaterEqual(first, before - slack, "two passes overlap")
                    self.assertGreaterEqual(last, first)
                    before = last
                gaps = sum(b[0] - a[1] for a, b in zip(passes, passes[1:]))
                if in_turn:  # nothing runs between two passes: each begins where the last one has ended
                    self.assertAlmostEqual(gaps, 0.0, delta=slack * len(passes))
                else:
                    self.assertGreater(gaps, 0.0, "barriers take no time")

    # Hard case: passes.two_in_flight, selftest.in_flight
    def test_frames_in_flight_do_not_change_the_picture(self):
        for in_flight in ("1", "2"):
            self.expect(0, "render", "builtin:shadows", *SMALL, "--frames", "5", "--in-flight", in_flight, "--out",
                        f"{in_flight}.png", "--stats", f"{in_flight}.json")
        self.assertEqual(self.bytes_of("1.png"), self.bytes_of("2.png"))
        one, two = self.read_json("1.json"), self.read_json("2.json")
        self.assertEqual(set(one), STATS)
        self.assertEqual(set(two), STATS | {"in_flight"})
        self.assertEqual(two["in_flight"], 2)
        self.assertEqual(one["counters"], two["counters"])
        names = [[(p["name"], p["dispatches"], p["draws"]) for p in stats["passes"]] for stats in (one, two)]
        self.assertEqual(names[0], names[1])
        for stats in (one, two):
            self.assertGreater(stats["frame_ms"]["wall"]["p10"], 0)
            self.assertGreater(stats["frame_ms"]["gpu"]["p10"], 0)
            # A frame is never faster than the GPU's part of it.
            self.assertGreaterEqual(stats["frame_ms"]["wall"]["median"] * 1.02, stats["frame_ms"]["gpu"]["median"])

    def test_a_pixel_can_be_asked_about(self):
        self.assertTrue(self.expect(0, "render", "builtin:plain", *SMALL, "--pick", "80,80", "--quiet").stdout.strip())

    def test_a_pixel_tells_its_tile_bins_and_light_lists(self):
        picked = self.expect(0, "render", "builtin:lanterns", *SMALL, *NO_SHADOWS, "--pick", "80,80", "--quiet").stdout
        for line in (r"^pixel 80,80 of tile 10,10$", r"^shadow tile 10,10 of tile group 1,1, mask tile 2,2$",
                     r"^zBin \d+ of the pixel: standard .*, ranged .*$", r"^view depths of the tile [\d.]+ to [\d.]+ m$",
                     r"^zBins \d+ to \d+ of the tile: (standard|ranged) \[\d+,\d+\)$", r"^mask tile: \d+ lights: \d+ light \d+",
                     r"^candidates \(mask and zBins\): \d+ lights?", r"^approximate search, tile group: \d+ lights?",
                     r"^approximate search, tile: \d+$", r"^accurate search: \d+ lights?", r"^slot \d+$",
                     r"^local lights in range of the pixel: \d+ lights?"):
            self.assertRegex(picked, re.compile(line, re.MULTILINE))

    def test_light_views_are_drawn_without_a_word_of_the_validation(self):
        pictures = set()
        for view in LIGHT_VIEWS:
            run = self.run_program("render", "builtin:lanterns", *SMALL, "--view", view, "--validate", "--out", "view.png",
                                   *NO_SHADOWS)
            if run.returncode != 0 and "layer" in run.stderr:
                self.skipTest(run.stderr.strip())
            self.assertEqual((run.returncode, run.stderr), (0, ""), view)
            pictures.add(self.bytes_of("view.png"))
        self.assertEqual(len(pictures), len(LIGHT_VIEWS))

    def test_references_of_fog_and_glare_are_views(self):
        for view in ("fog_reference", "glare_reference"):
            run = self.run_program("render", "builtin:dusk", *SMALL, *NO_SHADOWS, "--view", view, "--validate", "--out", f"{view}.png")
            if run.returncode != 0 and "layer" in run.stderr:
                self.skipTest(run.stderr.strip())
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertNotIn("VUID", run.stderr)
        self.assertNotEqual(self.bytes_of("fog_reference.png"), self.bytes_of("glare_reference.png"))

    def test_views_of_lights_need_a_light_and_lists(self):
        self.expect(2, "render", "builtin:lanterns", *SMALL, "--view", "light_list:nobody", says="nobody")
        self.expect(2, "render", "builtin:lanterns", *SMALL, "--view", "light_culling", says="light_culling")
        for view in LIGHT_VIEWS:
            self.expect(2, "render", "builtin:lanterns", *SMALL, "--view", view, "--set", "lights.culling=brute", says="tiled")

    def test_effects_without_a_light_are_drawn(self):
        for extras in ({"gloam.closeup": True}, {"gloam.particles": "smoke"}, {"gloam.grass.density": 500},
                       {"gloam.cube_probe.global": True}, {"gloam.fog.density": 0.1}):
            node = {"mesh": 0, "name": "leaf", "extras": extras}
            camera = {"camera": 0, "name": "eye", "translation": [0, 0, 3], "extras": {"gloam.dof.focus": 1.0}}
            (self.folder / "dark.gltf").write_text(json.dumps({**TRIANGLE, "nodes": [node, camera]}), encoding="utf-8")
            self.expect(0, "render", "dark.gltf", "--set", "scene.default_light=off", "--size", "64x36", "--frames", "2",
                        "--out", "dark.png")

    def test_a_numbered_name_writes_all_frames_of_a_sequence(self):
        frames = ("--frames", "3", "--time", "0.5", "--dt", "0.1")
        self.expect(0, "render", "builtin:meadow", *SMALL, *frames, "--out", "out/frame_%03d.png")
        self.expect(0, "render", "builtin:meadow", *SMALL, *frames, "--out", "last.png")
        names = sorted(path.name for path in (self.folder / "out").iterdir())
        self.assertEqual(names, ["frame_000.png", "frame_001.png", "frame_002.png"])
        pictures = [(self.folder / "out" / name).read_bytes() for name in names]
        self.assertTrue(pictures[2] == (self.folder / "last.png").read_bytes(), "the last frame of a run is the same")
        self.assertFalse(pictures[0] == pictures[2], "wind moves the grass")

    def test_a_fitting_range_of_counts_ends_at_5_so_that_one_and_two_lights_have_colours_of_the_scale(self):
        """Two local lights. The scale's colours are at 0, 1 … 5: blue for one light, cyan for two."""
        self.expect(0, "render", "builtin:shadows", *SMALL, "--view", "lights_accurate", "--set", "views.range=fit", "--out", "v.png")
        picture = read_png(self.folder / "v.png")
        colors = [picture.pixel(x, y) for y in range(40) for x in range(160)]  # above the legend
        srgb = lambda *linear: tuple(round(255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055)) for c in linear)
        for lights, color in ((1, srgb(0.02, 0.05, 0.6)), (2, srgb(0.0, 0.45, 0.6))):
            near = sum(all(abs(a - b) <= 1 for a, b in zip(color, shown)) for shown in colors)
            self.assertGreater(near, 50, f"pixels with {lights} lights")

    def test_a_sequence_has_one_exposure(self):
        (self.folder / "lamp.gltf").write_text(json.dumps(approaching_lamp()), encoding="utf-8")
        run = ("render", "lamp.gltf", "--size", "64x36")
        self.expect(0, *run, "--frames", "2", "--dt", "1", "--out", "frame_%02d.png")
        self.expect(0, *run, "--time", "1", "--out", "alone.png")
        first, second, alone = (read_png(self.folder / name).mean() for name in ("frame_00.png", "frame_01.png", "alone.png"))
        self.assertGreater(second, 1.5 * first, "the lamp is nearer")
        self.assertGreater(second, 1.2 * alone, "by itself the frame is exposed for its own light")

    # Hard case: program.wrong_usage
    def test_unknown_knobs_views_and_cameras_are_wrong_usage(self):
        (self.folder / "bad.json").write_text('{"no.such": 1}')
        for option in (("--set", "no.such=1"), ("--view", "no_such"), ("--camera", "nobody"), ("--config", "absent.json"),
                       ("--config", "bad.json"), ("--animation", "walk")):
            self.expect(2, "render", "builtin:plain", *SMALL, *option)

    # Hard case: program.no_device
    def test_no_such_device_is_4(self):
        self.expect(4, "render", "builtin:plain", "--device", "no such device")

    def test_a_place_that_cannot_be_written_is_1(self):
        (self.folder / "file").write_text("")
        for option in (("--out", "file/a.png"), ("--stats", "file/s.json"), ("--trace", "file/t.json")):
            self.expect(1, "render", "builtin:plain", *SMALL, *option)
        if os.path.exists("/dev/full"):
            os.symlink("/dev/full", self.folder / "full.png")
            self.expect(1, "render", "builtin:plain", *SMALL, "--out", "full.png")

    def test_validation_has_nothing_to_say(self):
        run = self.run_program("render", "builtin:shadows", *SMALL, "--frames", "3", "--validate")
        if run.returncode != 0 and "layer" in run.stderr:
            self.skipTest(run.stderr.strip())
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    main()
