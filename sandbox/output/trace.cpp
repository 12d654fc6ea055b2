// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/trace.h"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "sandbox/output/json_text.h"

namespace gloam {
namespace {

constexpr int kProcess = 1;
constexpr std::uint32_t kGpuRow = 1000;  // above any thread number

Json event_json(const std::string& name, const std::string& category, double begin_us, double duration_us,
                std::uint32_t row) {
  Json event = {{"name", name}, {"cat", category}, {"ph", "X"}, {"ts", begin_us}, {"dur", duration_us}};
  event["pid"] = kProcess;
  event["tid"] = row;
  return event;
}

Json row_name_json(std::uint32_t row, const std::string& name) {
  return {{"name", "thread_name"}, {"ph", "M"}, {"pid", kProcess}, {"tid", row}, {"args", {{"name", name}}}};
}

void add_zones(Json& events, const FrameSample& sample) {
  for (const Zone& zone : sample.zones) {
    const auto begin_us = static_cast<double>(zone.begin_ns) * 1e-3;
    const auto duration_us = static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-3;
    events.push_back(event_json(zone.name, zone.module, begin_us, duration_us, zone.thread));
  }
}

void add_passes(Json& events, const FrameSample& sample) {
  double begin_us = static_cast<double>(sample.begin_ns) * 1e-3;
  for (const PassTime& pass : sample.report.passes) {
    Json event = event_json(pass.name, pass.module, begin_us, pass.ms * 1e3, kGpuRow);
    event["args"] = {{"dispatches", pass.dispatches}, {"draws", pass.draws}};
    events.push_back(std::move(event));
    begin_us += pass.ms * 1e3;
  }
}

}  // namespace

std::string chrome_trace(std::span<const FrameSample> samples) {
  std::set<std::uint32_t> threads;
  for (const FrameSample& sample : samples) {
    for (const Zone& zone : sample.zones) threads.insert(zone.thread);
  }
  Json events = Json::array();
  for (const std::uint32_t thread : threads) events.push_back(row_name_json(thread, "CPU " + std::to_string(thread)));
  events.push_back(row_name_json(kGpuRow, "GPU"));
  for (const FrameSample& sample : samples) {
    add_zones(events, sample);
    add_passes(events, sample);
  }
  return json_text({{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}});
}

}  // namespace gloam
