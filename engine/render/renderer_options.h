// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/log.h"
#include "engine/jobs/executor.h"
#include "engine/render/module.h"

namespace gloam {

class PipelineProgress;
class Profiler;
class ZoneRecorder;
namespace gpu {
class Device;
}

/// Number of frames for which a module without demand, or a view that is not drawn, keeps its memory.
inline constexpr std::uint32_t kFramesUntilRelease = 120;

/// Handling of a demanded module whose pipelines are not compiled yet.
enum class Readiness {
  wait,        ///< the frame waits for them: every demanded effect is in the first frame
  background,  ///< the module is left out until another thread has compiled them
};

struct RendererOptions {
  gpu::Device* device = nullptr;
  JobExecutor* executor = nullptr;
  LogSink* log = nullptr;
  ZoneRecorder* zones = nullptr;         ///< may be null
  Profiler* profiler = nullptr;          ///< may be null; must outlive the renderer's last call
  PipelineProgress* progress = nullptr;  ///< told of the pipelines that frames wait for; may be null
  ModuleList modules;                    ///< in the order of the module graph
  Readiness readiness = Readiness::wait;
  /// With Readiness::background: most bytes of changed meshes and images that one frame uploads, ≥ 1 (SceneAssets).
  /// With Readiness::wait a frame shows all changes that were made before it.
  std::uint64_t upload_budget = std::uint64_t{8} << 20;
};

}  // namespace gloam
