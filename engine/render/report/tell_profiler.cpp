// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/report/tell_profiler.h"

namespace gloam {

void tell_profiler(Profiler& profiler, FrameGraph& graph, const FrameReport& report, std::uint64_t frame) {
  for (const GpuFrameTimes& times : graph.take_times_for_profiler())
    for (const PassTime& pass : times.passes) {
      if (pass.end_ns == 0) continue;  // not timed
      profiler.gpu_span(
          {pass.name, pass.module, times.frame, pass.begin_ns, pass.end_ns, pass.view, pass.dispatches, pass.draws});
    }
  for (const auto& [name, value] : report.counters) profiler.counter(name, value);
  for (const ModuleState& module : report.modules)
    profiler.counter("memory." + module.name, static_cast<double>(module.gpu_bytes));
  profiler.counter("cpu_ms", report.cpu_ms);
  profiler.counter("gpu_ms", report.gpu_ms);
  profiler.frame_end(frame);
}

}  // namespace gloam
