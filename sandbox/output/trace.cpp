// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/trace.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// First begin and last end of a frame's timed passes, on the GPU's clock.
struct GpuSpan {
  std::uint64_t begin_ns = ~std::uint64_t{0};
  std::uint64_t end_ns = 0;
};

GpuSpan gpu_span(const FrameSample& sample) {
  GpuSpan span;
  for (const PassTime& pass : sample.report.passes) {
    if (pass.end_ns == 0) continue;
    span.begin_ns = std::min(span.begin_ns, pass.begin_ns);
    span.end_ns = std::max(span.end_ns, pass.end_ns);
  }
  return span;
}

std::int64_t difference(std::uint64_t a, std::uint64_t b) { return static_cast<std::int64_t>(a - b); }

/// Nanoseconds to add to the GPU's clock to get that of the zones. No frame begins on the GPU before it was submitted,
/// and none ends there after the CPU has seen its end. The least offset that meets the first rule is at most the
/// shortest delay between submission and begin too small.
std::int64_t gpu_offset_ns(std::span<const FrameSample> samples) {
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  std::int64_t greatest = std::numeric_limits<std::int64_t>::max();
  for (const FrameSample& sample : samples) {
    const GpuSpan span = gpu_span(sample);
    if (span.end_ns == 0) continue;
    least = std::max(least, difference(sample.report.submitted_ns, span.begin_ns));
    greatest = std::min(greatest, difference(sample.end_ns, span.end_ns));
  }
  return std::min(least, greatest);
}

void add_passes(Json& events, const FrameSample& sample, std::int64_t offset_ns) {
  for (const PassTime& pass : sample.report.passes) {
    if (pass.end_ns == 0) continue;  // not timed
    const auto begin_ns = static_cast<std::int64_t>(pass.begin_ns) + offset_ns;
    const auto begin_us = static_cast<double>(begin_ns) * 1e-3;
    const auto duration_us = static_cast<double>(pass.end_ns - pass.begin_ns) * 1e-3;
    Json event = event_json(pass.name, pass.module, begin_us, duration_us, kGpuRow);
    event["args"] = {{"dispatches", pass.dispatches}, {"draws", pass.draws}};
    events.push_back(std::move(event));
  }
}

/// The span of a frame as a pair of asynchronous events: frames in flight overlap.
void add_span(Json& events, const FrameSample& sample, std::size_t index) {
  for (const auto& [phase, ns] : {std::pair("b", sample.begin_ns), std::pair("e", sample.end_ns)}) {
    Json event = {{"name", "frame " + std::to_string(index)}, {"cat", "frame"}, {"ph", phase}, {"id", index}};
    event["ts"] = static_cast<double>(ns) * 1e-3;
    event["pid"] = kProcess;
    event["tid"] = kGpuRow;
    events.push_back(std::move(event));
  }
}

}  // namespace

std::string chrome_trace(std::span<const FrameSample> samples) {
  std::set<std::uint32_t> threads;
  for (const FrameSample& sample : samples) {
    for (const Zone& zone : sample.zones) threads.insert(zone.thread);
  }
  Json events = Json::array();
  events.push_back({{"name", "process_name"}, {"ph", "M"}, {"pid", kProcess}, {"args", {{"name", "gloam"}}}});
  for (const std::uint32_t thread : threads) events.push_back(row_name_json(thread, "CPU " + std::to_string(thread)));
  events.push_back(row_name_json(kGpuRow, "GPU"));
  const std::int64_t offset_ns = gpu_offset_ns(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    add_span(events, samples[i], i);
    add_zones(events, samples[i]);
    add_passes(events, samples[i], offset_ns);
  }
  return json_text({{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}});
}

}  // namespace gloam
