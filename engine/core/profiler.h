// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace gloam {

/// The work of one pass in one completed frame on the GPU.
struct GpuSpan {
  std::string_view name;
  std::string_view module;
  std::uint64_t frame = 0;     ///< gpu::Device::frame_number
  std::uint64_t begin_ns = 0;  ///< by the GPU's clock, as gpu::Device::timestamps
  std::uint64_t end_ns = 0;
  std::uint32_t view = 0;  ///< FrameGraph::set_view
  std::uint32_t dispatches = 0;
  std::uint32_t draws = 0;
};

/// Receives what gloam measures, as it happens: a host implements it to see gloam in its own profiler. The functions
/// must not throw. Texts are valid during the call only.
class Profiler {
 public:
  virtual ~Profiler() = default;
  /// A span of work on the calling thread begins: a system, or a step of the frame. Called from any thread. The zones
  /// of a thread nest.
  virtual void begin_zone(std::string_view name, std::string_view module) = 0;
  /// The zone that has begun last on the calling thread ends.
  virtual void end_zone() = 0;
  /// A pass has ended on the GPU. Called on the thread that renders, for all passes of a frame in their order, about
  /// two frames later.
  virtual void gpu_span(const GpuSpan& /*span*/) {}
  /// The value of a counter (FrameReport::counters), of "memory.MODULE" in bytes, "cpu_ms" or "gpu_ms", after each
  /// frame. Called on the thread that renders.
  virtual void counter(std::string_view /*name*/, double /*value*/) {}
  /// A frame was given to the GPU, or kept (FrameReport::kept). number: of these frames, from 1. Called on the thread
  /// that renders, after the frame's counters.
  virtual void frame_end(std::uint64_t /*number*/) {}
};

/// A zone from its construction to its destruction. `profiler`: null records nothing. All must outlive the object.
class ScopedZone {
 public:
  ScopedZone(Profiler* profiler, std::string_view name, std::string_view module) : profiler_(profiler) {
    if (profiler_ != nullptr) profiler_->begin_zone(name, module);
  }
  ~ScopedZone() {
    if (profiler_ != nullptr) profiler_->end_zone();
  }
  ScopedZone(const ScopedZone&) = delete;
  ScopedZone& operator=(const ScopedZone&) = delete;

 private:
  Profiler* profiler_;
};

/// Passes the zones on to two profilers; either may be null.
class ZonesForBoth final : public Profiler {
 public:
  ZonesForBoth(Profiler* first, Profiler* second) : first_(first), second_(second) {}
  void begin_zone(std::string_view name, std::string_view module) override {
    for (Profiler* profiler : {first_, second_})
      if (profiler != nullptr) profiler->begin_zone(name, module);
  }
  void end_zone() override {
    for (Profiler* profiler : {second_, first_})
      if (profiler != nullptr) profiler->end_zone();
  }

 private:
  Profiler* first_;
  Profiler* second_;
};

}  // namespace gloam
