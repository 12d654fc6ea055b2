// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/frustum.h"
#include "engine/render/draws/caster_source.h"
#include "engine/render/draws/casters.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"

namespace gloam {

/// The volume that a face may see, relative to its origin, in world axes.
struct FaceVolume {
  dvec3 origin = dvec3(0.0);  ///< world
  Frustum frustum;
  float reach_m = 0.0f;         ///< radius around the origin beyond which nothing is lit; 0: unlimited
  float bulb_radius_m = -1.0f;  ///< ShadowFace::bulb_radius_m
  float clear_m = 0.0f;         ///< the near plane cuts nothing that is farther from the origin; orthographic: 0
};
[[nodiscard]] FaceVolume face_volume(const ShadowFace& face);
/// The part of the volume that is drawn into these texels, widened by one texel on each side.
[[nodiscard]] FaceVolume face_volume(const ShadowFace& face, const TexelRect& region);

/// The box relative to `origin`, widened by the rounding of GPU and CPU transforms.
[[nodiscard]] CasterBox relative_box(const dvec3& origin, const CasterBox& box);

/// Whether a caster may be drawn into the face. Conservative: false only when it certainly is not. False for the bulbs
/// of the face's light (is_bulb()).
[[nodiscard]] bool may_see(const FaceVolume& volume, const Caster& caster);
[[nodiscard]] bool may_see(const FaceVolume& volume, const CasterBox& box);

/// The face's projection.
[[nodiscard]] CasterProjection projection_of(const ShadowFace& face);
/// The transform from a caster's mesh to the face's clip space, composed in double relative to the light.
[[nodiscard]] mat4 clip_from_mesh(const ShadowFace& face, const dmat4& world_from_mesh);

/// One range of a caster's indices that is drawn.
struct FaceDraw {
  const Caster* caster = nullptr;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  bool fronts_only = false;  ///< the map is the same without the triangles that face away from the light
  bool backs_only = false;   ///< drawn without the triangles that face the light
  float error_m = 0.0f;      ///< greatest distance of the triangles from the caster's surface
};
/// The transform of a draw. Triangles with an error are moved away from the light by it, along its rays: nowhere do
/// they stand before the caster's surface by more than the slope bias of maps covers.
[[nodiscard]] mat4 clip_from_mesh(const ShadowFace& face, const FaceDraw& draw);

/// The triangles of casters that are drawn.
struct CasterForm {
  bool simplified = false;  ///< casters with simplified triangles (GpuPrimitive::simplified_index_count) are drawn with
                            ///< those, whole
  bool subsurface_backs = false;  ///< closed casters with a subsurface material are drawn without their lit side
  /// Casters are drawn with the coarsest level (Caster::levels) whose error is at most this many of the face's texels
  /// at the caster. The choice depends on face and caster only, so all regions of a face agree.
  float lod_texels = 0.0f;
};
/// The draws of all clusters that the face may see; adjacent clusters share a draw. Opaque casters come before cut-out
/// ones. volume: of the face, or of a part. withheld: casters that are left out, a result of WithheldCasters::of().
[[nodiscard]] std::vector<FaceDraw> face_draws(const ShadowFace& face, const FaceVolume& volume,
                                               std::span<const Caster> casters, const CasterForm& form = {},
                                               std::span<const Entity> withheld = {});

/// Whether the caster's alpha is tested.
[[nodiscard]] bool is_cut_out(const Caster& caster);

}  // namespace gloam
