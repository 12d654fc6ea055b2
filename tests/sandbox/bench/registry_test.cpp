// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/registry.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/report.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

BenchRow row(const std::string& id) { return {.id = id, .unit = "ms", .bar = {}, .better = Better::lower, .run = {}}; }

BenchRegistry some_rows() {
  BenchRegistry registry;
  for (const char* id : {"jobs.empty", "jobs.empty.one_thread", "jobs.fork_join", "jobsite.dig"}) registry.add(row(id));
  return registry;
}

std::vector<std::string> chosen(const std::vector<std::string>& names) {
  const BenchRegistry registry = some_rows();
  const auto rows = registry.choose(names);
  std::vector<std::string> ids;
  EXPECT_TRUE(rows.ok());
  if (rows.ok()) {
    for (const BenchRow* each : *rows) ids.push_back(each->id);
  }
  return ids;
}

TEST(BenchRegistry, a_name_chooses_what_starts_with_it_and_a_dot) {
  using Ids = std::vector<std::string>;
  EXPECT_EQ(chosen({"jobs"}), (Ids{"jobs.empty", "jobs.empty.one_thread", "jobs.fork_join"}));
  EXPECT_EQ(chosen({"jobs.empty"}), (Ids{"jobs.empty", "jobs.empty.one_thread"}));
  EXPECT_EQ(chosen({"jobs", "jobs.empty"}).size(), 3u);
}

TEST(BenchRegistry, an_unknown_name_is_wrong_usage) {
  const BenchRegistry registry = some_rows();
  for (const char* name : {"job", "jobs.", "jobs.emp", ""}) {
    const auto rows = registry.choose(std::vector<std::string>{"jobs", name});
    ASSERT_FALSE(rows.ok()) << name;
    EXPECT_EQ(rows.error().kind, ErrorKind::usage);
  }
  const auto fault = [&](const char* name) { return registry.choose(std::vector<std::string>{name}).error().message; };
  EXPECT_EQ(fault("jbos"), "there is no bench 'jbos'; did you mean jobs? gloam bench --list names them");
  EXPECT_EQ(fault("jobs.fork_jion"),
            "there is no bench 'jobs.fork_jion'; did you mean jobs.fork_join? gloam bench --list names them");
  EXPECT_EQ(fault("water"), "there is no bench 'water'; gloam bench --list names them");
}

// Hard case: program.bench_ids
TEST(BenchRegistry, ids_are_unique) {
  BenchRegistry registry = some_rows();
  EXPECT_ASSERT(registry.add(row("jobs.empty")), "unique");
}

TEST(BenchRegistry, a_bar_holds_on_its_better_side) {
  BenchRow lower = row("a");
  EXPECT_TRUE(keeps_bar(lower, 1e9));
  lower.bar = 0.5;
  EXPECT_TRUE(keeps_bar(lower, 0.5));
  EXPECT_FALSE(keeps_bar(lower, 0.6));
  lower.better = Better::higher;
  EXPECT_TRUE(keeps_bar(lower, 0.6));
  EXPECT_FALSE(keeps_bar(lower, 0.4));
}

TEST(BenchRegistry, a_value_that_only_informs_has_no_bar) {
  BenchRow barred = row("a");
  BenchValue value;
  EXPECT_FALSE(has_bar(barred, value));
  barred.bar = 0.5;
  EXPECT_TRUE(has_bar(barred, value));
  value.informs = true;
  EXPECT_FALSE(has_bar(barred, value));
}

TEST(BenchRegistry, the_programs_own_benches_have_the_documented_ids) {
  std::set<std::string> ids;
  const BenchRegistry registry = make_bench_registry();
  for (const BenchRow& each : registry.rows()) ids.insert(each.id);
  for (const char* id : {"iterate2.1e4", "iterate2.1e6", "iterate3_fragmented.10", "iterate3_fragmented.1024", "create",
                         "create_bulk", "destroy", "destroy_random", "add", "add_shuffled", "remove", "random_get"}) {
    EXPECT_TRUE(ids.contains("ecs." + std::string(id))) << id;
    EXPECT_TRUE(ids.contains("ecs." + std::string(id) + "_over_bare")) << id;
  }
  for (const char* id : {"empty", "empty.one_thread", "spawn", "parallel_for_efficiency", "graph_node", "fork_join"})
    EXPECT_TRUE(ids.contains("jobs." + std::string(id))) << id;
  for (const char* id :
       {"declare_100_passes", "static_transforms", "moving_transforms", "scene", "gather48", "scene_over_gather48"})
    EXPECT_TRUE(ids.contains("frame." + std::string(id))) << id;
  EXPECT_TRUE(ids.contains("ecs.random_get_over_unchecked_bare"));
}

