// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/lights/outputs.h"

namespace gloam {

/// Inputs of all shading, created once per frame and put on the board.
struct ShadingInputs {
  gpu::Binding::BufferRange environment;  ///< EnvironmentConstants
  std::uint32_t directional_count = 0;
  bool specular_ambient_taken = false;  ///< see SpecularAmbientTaken
  bool diffuse_light_wanted = false;    ///< see DiffuseLightWanted
  bool transmission = false;            ///< lets_light_through()
  bool plain_highlights = false;        ///< of points at points: neither lights nor pixels have a width
  /// Of the lights module. If the scene has no light: a block without lights, and default values.
  LightsOutputs outputs;
};

/// ShadingInputs::plain_highlights
[[nodiscard]] bool plain_highlights(const KnobRegistry& knobs);

/// The frame's ShadingInputs from the board; the first call creates them.
[[nodiscard]] const ShadingInputs& shading_inputs(FrameBuilder& frame);

}  // namespace gloam
