// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"

namespace gloam {

/// What the shadows module leaves for a view, for shaders that include shaders/shadows/shadows_api.glsl. On the board only when shadows are
/// to be looked at.
struct ShadowsOutputs {
  gpu::Binding::BufferRange block;  ///< a ShadowBlock (shaders/shadows/shadows_shared.h), uniform
  ImageRef rows;                    ///< rgba32f, GLOAM_SHADOW_ROW_TEXELS × local lights: ShadowRow
  ImageRef atlas;                   ///< r32f or r16_unorm: depth of all faces and their mips
  ImageRef pyramid;                 ///< rg32f: farthest and nearest depth
  ImageRef cookies;  ///< rgba8_srgb, an array: cookies of spot lights; one white layer when there is none
  ImageRef
      traced;  ///< r8_unorm, an array: visibility a light and pixel that a reference has traced; the cookies' image when there is none
  gpu::SamplerHandle nearest;
  gpu::SamplerHandle linear;

  /// No light asks for a map or traced visibility: shaders may take cookies_api.glsl in place of shadows_api.glsl, many times smaller.
  bool cookies_only = false;
  /// The filter is what GLOAM_SHADOWS_STANDARD compiles, half as large.
  bool standard = false;
  /// GLOAM_SHADOWS_…_ID, the same for every shader of the frame. `variant` names them, for names of pipelines.
  std::vector<gpu::SpecConstant> constants;
  std::string variant;
};

void declare_shadow_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
/// Bindings that shadows_api.glsl takes, from number `first` on: block, rows, atlas, pyramid, cookies, traced.
void append_shadow_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows);

/// The same for shaders that include cookies_api.glsl when shadows.cookies_only, else shadows_api.glsl. The former takes block, rows, cookies.
void declare_arriving_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
void append_arriving_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                              const ShadowsOutputs& shadows);

}  // namespace gloam
