// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/lights/outputs.h"

namespace gloam {

/// Inputs of all shading, created once per frame and put on the board.
struct ShadingInputs {
  gpu::Binding::BufferRange lights;       ///< LightBlock; without lights if the scene has none
  gpu::Binding::BufferRange environment;  ///< EnvironmentConstants
  std::uint32_t directional_count = 0;
  LightsOutputs outputs;  ///< of the lights module; default values if the scene has no light
};

/// The frame's ShadingInputs from the board; the first call creates them.
[[nodiscard]] Result<ShadingInputs> shading_inputs(FrameBuilder& frame);

}  // namespace gloam
