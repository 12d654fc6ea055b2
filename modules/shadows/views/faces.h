// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "modules/shadows/outputs.h"

namespace gloam {

/// Three unit vectors at right angles; those of a mirrored node are left-handed.
struct FaceAxes {
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
};

/// Axes of a light on the node: forward along the node's −Z, right along its X as far as shear allows, up on the side
/// of its Y. A column without a direction (zero, not finite, or parallel to another one) is replaced by any fitting
/// axis. A −Z without a direction becomes the world's −Z, as in shading.
[[nodiscard]] FaceAxes node_axes(const dmat4& world_from_node);

/// Axes in the world of cube face 0 … 5, as defined in shadows_shared.h.
[[nodiscard]] FaceAxes cube_axes(std::uint32_t face);

/// The cube face that a direction from the light (world, not zero) falls on: the face of the cube axis (GLOAM_CUBE_X …)
/// along which the direction's component is greatest.
[[nodiscard]] std::uint32_t cube_face_of(const dvec3& direction);

/// How a point or spot light casts shadows.
struct LocalShadow {
  std::uint32_t kind = GLOAM_SHADOW_NONE;  ///< GLOAM_SHADOW_NONE, _SPOT or _CUBE
  dvec3 position = dvec3(0.0);             ///< world
  FaceAxes axes;                           ///< the node's axes; a cube's faces use cube_axes()
  float range_m = 0.0f;
  float near_m = 0.0f;              ///< ShadowFace::near_m of all faces
  float clip_share = 1.0f;          ///< ShadowFace::clip_share
  float emitter_diameter_m = 0.0f;  ///< ≥ 0
  float bulb_radius_m = 0.0f;       ///< ShadowFace::bulb_radius_m
  float tan_inner = 1.0f;           ///< tangent of half a face's field of view, without the rim
  float tan_half = 1.0f;            ///< the same with the rim
  float cookie_tan = 1.0f;          ///< tangent of the half angle that a cookie fills

  [[nodiscard]] std::uint32_t face_count() const {
    return kind == GLOAM_SHADOW_CUBE ? 6 : kind == GLOAM_SHADOW_SPOT ? 1 : 0;
  }
};

/// Near plane of a local light's faces, as a share of its range. Depths are near / depth in floats, so their precision
/// does not depend on the near plane.
inline constexpr float kNearShare = 0x1p-44f;
/// In maps of 16 bits: ShadowFace::near_m as a share of the range. A greater one would lose near shadows, a smaller one
/// the depths of far surfaces.
inline constexpr float kNearShare16 = 0x1p-8f;

/// How the light casts shadows. kernel_rim: ShadowSettings::kernel_rim. d16: maps have 16 bits. Kind none for
/// directional lights, and when the position or the cone angle is not finite; axes and cookie_tan are valid in any
/// case.
[[nodiscard]] LocalShadow local_shadow(const Light& light, const dmat4& world_from_node, float kernel_rim,
                                       bool d16 = false);

/// Face `index` < shadow.face_count(), not yet placed in the atlas.
[[nodiscard]] ShadowFace local_face(Entity light, const LocalShadow& shadow, std::uint32_t index);

/// The light's row for shaders. squares: the places of its faces, all of one size, or empty; empty gives kind none.
/// Cookie layer and traced layer are −1.
[[nodiscard]] shaders::ShadowRow shadow_row(const LocalShadow& shadow, std::span<const AtlasSquare> squares);

/// The projection of a point into a face.
struct FacePoint {
  double x = 0.0;        ///< texels from the left side of the face's square
  double y = 0.0;        ///< texels from its upper side
  double depth = 0.0;    ///< reversed depth, as in the map
  double along_m = 0.0;  ///< distance along the face's forward axis; orthographic: from the near side
};

/// Projects a world position. None if the face is perspective and the point is not in front of its light. For points
/// outside the square, nearer than the near plane or beyond the far plane, the coordinates lie outside the face's
/// limits.
[[nodiscard]] std::optional<FacePoint> project(const ShadowFace& face, const dvec3& world);

/// The world position at these texels of the face, along_m in front of its origin.
[[nodiscard]] dvec3 unproject(const ShadowFace& face, double x, double y, double along_m);

}  // namespace gloam
