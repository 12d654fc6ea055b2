// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/ecs/world.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Roughness from which on surfaces show probes alone; as kTooRough in shaders/lighting/mirror_share_api.glsl.
inline constexpr float kTooRoughForMirrors = 0.49f;

/// How a material can take part in reflections.
enum class Reflective : std::uint8_t {
  no,      ///< reflectivity 0
  rough,   ///< shows probes alone; also smooth blended surfaces
  mirror,  ///< smooth enough for screen space and proxies
};

/// Looks at factors only: a texture may make every texel rougher or less metallic than that.
[[nodiscard]] Reflective reflective(const Material& material);

/// The materials that the world's meshes use, by Reflective.
struct ReflectiveMaterials {
  std::uint32_t rough = 0;
  std::uint32_t mirror = 0;
};
[[nodiscard]] ReflectiveMaterials count_reflective(const SceneAssets& assets);

/// The strongest of the materials that a view draws.
[[nodiscard]] Reflective strongest_reflection(const SceneAssets& assets, const ViewDraws& draws);

}  // namespace gloam
