// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/gpu/types.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/scene/assets.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

inline constexpr std::size_t kMaterialStride = 256;  ///< bytes between materials' constants

[[nodiscard]] shaders::MaterialConstants pack_material(const Material& material);
/// GLOAM_SURFACE_… bits of a material.
[[nodiscard]] std::uint32_t surface_features(const Material& material);
[[nodiscard]] gpu::SamplerDesc sampler_desc(const Texture& texture);
/// The pass that fills the geometry buffer, with GeometryOutputs::motion as the fifth target or without it.
[[nodiscard]] const SurfacePass& geometry_surface_pass(bool motion = false);

}  // namespace gloam
