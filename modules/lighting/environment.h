// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/lights/outputs.h"

namespace gloam {

/// Uniform blocks that all shading reads: put on the frame's board once.
struct ShadingInputs {
  gpu::Binding::BufferRange lights;       ///< LightBlock; empty when the scene has no light
  gpu::Binding::BufferRange environment;  ///< EnvironmentConstants
  std::uint32_t directional_count = 0;
  LightsOutputs outputs;  ///< of the lights module; without anything when the scene has no light
};

[[nodiscard]] Result<ShadingInputs> shading_inputs(FrameBuilder& frame);

}  // namespace gloam
