// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"

namespace gloam {

struct ModuleState {
  std::string name;
  bool demanded = false;
  std::string reason;
  std::uint32_t pipelines = 0;
  std::uint64_t gpu_bytes = 0;
};

/// Counters of one view of the last frame, by name.
struct ViewCounters {
  ViewId view{0};
  std::map<std::string, double> counters;
};

/// Cost of the last call of `render`. GPU figures are of the newest completed frame (after `wait`: of the last frame).
struct FrameReport {
  double cpu_ms = 0.0;  ///< systems, declaration and recording
  double gpu_ms = 0.0;
  std::vector<PassTime> passes;
  /// Nothing has changed, so that the GPU has drawn nothing (scene.reuse). Pictures, results and counters are those of
  /// the frames before, and GPU figures are of the last frame that was drawn.
  bool kept = false;
  /// When the last frame was given to the GPU: ZoneRecorder::now_ns just before; 0 without a recorder.
  std::uint64_t submitted_ns = 0;
  gpu::MemoryTotals gpu_memory;      ///< of the device, used and reserved
  std::vector<ModuleState> modules;  ///< "engine" first, then in list order
  /// Counters of the last view; counters from the GPU are of the newest completed frame.
  std::map<std::string, double> counters;
  std::vector<ViewCounters> views;   ///< counters of each view, in order; those that are known on the CPU
  std::uint64_t plans_compiled = 0;  ///< FrameGraph::plans_compiled, since the renderer was made
  /// Pipelines being compiled in the background; until then, frames leave passes out or use slower ones.
  std::size_t pipelines_pending = 0;
  /// Name of the one whose compilation in the background began last; empty if none is pending.
  std::string pipeline_made;
  /// Meshes and images of the world drawn last that are not shown as they are in SceneAssets yet.
  std::size_t assets_pending = 0;
};

}  // namespace gloam
