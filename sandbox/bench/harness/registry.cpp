// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/registry.h"

#include <algorithm>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/text/nearest_name.h"
#include "sandbox/bench/harness/benches.h"

namespace gloam {
namespace {

bool is_chosen(std::string_view id, std::string_view name) {
  return id.starts_with(name) && (id.size() == name.size() || id[name.size()] == '.');
}

/// All names that `choose` takes: the ids, and each part of an id that ends before a dot.
std::vector<std::string> all_names(std::span<const BenchRow> rows) {
  std::vector<std::string> names;
  for (const BenchRow& row : rows) {
    for (std::size_t dot = row.id.find('.'); dot != std::string::npos; dot = row.id.find('.', dot + 1))
      names.push_back(row.id.substr(0, dot));
    names.push_back(row.id);
  }
  return names;
}

}  // namespace

void BenchRegistry::add(BenchRow row) {
  GLOAM_ASSERT(std::ranges::none_of(rows_, [&](const BenchRow& other) { return other.id == row.id; }),
               "ids of benches are unique");
  rows_.push_back(std::move(row));
}

Result<std::vector<const BenchRow*>> BenchRegistry::choose(std::span<const std::string> names) const {
  for (const std::string& name : names) {
    if (std::ranges::none_of(rows_, [&](const BenchRow& row) { return is_chosen(row.id, name); }))
      return Error{ErrorKind::usage, "there is no bench '" + name + "'; " + did_you_mean(name, all_names(rows_)) +
                                         "gloam bench --list names them"};
  }
  std::vector<const BenchRow*> chosen;
  for (const BenchRow& row : rows_) {
    if (std::ranges::any_of(names, [&](const std::string& name) { return is_chosen(row.id, name); }))
      chosen.push_back(&row);
  }
  return chosen;
}

bool has_bar(const BenchRow& row, const BenchValue& value) { return row.bar.has_value() && !value.informs; }

bool keeps_bar(const BenchRow& row, double value) {
  if (!row.bar) return true;
  return row.better == Better::lower ? value <= *row.bar : value >= *row.bar;
}

BenchRegistry make_bench_registry() {
  BenchRegistry registry;
  add_ecs_benches(registry);
  add_job_benches(registry);
  add_frame_declaration_benches(registry);
  add_transform_benches(registry);
  add_frame_benches(registry);
  add_frame_wall_benches(registry);
  add_frame_saving_benches(registry);
  add_frame_size_benches(registry);
  add_governor_benches(registry);
  add_frame_capture_benches(registry);
  add_asset_benches(registry);
  add_light_cpu_benches(registry);
  add_light_gpu_benches(registry);
  add_light_false_positive_benches(registry);
  add_shadow_benches(registry);
  add_shadow_deferred_benches(registry);
  add_shadow_memory_benches(registry);
  add_shadow_curve_benches(registry);
  add_shadow_frame_benches(registry);
  add_shadow_exposure_benches(registry);
  add_closeup_benches(registry);
  add_closeup_cost_benches(registry);
  add_closeup_flicker_benches(registry);
  add_reflection_tile_benches(registry);
  add_reflection_view_benches(registry);
  add_reflection_chain_benches(registry);
  add_reflection_cost_benches(registry);
  add_reflection_error_benches(registry);
  add_reflection_temporal_benches(registry);
  add_reflection_scene_benches(registry);
  add_grass_sort_benches(registry);
  add_grass_simulation_benches(registry);
  add_grass_field_benches(registry);
  add_grass_cost_benches(registry);
  add_grass_night_benches(registry);
  add_grass_walk_benches(registry);
  add_particle_cost_benches(registry);
  add_dof_cache_benches(registry);
  add_dof_frame_benches(registry);
  add_dof_error_benches(registry);
  add_glare_benches(registry);
  add_paper_benches(registry);
  return registry;
}

}  // namespace gloam
