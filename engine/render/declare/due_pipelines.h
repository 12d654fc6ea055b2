// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>

#include "engine/core/result.h"
#include "engine/jobs/executor.h"
#include "engine/render/pipelines/pipeline_progress.h"
#include "engine/render/pipelines/pipelines.h"

namespace gloam::declare {

/// Pipelines that the passes of a frame need and that do not exist yet. They are compiled together between declaration
/// and recording, so that one frame's shaders are compiled by all cores.
class DuePipelines {
 public:
  void begin_frame() { due_.clear(); }
  /// The place of a pipeline's handle: null until make_all(). Valid until begin_frame().
  [[nodiscard]] const gpu::PipelineHandle* add(const gpu::ComputePipelineDesc& desc) { return add_any(desc); }
  [[nodiscard]] const gpu::PipelineHandle* add(const gpu::GraphicsPipelineDesc& desc) { return add_any(desc); }
  /// Compiles what was added since begin_frame(), largest shader first. On errors, the error of the pipeline added
  /// first. progress: may be null.
  [[nodiscard]] Status make_all(Pipelines& pipelines, JobExecutor& executor, PipelineProgress* progress);

 private:
  struct Due {
    std::uint64_t key = 0;
    PipelineList::value_type desc;
    gpu::PipelineHandle pipeline;
    Status status;
  };
  template <class Desc>
  [[nodiscard]] const gpu::PipelineHandle* add_any(const Desc& desc);

  std::deque<Due> due_;
};

}  // namespace gloam::declare
