// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/reflections/reference/emissive_quad.h"

namespace gloam {

/// The fires of a world (IbrProxyKind::fire) as quads for reflected rays. Movable; the quads refer to the images.
struct FireQuads {
  std::vector<std::vector<vec4>> images;
  std::vector<EmissiveQuad> quads;  ///< by layer of ReflectionCaptures::proxies
};

/// The fires of the world's ReflectionCaptures at full resolution. dim: factor of a layer's radiance, as tiers use it;
/// below 1 it scales the alpha, too; a fire with 0 is left out. Empty: 1.
[[nodiscard]] FireQuads gather_fire_quads(const World& world,
                                          const std::function<float(std::uint32_t layer)>& dim = {});

}  // namespace gloam
