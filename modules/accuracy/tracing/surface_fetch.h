// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/assets.h"
#include "modules/accuracy/tracing/scene_triangles.h"
#include "modules/accuracy/tracing/texture_fetch.h"

namespace gloam {

/// A point of a mesh that a ray met.
struct SurfaceHit {
  const std::uint32_t* corners = nullptr;  ///< three positions of the primitive
  vec3 share = vec3(0.0f);                 ///< weights of the corners, sum 1
  vec3 winding_normal = vec3(0.0f);        ///< of the triangle, seen counter-clockwise; any length
  vec3 direction = vec3(0.0f);             ///< of the ray
};

/// Whether the mesh has a back: rays pass through the back of materials that are not double-sided.
[[nodiscard]] bool is_double_sided(const SceneAssets& assets, const SurfaceSource& source);

/// Sets normals and material of a surface.
void fetch_surface(const SceneAssets& assets, const SurfaceSource& source, const SurfaceHit& hit,
                   const TextureFetch& textures, TracedSurface& surface);

}  // namespace gloam
