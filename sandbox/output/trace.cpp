// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/trace.h"

#include <set>

#include "sandbox/output/json_writer.h"

namespace gloam {
namespace {

constexpr int kProcess = 1;
constexpr int kGpuRow = 1000;  // above any thread number

void begin_event(JsonWriter& json, std::string_view name, std::string_view category, double begin_us,
                 double duration_us, std::int64_t row) {
  json.begin_object().key("name").text(name).key("cat").text(category).key("ph").text("X");
  json.key("ts").number(begin_us).key("dur").number(duration_us).key("pid").integer(kProcess).key("tid").integer(row);
}

void write_row_name(JsonWriter& json, std::int64_t row, const std::string& name) {
  json.begin_object()
      .key("name")
      .text("thread_name")
      .key("ph")
      .text("M")
      .key("pid")
      .integer(kProcess)
      .key("tid")
      .integer(row);
  json.key("args").begin_object().key("name").text(name).end_object().end_object();
}

void write_zones(JsonWriter& json, const FrameSample& sample) {
  for (const Zone& zone : sample.zones) {
    const auto begin_us = static_cast<double>(zone.begin_ns) * 1e-3;
    const auto duration_us = static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-3;
    begin_event(json, zone.name, zone.module, begin_us, duration_us, zone.thread);
    json.end_object();
  }
}

void write_passes(JsonWriter& json, const FrameSample& sample) {
  double begin_us = static_cast<double>(sample.begin_ns) * 1e-3;
  for (const PassTime& pass : sample.report.passes) {
    begin_event(json, pass.name, pass.module, begin_us, pass.ms * 1e3, kGpuRow);
    json.key("args")
        .begin_object()
        .key("dispatches")
        .integer(pass.dispatches)
        .key("draws")
        .integer(pass.draws)
        .end_object();
    json.end_object();
    begin_us += pass.ms * 1e3;
  }
}

}  // namespace

std::string chrome_trace(std::span<const FrameSample> samples) {
  JsonWriter json;
  json.begin_object().key("displayTimeUnit").text("ms").key("traceEvents").begin_array();
  std::set<std::uint32_t> threads;
  for (const FrameSample& sample : samples) {
    for (const Zone& zone : sample.zones) threads.insert(zone.thread);
  }
  for (const std::uint32_t thread : threads) write_row_name(json, thread, "CPU " + std::to_string(thread));
  write_row_name(json, kGpuRow, "GPU");
  for (const FrameSample& sample : samples) {
    write_zones(json, sample);
    write_passes(json, sample);
  }
  json.end_array().end_object();
  return json.finish();
}

}  // namespace gloam
