# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests `bench`: ids, rows as JSON, bars."""
from program_case import NO_DEVICE, ProgramCase, main

FIELDS = {"id", "value", "unit", "p10", "p90", "better", "holds", "hash"}


class Bench(ProgramCase):
    # Hard case: program.bench_ids
    def test_ids_are_listed_once_each(self):
        ids = self.expect(0, "bench", "--list").stdout.split()
        self.assertEqual(len(ids), len(set(ids)))
        for an_id in ("jobs.empty", "jobs.empty.one_thread", "ecs.iterate2.1e4", "ecs.random_get_over_bare", "frame.scene",
                      "shadows.table1.deferred_8_closeups", "shadows.table1.deferred_8_closeups_all_over_monolithic",
                      "reflections.tiled_over_naive", "reflections.curve.tiles.16", "reflections.error.wet_street.still.ssr+cube.flip",
                      "reflections.temporal.all.reprojected", "dof.radius15.none", "dof.radius15.vec4", "dof.radius15.channels",
                      "dof.hexagonal.radius31.channels", "dof.frame_over_gathers", "dof.error.round.half.flip"):
            self.assertIn(an_id, ids)

    def test_rows_have_the_documented_fields(self):
        self.expect(0, "bench", "jobs.fork_join", "ecs.random_get", "--json", "deep/rows.json")
        told = self.read_json("deep/rows.json")
        self.assertEqual(told["version"], 1)
        self.assertEqual(told["scene"], "builtin:lanterns")
        self.assertEqual(told["size"], [1280, 720])
        self.assertEqual(set(told["device"]), {"name", "driver", "type", "subgroup_size"})
        self.assertEqual([row["id"] for row in told["rows"]], ["ecs.random_get", "jobs.fork_join"])
        for row in told["rows"]:
            self.assertEqual(set(row) - {"bar"}, FIELDS)
            self.assertGreater(row["value"], 0)
            self.assertLessEqual(row["p10"], row["p90"])
            self.assertIn(row["better"], ("lower", "higher"))

    def test_what_is_computed_does_not_depend_on_the_run(self):
        hashes = []
        for _ in range(2):
            self.expect(0, "bench", "ecs.iterate2.1e4", "--quiet", "--json", "rows.json")
            hashes.append([row["hash"] for row in self.read_json("rows.json")["rows"]])
        self.assertEqual(hashes[0], hashes[1])

    def test_rows_of_lights_have_a_scene_of_their_own_unless_one_is_named(self):
        self.require_device()
        names = ("lights.culling_errors", "lights.capacity_violations", "lights.false_positives.rect")
        self.expect(0, "bench", *names, "--size", "96x54", "--strict", "--json", "rows.json")
        rows = {row["id"]: row for row in self.read_json("rows.json")["rows"]}
        self.assertEqual({row["scene"] for row in rows.values()}, {"builtin:many_lights"})
        self.assertEqual(rows["lights.culling_errors"]["value"], 0)
        phases = [rows[f"lights.false_positives.rect.{phase}"]["value"] for phase in ("mask", "candidates", "approx")]
        self.assertEqual(phases, sorted(phases, reverse=True), "each phase drops lights")
        self.assertGreaterEqual(phases[-1], 0)
        self.expect(0, "bench", names[0], "--size", "96x54", "--scene", "builtin:lanterns", "--json", "rows.json")
        self.assertNotIn("scene", self.read_json("rows.json")["rows"][0])

    def test_rows_of_papers_stand_under_their_table_beside_the_papers_figure(self):
        names = ("papers.ff.light_lists.masks_of_tiles", "papers.ff.light_lists.masks_of_groups")
        said = self.expect(0, "bench", *names, "--json", "rows.json").stdout
        self.assertEqual(said.count("FF section 2"), 1)
        self.assertRegex(said, r"masks_of_groups.4k +0.2568 MiB.*; paper: 0.3 MB")
        tiles, groups = self.read_json("rows.json")["rows"]
        self.assertEqual(groups["paper"], {"value": 0.3, "unit": "MB"})
        # 3840 x 2160: 480 x 270 shadow tiles of 8, 60 x 34 groups of 8 x 8 of them; masks of 1024 + 32 bits.
        self.assertAlmostEqual(tiles["value"] * 2**20, 480 * 270 * 132)
        self.assertAlmostEqual(groups["value"] * 2**20, 60 * 34 * 132)

    def test_the_shadowed_share_of_the_picture_is_what_the_row_says(self):
        self.require_device()
        self.expect(0, "bench", "shadows.exposure", "--size", "96x54", "--quiet", "--json", "rows.json")
        rows = {row["id"]: row["value"] for row in self.read_json("rows.json")["rows"]}
        for percent in (0, 25, 50, 100):
            share = rows[f"shadows.exposure.share.{percent}.shadowed"]
            self.assertAlmostEqual(share, percent / 100, delta=0.05, msg=percent)
        for side in (256, 512, 1024, 2048):
            self.assertGreater(rows[f"shadows.exposure.map.{side}.shadowed"], 0.98, side)

    def test_frames_with_savings_show_the_same_picture_and_take_less_time_at_rest(self):
        self.require_device()
        names = [f"frame.{motion}.scene" for motion in ("rest", "moving")]
        self.expect(0, "bench", *names, "frame.rest.lanterns", "--scene", "builtin:shadows", "--size", "96x54", "--json", "rows.json")
        told = self.read_json("rows.json")
        self.assertIn("frame.rest.lanterns", [row["id"] for row in told["skipped"]], "--scene names another scene")
        rows = {row["id"]: row for row in told["rows"]}
        for name in names:
            self.assertEqual(rows[f"{name}.differs"]["value"], 0, name)
            self.assertGreater(rows[f"{name}.ms"]["value"], 0, name)
        self.assertNotEqual(rows[f"{names[0]}.ms"]["hash"], rows[f"{names[1]}.ms"]["hash"], "a moving camera ends elsewhere")
        # Nothing changes, so the GPU draws nothing. A frame that is drawn takes many times as long.
        self.assertLess(rows[names[0]]["value"], 0.5)

    def test_a_failing_row_leaves_the_rows_before_it(self):
        run = self.expect(NO_DEVICE, "bench", "jobs.fork_join", "frame.scene", "--json", "rows.json",
                          env={"VK_ICD_FILENAMES": "/nonexistent", "VK_DRIVER_FILES": "/nonexistent"})
        self.assertIn("jobs.fork_join", run.stdout)
        self.assertEqual([row["id"] for row in self.read_json("rows.json")["rows"]], ["jobs.fork_join"])

    def test_rows_of_changed_entities_have_hashes_that_tell_them_apart(self):
        self.expect(0, "bench", "ecs.create", "ecs.add", "ecs.remove", "ecs.destroy", "--quiet", "--json", "rows.json")
        hashes = [row["hash"] for row in self.read_json("rows.json")["rows"]]
        self.assertEqual(len(set(hashes)), 4, hashes)

    def test_more_proxies_take_longer_to_put_into_tiles(self):
        self.expect(0, "bench", "reflections.cpu.proxy_tiles", "--quiet", "--json", "rows.json")
        few, many = self.read_json("rows.json")["rows"]
        self.assertLess(few["value"], many["value"])
        self.assertNotEqual(few["hash"], many["hash"])

    def test_a_row_without_its_scene_is_skipped_with_a_reason(self):
        self.folder = self.folder / "without"  # a working folder without ../shared
        self.folder.mkdir()
        run = self.expect(0, "bench", "reflections.bake.courtyard", "--strict", "--json", "rows.json")
        self.assertIn("skipped: ", run.stdout)
        told = self.read_json("rows.json")
        self.assertEqual(told["rows"], [])
        self.assertEqual([row["id"] for row in told["skipped"]], ["reflections.bake.courtyard"])

    # Hard case: program.bench_missed
    def test_a_missed_bar_fails_only_when_it_shall(self):
        # One thread is never 1.6 times as fast as one.
        missed = ("bench", "lights.cpu_two_workers", "--threads", "1")
        self.assertIn("MISSED", self.expect(0, *missed, "--json", "rows.json").stdout)
        self.assertFalse(self.read_json("rows.json")["rows"][0]["holds"])
        self.expect(1, *missed, "--strict", says="bars missed: lights.cpu_two_workers")

    def test_quiet_prints_nothing(self):
        self.assertEqual(self.expect(0, "bench", "jobs.fork_join", "--quiet").stdout, "")


if __name__ == "__main__":
    main()
