// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/stats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/session/results/summary.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMainView = 0;

/// Times of one system or pass over all frames, identified by module, name and, for passes, view.
struct TimedRow {
  std::string name;
  std::string module;
  std::uint32_t view = 0;        ///< ViewId
  std::vector<double> frame_ms;  ///< one per frame in which it ran
  std::size_t last_frame = 0;
  std::uint64_t calls = 0;  ///< in the last frame in which it ran; so are dispatches and draws
  std::uint64_t dispatches = 0;
  std::uint64_t draws = 0;
};

/// All rows, in the order of their first appearance.
class RowTable {
 public:
  void add(std::size_t frame, const std::string& name, const std::string& module, double ms, std::uint32_t dispatches,
           std::uint32_t draws, std::uint32_t view = 0) {
    const auto [found, is_new] = index_.try_emplace({module, name, view}, rows_.size());
    if (is_new) rows_.push_back({.name = name, .module = module, .view = view});
    TimedRow& row = rows_[found->second];
    if (is_new || row.last_frame != frame) {
      row.frame_ms.push_back(0.0);
      row.last_frame = frame;
      row.calls = row.dispatches = row.draws = 0;
    }
    row.frame_ms.back() += ms;
    row.calls += 1;
    row.dispatches += dispatches;
    row.draws += draws;
  }
  [[nodiscard]] const std::vector<TimedRow>& rows() const { return rows_; }

 private:
  std::vector<TimedRow> rows_;
  std::map<std::tuple<std::string, std::string, std::uint32_t>, std::size_t> index_;
};

Json summary_json(const Summary& summary) {
  return {{"median", summary.median}, {"p10", summary.p10}, {"p90", summary.p90}};
}

Json frame_times_json(std::span<const FrameSample> measured) {
  std::vector<double> cpu;
  std::vector<double> gpu;
  std::vector<double> wall;
  for (const FrameSample& sample : measured) {
    cpu.push_back(sample.report.cpu_ms);
    gpu.push_back(sample.report.gpu_ms);
    wall.push_back(sample.wall_ms());
  }
  return {{"cpu", summary_json(summarize(std::move(cpu)))},
          {"gpu", summary_json(summarize(std::move(gpu)))},
          {"wall", summary_json(summarize(std::move(wall)))}};
}

Json row_json(const TimedRow& row) {
  const Summary summary = summarize(row.frame_ms);
  return {{"name", row.name}, {"module", row.module}, {"median_ms", summary.median}, {"p90_ms", summary.p90}};
}

Json systems_json(std::span<const FrameSample> measured) {
  RowTable table;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    for (const Zone& zone : measured[frame].zones)
      table.add(frame, zone.name, zone.module, static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-6, 0, 0);
  }
  Json systems = Json::array();
  for (const TimedRow& row : table.rows()) {
    systems.push_back(row_json(row));
    systems.back()["calls"] = row.calls;
  }
  return systems;
}

Json passes_json(std::span<const FrameSample> measured) {
  RowTable table;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    for (const PassTime& pass : measured[frame].report.passes)
      table.add(frame, pass.name, pass.module, pass.ms, pass.dispatches, pass.draws, pass.view);
  }
  Json passes = Json::array();
  for (const TimedRow& row : table.rows()) {
    passes.push_back(row_json(row));
    passes.back()["dispatches"] = row.dispatches;
    passes.back()["draws"] = row.draws;
    if (row.view != kMainView) passes.back()["view"] = row.view;
  }
  return passes;
}

Json memory_json(const FrameReport& last) {
  Json memory = Json::array();
  for (const ModuleState& module : last.modules)
    memory.push_back({{"module", module.name}, {"gpu_bytes", module.gpu_bytes}});
  return memory;
}

Json modules_json(const FrameReport& last) {
  Json modules = Json::array();
  for (const ModuleState& module : last.modules) {
    modules.push_back({{"name", module.name},
                       {"demanded", module.demanded},
                       {"reason", module.reason},
                       {"pipelines", module.pipelines}});
  }
  return modules;
}

Json budget_json(const BudgetState& budget) {
  Json settings = Json::object();
  for (const KnobOverride& setting : budget.settings) settings[setting.name] = setting.value;
  return {{"ms", budget.ms},           {"points", budget.points}, {"point", budget.point},
          {"changes", budget.changes}, {"error", budget.error},   {"settings", std::move(settings)}};
}

Json knobs_json(const KnobRegistry& registry) {
  Json knobs = Json::object();
  for (const Knob& knob : registry.knobs()) {
    const bool choice = knob.type == Knob::Type::choice;
    knobs[knob.name] = choice ? Json(registry.text(knob)) : Json(registry.number(knob));
  }
  return knobs;
}

}  // namespace

Json device_json(const gpu::DeviceInfo& device) {
  return {{"name", device.name},
          {"driver", device.driver},
          {"type", device.name.empty() ? std::string_view("none") : gpu::name_of(device.type)},
          {"subgroup_size", device.subgroup_size}};
}

std::string stats_json(const RunDescription& run, std::span<const FrameSample> samples,
                       const std::map<std::string, double>& extra_counters, const KnobRegistry& knobs) {
  GLOAM_ASSERT(!samples.empty(), "stats are of at least one frame");
  const std::span<const FrameSample> measured = samples.size() > 1 ? samples.subspan(1) : samples;
  const FrameReport& last = samples.back().report;
  std::map<std::string, double> counters = last.counters;
  counters.insert(extra_counters.begin(), extra_counters.end());

  Json json = {{"version", 1}, {"scene", run.scene}, {"device", device_json(run.device)}};
  json["size"] = {run.width, run.height};
  json["frames"] = samples.size();
  if (run.in_flight != 1) json["in_flight"] = run.in_flight;
  json["frame_ms"] = frame_times_json(measured);
  json["systems"] = systems_json(measured);
  json["passes"] = passes_json(measured);
  json["memory"] = memory_json(last);
  json["gpu_memory"] = {{"used_bytes", last.gpu_memory.used},
                        {"reserved_bytes", last.gpu_memory.reserved},
                        {"blocks", last.gpu_memory.blocks}};
  json["modules"] = modules_json(last);
  json["counters"] = counters;
  json["knobs"] = knobs_json(knobs);
  for (const BudgetState& budget : run.budgets) {
    if (budget.effect.empty() || !json.contains("budget")) json["budget"] = budget_json(budget);
    if (!budget.effect.empty()) json["effect_budgets"][budget.effect] = budget_json(budget);
  }
  return json_text(json);
}

std::uint64_t count_nan_pixels(std::span<const float> rgba) {
  std::uint64_t count = 0;
  for (std::size_t pixel = 0; pixel + 4 <= rgba.size(); pixel += 4) {
    const float* const c = rgba.data() + pixel;
    if (!std::ranges::all_of(c, c + 4, [](float channel) { return std::isfinite(channel); })) ++count;
  }
  return count;
}

}  // namespace gloam
