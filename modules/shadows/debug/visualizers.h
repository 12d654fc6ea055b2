// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/maps/map_shared.h"

namespace gloam {

/// A full-screen visualizer of this module.
struct ShadowPicture {
  std::string pass;                             ///< name of the pass
  std::string values;                           ///< name of the exposed image of plain values
  gpu::Format format = gpu::Format::r32_float;  ///< of that image
  /// Without constant 0, which is added: whether the shader encodes sRGB. With blending it draws over the view's
  /// picture, otherwise in its place.
  DrawProgram program;
  std::span<const std::byte> push = {};     ///< push constants; none: the shader declares none
  const ShadowsOutputs* shadows = nullptr;  ///< bound in place of the board's
};
/// Adds the visualizer's pass. Binds what its shaders declare of the view's geometry, lights, shadows and final lists.
/// ShadowsOutputs must be on the board. Returns the version of the image of values that later passes read.
ImageRef draw_shadow_picture(FrameBuilder& frame, ShadowPicture picture);

/// A program that shows visibilities as they are drawn (shaders/shadows/debug/drawn_visibility.glsl): `from_lists` if
/// the frame has final lists, with their constants, otherwise `from_maps`.
[[nodiscard]] DrawProgram drawn_visibility_program(const ShadowsOutputs& shadows, const gpu::ShaderCode& from_maps,
                                                   const gpu::ShaderCode& from_lists);

/// The light's kind (GLOAM_SHADOWS_SPOTS, …), so that a shader can be compiled for it alone.
[[nodiscard]] std::uint32_t kind_of(const FrameBuilder& frame, const shaders::ShownLightConstants& light);

/// Names and legends of the visualizers of shadow maps.
[[nodiscard]] std::vector<VisualizerInfo> shadow_visualizers();

/// Adds the visualizer's pass if FrameBuilder::visualizer() is one of these. "shadow:LIGHT" draws one light's
/// visibility over the picture and into the exposed image "shadow_visibility" (r32f; −1 where the light does not
/// reach); "shadow_atlas" draws the frame's maps. With final lists, "shadow" shows the visibilities that they hold;
/// fallback tiles are evaluated as in shadows.mode=monolithic.
void add_shadow_view_pass(FrameBuilder& frame, const ShadowStates& states, OnceLog& once_log);

}  // namespace gloam
