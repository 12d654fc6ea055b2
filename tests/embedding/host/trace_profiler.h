// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "engine/core/profiler.h"

namespace host {

/// A profiler of a host: it keeps what gloam tells, and writes it as a trace for chrome://tracing and Perfetto. An
/// adapter to another profiler has the same functions.
class TraceProfiler final : public gloam::Profiler {
 public:
  struct Span {
    std::string name, module;
    std::uint64_t begin_ns = 0, end_ns = 0;
    std::size_t depth = 0;  ///< of a zone: how many zones of its thread enclose it
    std::thread::id thread;
    std::uint64_t frame = 0;  ///< of a span of the GPU
  };

  void begin_zone(std::string_view name, std::string_view module) override {
    const std::uint64_t now = now_ns();
    const std::lock_guard lock(mutex_);
    std::vector<Span>& open = open_[std::this_thread::get_id()];
    open.push_back({std::string(name), std::string(module), now, now, open.size(), std::this_thread::get_id(), 0});
  }
  void end_zone() override {
    const std::uint64_t now = now_ns();
    const std::lock_guard lock(mutex_);
    std::vector<Span>& open = open_[std::this_thread::get_id()];
    if (open.empty()) {
      balanced_ = false;
      return;
    }
    open.back().end_ns = now;
    zones.push_back(open.back());
    open.pop_back();
  }
  void gpu_span(const gloam::GpuSpan& span) override {
    gpu.push_back({std::string(span.name), std::string(span.module), span.begin_ns, span.end_ns, 0, {}, span.frame});
  }
  void counter(std::string_view name, double value) override { counters[std::string(name)] = value; }
  void frame_end(std::uint64_t number) override { frames.push_back(number); }

  /// Whether every zone that has ended had begun, and all have ended.
  [[nodiscard]] bool balanced() const {
    for (const auto& [thread, open] : open_)
      if (!open.empty()) return false;
    return balanced_;
  }
  /// JSON: a row for each thread, and one for the GPU by its own clock.
  [[nodiscard]] std::string trace() const {
    std::string json = "[";
    std::map<std::thread::id, int> numbers;
    const auto add = [&](const Span& span, int row) {
      json += (json.size() > 1 ? ",\n" : "\n") + std::string(R"({"ph":"X","pid":1,"tid":)") + std::to_string(row) +
              R"(,"ts":)" + std::to_string(span.begin_ns / 1000) + R"(,"dur":)" +
              std::to_string((span.end_ns - span.begin_ns) / 1000) + R"(,"name":")" + span.name + R"(","cat":")" +
              span.module + "\"}";
    };
    for (const Span& zone : zones)
      add(zone, numbers.try_emplace(zone.thread, static_cast<int>(numbers.size()) + 1).first->second);
    for (const Span& span : gpu) add(span, 0);
    return json + "\n]\n";
  }

  std::vector<Span> zones;  ///< in the order of their ends
  std::vector<Span> gpu;
  std::map<std::string, double> counters;  ///< the newest values
  std::vector<std::uint64_t> frames;

 private:
  [[nodiscard]] static std::uint64_t now_ns() {
    return static_cast<std::uint64_t>(
        std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count());
  }

  std::mutex mutex_;
  std::map<std::thread::id, std::vector<Span>> open_;
  bool balanced_ = true;
};

}  // namespace host
