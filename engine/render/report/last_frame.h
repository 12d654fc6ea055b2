// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/frame_report.h"
#include "engine/render/modules_in_use/module_set.h"

namespace gloam {

/// The counters of a view whose passes were declared: those of the engine, and of the modules that take part in it.
[[nodiscard]] ViewCounters count_view(const ModuleSet& modules, const FrameBuilder& builder);

/// What a renderer reports of the last frame beside the figures that the frame graph and the device keep.
class LastFrame {
 public:
  double cpu_ms = 0.0;             ///< of the last call of Renderer::render
  std::uint64_t submitted_ns = 0;  ///< FrameReport::submitted_ns
  std::size_t assets_pending = 0;  ///< FrameReport::assets_pending
  bool kept = false;               ///< FrameReport::kept

  bool spreads_work = false;  ///< a view spreads work over frames (Module::spreads_work)

  /// Notes the counters of a submitted frame, a view each. results: what the frame has requested.
  void commit(std::vector<ViewCounters> views, const FrameResults& results);

  /// Everything that Renderer::report returns.
  [[nodiscard]] FrameReport report(const ModuleSet& modules, FrameResources& resources,
                                   const gpu::Device& device) const;

 private:
  /// The counters of the last view. Those that the GPU counts are of the newest completed frame.
  [[nodiscard]] std::map<std::string, double> counters(const ModuleList& modules, const FrameResults& results) const;

  std::vector<ViewCounters> views_;
  std::vector<ResultKey> counted_results_;  ///< of the last view
};

}  // namespace gloam