TEST(BenchRegistry, cpu_rows_run_without_a_device_and_repeat_their_hash) {
  const BenchRegistry registry = make_bench_registry();
  const std::vector<std::string> names = {"jobs.spawn", "frame.declare_100_passes"};
  const auto rows = registry.choose(names);
  ASSERT_TRUE(rows.ok());
  const Options options;
  for (const BenchRow* row : *rows) {
    ASSERT_TRUE(row->bar.has_value()) << row->id;
    std::set<std::string> hashes;
    for (int run = 0; run < 2; ++run) {
      BenchContext context(options, null_log());
      const auto value = row->run(context);
      ASSERT_TRUE(value.ok()) << row->id << ": " << value.error().message;
      EXPECT_GT(value->value, 0.0) << row->id;
      hashes.insert(value->hash.value_or(""));
    }
    EXPECT_EQ(hashes.size(), 1u) << row->id;
    EXPECT_FALSE(hashes.contains("")) << row->id;
  }
}

TEST(BenchRegistry, has_the_rows_of_lights_on_the_gpu) {
  std::map<std::string, BenchRow> rows;
  const BenchRegistry registry = make_bench_registry();
  for (const BenchRow& each : registry.rows()) rows[each.id] = each;
  EXPECT_EQ(rows["lights.brute_over_tiled"].bar, 6.0);
  EXPECT_EQ(rows["lights.brute_over_tiled"].better, Better::higher);
  EXPECT_EQ(rows["lights.frame_1024_over_gather48"].bar, 3.2);
  EXPECT_EQ(rows["lights.culling_errors"].bar, 0.0);
  for (const char* id :
       {"gpu.approx_ms.64", "gpu.accurate_ms.256", "gpu.deferred_ms.1024", "false_positives.rect.mask",
        "false_positives.row_interval.candidates", "false_positives.cone.approx", "false_positives.z_bins.4096"})
    EXPECT_TRUE(rows.contains("lights." + std::string(id))) << id;
}

TEST(BenchRegistry, has_the_rows_of_deferred_shadows) {
  std::map<std::string, BenchRow> rows;
  const BenchRegistry registry = make_bench_registry();
  for (const BenchRow& each : registry.rows()) rows[each.id] = each;
  EXPECT_EQ(rows["shadows.table1.deferred_over_monolithic"].bar, 0.5);
  EXPECT_EQ(rows["shadows.table1.deferred_difference"].bar, 1.0);
  // With close-ups, the bar is for the row that includes their maps.
  EXPECT_EQ(rows["shadows.table1.deferred_8_closeups_all_over_monolithic"].bar, 0.9);
  EXPECT_FALSE(rows["shadows.table1.deferred_8_closeups_over_monolithic"].bar.has_value());
  EXPECT_EQ(rows["shadows.frame.over_gather48"].bar, 3.7);
  for (const char* id : {"lists_over_fixed.1080p", "lists_over_fixed.4k", "visibility_over_fixed.1080p",
                         "visibility_over_fixed.4k", "32_lights.lists_over_fixed.4k"}) {
    EXPECT_EQ(rows["shadows.memory." + std::string(id)].bar, 0.25) << id;
    EXPECT_EQ(rows["shadows.memory." + std::string(id)].unit, "ratio") << id;
  }
  for (const char* id :
       {"table1.monolithic", "table1.deferred", "table1.deferred_unclassified", "table1.deferred_8_closeups",
        "table1.deferred_8_closeups_all", "table1.deferred_8_closeups_over_monolithic", "figure13.classify",
        "table1.columns.deferred.shadow", "table1.subjects.deferred_8_closeups.closeup", "curve.lights.8.generate",
        "curve.size.1920x1080.monolithic", "frame.maps_share"})
    EXPECT_TRUE(rows.contains("shadows." + std::string(id))) << id;
}

