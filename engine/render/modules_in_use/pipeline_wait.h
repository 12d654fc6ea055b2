// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/log.h"
#include "engine/gpu/types.h"
#include "engine/render/pipelines/pipelines.h"
#include "engine/render/renderer_options.h"

namespace gloam {

/// Whether frames wait for pipelines, and where missing ones are requested.
struct PipelineWait {
  Readiness readiness = Readiness::wait;
  Pipelines& pipelines;
  const gpu::DeviceInfo& device;
  LogSink& log;
};

}  // namespace gloam
