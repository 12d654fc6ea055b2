// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/shader_pass.h"
#include "engine/render/frame_builder.h"
#include "modules/lights/outputs.h"

namespace gloam {

/// Inputs of all shading, created once per frame and put on the board.
struct ShadingInputs {
  gpu::Binding::BufferRange environment;  ///< EnvironmentConstants, as surfaces get them
  gpu::Binding::BufferRange sky;          ///< EnvironmentConstants, as they are seen
  std::uint32_t directional_count = 0;
  bool specular_ambient_taken = false;     ///< see SpecularAmbientTaken
  bool diffuse_light_wanted = false;       ///< see DiffuseLightWanted
  bool surroundings_follow = false;        ///< there is a SurroundingsOutput
  bool reflects = false;                   ///< there are SurroundingProbes, perhaps without rows
  std::uint32_t probes = 0;                ///< rows
  gpu::Binding::BufferRange surroundings;  ///< SurroundingsConstants
  gpu::Binding::BufferRange probe_rows;
  gpu::Binding::BufferRange capture_factors;
  ImageRef probe_images;
  std::uint32_t indirect = 0;                    ///< kIndirect of shaders/lighting/indirect_api.glsl
  gpu::Binding::BufferRange indirect_constants;  ///< IndirectConstants; null without probes
  gpu::Binding::BufferRange diffuse_probes;
  ImageRef traced_indirect;       ///< null: none
  bool transmission = false;      ///< lets_light_through()
  bool occlusion = false;         ///< there is an AmbientOcclusion
  bool plain_highlights = false;  ///< of points at points: neither lights nor pixels have a width
  /// Of the lights module. If the scene has no light: a block without lights, and default values.
  LightsOutputs outputs;
};

/// ShadingInputs::plain_highlights
[[nodiscard]] bool plain_highlights(const KnobRegistry& knobs);

/// The frame's ShadingInputs from the board; the first call creates them.
[[nodiscard]] const ShadingInputs& shading_inputs(FrameBuilder& frame);

/// kIndirect of indirect_api.glsl.
[[nodiscard]] gpu::SpecConstants indirect_constants(const ShadingInputs& inputs);

/// Constants of surroundings_api.glsl. reflects: there are SurroundingProbes; probes: their rows.
[[nodiscard]] gpu::SpecConstants surroundings_constants(bool reflects, std::size_t probes);

}  // namespace gloam
