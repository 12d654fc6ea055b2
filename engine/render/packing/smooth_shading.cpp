// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/smooth_shading.h"

#include <cmath>
#include <cstddef>

namespace gloam {
namespace {

/// As kFlatSine in smooth_surface_api.glsl.
constexpr float kFlatSine = 2e-4f;

bool is_curved(vec3 normal, vec3 edge) { return std::abs(glm::dot(normal, edge)) > kFlatSine * glm::length(edge); }

}  // namespace

bool is_smooth_shaded(std::span<const vec3> positions, std::span<const vec3> normals,
                      std::span<const std::uint32_t> indices) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t at = indices[i + c], next = indices[i + (c + 1) % 3], last = indices[i + (c + 2) % 3];
      if (is_curved(normals[at], positions[next] - positions[at]) ||
          is_curved(normals[at], positions[last] - positions[at]))
        return true;
    }
  return false;
}

}  // namespace gloam
