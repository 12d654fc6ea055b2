// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/stats.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/session/summary.h"

namespace gloam {
namespace {

/// Times of one name of one module over the frames.
struct TimedRow {
  std::string name;
  std::string module;
  std::vector<double> frame_ms;  ///< one a frame in which it ran
  std::size_t last_frame = 0;
  std::uint64_t calls = 0;  ///< in the last frame in which it ran, as the next two
  std::uint64_t dispatches = 0;
  std::uint64_t draws = 0;
};

/// Rows in order of first appearance.
class RowTable {
 public:
  void add(std::size_t frame, const std::string& name, const std::string& module, double ms, std::uint32_t dispatches,
           std::uint32_t draws) {
    const auto [found, is_new] = index_.try_emplace({module, name}, rows_.size());
    if (is_new) rows_.push_back({.name = name, .module = module});
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
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
};

void write_summary(JsonWriter& json, std::string_view name, const Summary& summary) {
  json.key(name).begin_object();
  json.key("median").number(summary.median).key("p10").number(summary.p10).key("p90").number(summary.p90);
  json.end_object();
}

void write_frame_times(JsonWriter& json, std::span<const FrameSample> measured) {
  std::vector<double> cpu;
  std::vector<double> gpu;
  std::vector<double> wall;
  for (const FrameSample& sample : measured) {
    cpu.push_back(sample.report.cpu_ms);
    gpu.push_back(sample.report.gpu_ms);
    wall.push_back(sample.wall_ms());
  }
  json.key("frame_ms").begin_object();
  write_summary(json, "cpu", summarize(std::move(cpu)));
  write_summary(json, "gpu", summarize(std::move(gpu)));
  write_summary(json, "wall", summarize(std::move(wall)));
  json.end_object();
}

void begin_row(JsonWriter& json, const TimedRow& row) {
  const Summary summary = summarize(row.frame_ms);
  json.begin_object().key("name").text(row.name).key("module").text(row.module);
  json.key("median_ms").number(summary.median).key("p90_ms").number(summary.p90);
}

void write_systems(JsonWriter& json, std::span<const FrameSample> measured) {
  RowTable table;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    for (const Zone& zone : measured[frame].zones)
      table.add(frame, zone.name, zone.module, static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-6, 0, 0);
  }
  json.key("systems").begin_array();
  for (const TimedRow& row : table.rows()) {
    begin_row(json, row);
    json.key("calls").integer(static_cast<std::int64_t>(row.calls)).end_object();
  }
  json.end_array();
}

void write_passes(JsonWriter& json, std::span<const FrameSample> measured) {
  RowTable table;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    for (const PassTime& pass : measured[frame].report.passes)
      table.add(frame, pass.name, pass.module, pass.ms, pass.dispatches, pass.draws);
  }
  json.key("passes").begin_array();
  for (const TimedRow& row : table.rows()) {
    begin_row(json, row);
    json.key("dispatches").integer(static_cast<std::int64_t>(row.dispatches));
    json.key("draws").integer(static_cast<std::int64_t>(row.draws)).end_object();
  }
  json.end_array();
}

void write_modules(JsonWriter& json, const FrameReport& last) {
  json.key("memory").begin_array();
  for (const ModuleState& module : last.modules) {
    json.begin_object().key("module").text(module.name);
    json.key("gpu_bytes").integer(static_cast<std::int64_t>(module.gpu_bytes));
    json.key("cpu_bytes").integer(static_cast<std::int64_t>(module.cpu_bytes)).end_object();
  }
  json.end_array().key("modules").begin_array();
  for (const ModuleState& module : last.modules) {
    json.begin_object().key("name").text(module.name).key("demanded").boolean(module.demanded);
    json.key("reason").text(module.reason).key("pipelines").integer(module.pipelines).end_object();
  }
  json.end_array();
}

void write_knobs(JsonWriter& json, const KnobRegistry& knobs) {
  json.key("knobs").begin_object();
  for (const Knob& knob : knobs.knobs()) {
    json.key(knob.name);
    if (knob.type == Knob::Type::choice) {
      json.text(knobs.text(knob.name));
    } else {
      json.number(knobs.number(knob.name));
    }
  }
  json.end_object();
}

}  // namespace

void write_device(JsonWriter& json, const gpu::DeviceInfo& device) {
  json.key("device").begin_object();
  json.key("name").text(device.name).key("driver").text(device.driver);
  json.key("type").text(device.name.empty() ? std::string_view("none") : gpu::name_of(device.type));
  json.key("subgroup_size").integer(device.subgroup_size).end_object();
}

std::string stats_json(const RunDescription& run, std::span<const FrameSample> samples,
                       const std::map<std::string, double>& extra_counters, const KnobRegistry& knobs) {
  GLOAM_ASSERT(!samples.empty(), "stats are of at least one frame");
  const std::span<const FrameSample> measured = samples.size() > 1 ? samples.subspan(1) : samples;
  const FrameReport& last = samples.back().report;

  JsonWriter json;
  json.begin_object().key("version").integer(1).key("scene").text(run.scene);
  write_device(json, run.device);
  json.key("size").begin_array().integer(run.width).integer(run.height).end_array();
  json.key("frames").integer(static_cast<std::int64_t>(samples.size()));
  write_frame_times(json, measured);
  write_systems(json, measured);
  write_passes(json, measured);
  write_modules(json, last);

  std::map<std::string, double> counters = last.counters;
  counters.insert(extra_counters.begin(), extra_counters.end());
  json.key("counters").begin_object();
  for (const auto& [name, value] : counters) json.key(name).number(value);
  json.end_object();
  write_knobs(json, knobs);
  json.end_object();
  return json.finish();
}

std::uint64_t count_nan_pixels(std::span<const float> rgba) {
  std::uint64_t count = 0;
  for (std::size_t pixel = 0; pixel + 4 <= rgba.size(); pixel += 4) {
    const float* const c = rgba.data() + pixel;
    if (std::isnan(c[0]) || std::isnan(c[1]) || std::isnan(c[2]) || std::isnan(c[3])) ++count;
  }
  return count;
}

}  // namespace gloam