TEST(BenchRegistry, has_the_rows_of_grass) {
  std::map<std::string, BenchRow> rows;
  const BenchRegistry registry = make_bench_registry();
  for (const BenchRow& each : registry.rows()) rows[each.id] = each;
  EXPECT_EQ(rows["grass.masters_1_4_over_full"].bar, 0.30);
  EXPECT_EQ(rows["grass.masters_1_4_over_full.lod"].bar, 0.30);
  EXPECT_EQ(rows["grass.lod.masters_over_live"].bar, 0.25);
  EXPECT_EQ(rows["grass.field_x10_same_live"].bar, 1.3);
  EXPECT_EQ(rows["grass.field_1m_over_100k"].bar, 1.3);
  EXPECT_EQ(rows["grass.sort_over_std_sort"].bar, 10.0);
  EXPECT_EQ(rows["grass.sort_over_std_sort"].better, Better::higher);
  EXPECT_EQ(rows["grass.frame.ms"].bar, 60.0);
  EXPECT_EQ(rows["grass.walk.temporal_over_no_lod"].bar, 1.1);
  for (const char* id : {"masters.1_2.tip_error_mean_mm",
                         "masters.1_16.tip_error_p99_mm",
                         "masters.1_1.ms",
                         "iterations.1.ms",
                         "iterations.8.tip_error_mean_mm",
                         "iterations.8.tip_error_p99_mm",
                         "frame.simulation_ms",
                         "frame.lod_ms",
                         "frame.drawing_ms",
                         "frame.live",
                         "cost.live_1k.sort_ms",
                         "cost.live_10k.lod_ms",
                         "cost.live_100k.simulation_ms",
                         "cost.live_1m.drawing_ms",
                         "field_x10.drawing_over_same_live",
                         "walk.flip",
                         "coverage_difference",
                         "types.3.ms",
                         "knots.24.stem_error_max_mm",
                         "types.5.same_neighbours",
                         "types.9.drawing_ms",
                         "dispatch.readback.simulation_ms",
                         "group.128.simulation_ms"})
    EXPECT_TRUE(rows.contains("grass." + std::string(id))) << id;
}

TEST(BenchReport, a_row_of_another_scene_names_it) {
  const BenchRow each = row("a.b");
  const std::vector<MeasuredRow> rows = {
      {&each, {.value = 1.0, .p10 = {}, .p90 = {}, .hash = {}, .scene = "builtin:other"}},
      {&each, {.value = 1.0, .p10 = {}, .p90 = {}, .hash = {}, .scene = "builtin:plain"}}};
  const auto json =
      nlohmann::json::parse(bench_json({.scene = "builtin:plain", .device = {}, .width = 64, .height = 32}, rows));
  EXPECT_EQ(json["rows"][0]["scene"], "builtin:other");
  EXPECT_FALSE(json["rows"][1].contains("scene"));
}

TEST(BenchReport, json_has_the_documented_fields) {
  BenchRow barred = row("a.b");
  barred.bar = 2.0;
  const BenchRow informing = row("a.c");
  const std::vector<MeasuredRow> rows = {{&barred, {.value = 2.5, .p10 = 2.0, .p90 = 3.0, .hash = "00ff"}},
                                         {&informing, {.value = 1.0, .p10 = {}, .p90 = {}, .hash = {}}}};
  const auto json =
      nlohmann::json::parse(bench_json({.scene = "builtin:plain", .device = {}, .width = 64, .height = 32}, rows));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["size"], nlohmann::json({64, 32}));
  EXPECT_EQ(json["scene"], "builtin:plain");
  EXPECT_EQ(json["device"]["type"], "none");
  EXPECT_EQ(json["rows"][0], nlohmann::json({{"id", "a.b"},
                                             {"value", 2.5},
                                             {"unit", "ms"},
                                             {"p10", 2.0},
                                             {"p90", 3.0},
                                             {"bar", 2.0},
                                             {"better", "lower"},
                                             {"holds", false},
                                             {"hash", "00ff"}}));
  EXPECT_FALSE(json["rows"][1].contains("bar"));
  EXPECT_EQ(json["rows"][1]["holds"], true);
  EXPECT_TRUE(json["rows"][1]["hash"].is_null());
  EXPECT_NE(bench_line(rows[0]).find("MISSED"), std::string::npos);
}

}  // namespace
}  // namespace gloam
