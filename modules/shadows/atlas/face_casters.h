// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/frustum.h"
#include "engine/render/draws/casters.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"

namespace gloam {

/// What a face may see, relative to its origin and in the world's axes.
struct FaceVolume {
  dvec3 origin = dvec3(0.0);  ///< world
  Frustum frustum;
  float reach_m = 0.0f;  ///< radius round the origin beyond which nothing is lit; 0: without one
};
[[nodiscard]] FaceVolume face_volume(const ShadowFace& face);
/// The part of it that is drawn into these texels, and a texel more at each side.
[[nodiscard]] FaceVolume face_volume(const ShadowFace& face, const TexelRect& region);

/// The box relative to `origin`, widened by what GPU and CPU may lose of its place.
[[nodiscard]] CasterBox relative_box(const dvec3& origin, const CasterBox& box);

/// Whether a caster may be drawn into the face; false only when it certainly is not.
[[nodiscard]] bool may_see(const FaceVolume& volume, const Caster& caster);
[[nodiscard]] bool may_see(const FaceVolume& volume, const CasterBox& box);

/// From a caster's mesh to the face's clip space, composed in double relative to the light.
[[nodiscard]] mat4 clip_from_mesh(const ShadowFace& face, const dmat4& world_from_mesh);

/// One run of a caster's triangles.
struct FaceDraw {
  const Caster* caster = nullptr;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};
/// Clusters that the face may see, as few runs as they make; opaque casters come before cut-out ones. `simplified`:
/// those that have fewer triangles for it (GpuPrimitive::simplified_index_count) are drawn so, whole. `withheld`:
/// casters that are left out, as WithheldCasters::of gives them.
[[nodiscard]] std::vector<FaceDraw> face_draws(const FaceVolume& volume, std::span<const Caster> casters,
                                               bool simplified = false, std::span<const Entity> withheld = {});

[[nodiscard]] bool is_cut_out(const Caster& caster);

}  // namespace gloam
