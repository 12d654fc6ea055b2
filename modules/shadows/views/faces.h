// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "modules/shadows/outputs.h"

namespace gloam {

/// Three unit vectors at right angles; a mirrored node's are left-handed.
struct FaceAxes {
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
};

/// Axes of what looks along a node's −Z, right along its X as far as shear allows, up on the side of its Y. Columns
/// that give no direction (zero, parallel to another one, not finite) are replaced by any that fits; a −Z that gives
/// none is the world's, as it is for shading.
[[nodiscard]] FaceAxes node_axes(const dmat4& world_from_node);

/// Axes of a cube's face 0…5, as shadows_shared.h has them.
[[nodiscard]] FaceAxes cube_axes(std::uint32_t face);

/// The cube's face that a direction from the light belongs to: that of its greatest component in the cube's axes.
[[nodiscard]] std::uint32_t cube_face_of(const dvec3& direction);

/// How a point or spot light casts shadows.
struct LocalShadow {
  std::uint32_t kind = GLOAM_SHADOW_NONE;
  dvec3 position = dvec3(0.0);
  FaceAxes axes;  ///< of its node
  float range_m = 0.0f;
  float near_m = 0.0f;   ///< where the near planes of its faces are
  float width_m = 0.0f;  ///< ≥ 0
  float tan_inner = 1.0f;
  float tan_half = 1.0f;
  float cookie_tan = 1.0f;

  [[nodiscard]] std::uint32_t face_count() const {
    return kind == GLOAM_SHADOW_CUBE ? 6 : kind == GLOAM_SHADOW_SPOT ? 1 : 0;
  }
};

/// kernel_rim: ShadowSettings::kernel_rim. Kind none for directional lights, for lights that reach no farther than 5
/// cm, and for positions and angles that are not finite; axes and cookie_tan are there all the same.
[[nodiscard]] LocalShadow local_shadow(const Light& light, const dmat4& world_from_node, float kernel_rim);

/// Face `index` of shadow.face_count(), without a place in the atlas.
[[nodiscard]] ShadowFace local_face(Entity light, const LocalShadow& shadow, std::uint32_t index);

/// What shaders read; `squares` are its faces' places, all of one size, or empty: kind none. Cookie and traced layers
/// are none.
[[nodiscard]] shaders::ShadowRow shadow_row(const LocalShadow& shadow, std::span<const AtlasSquare> squares);

/// Where a face sees a point.
struct FacePoint {
  double x = 0.0;        ///< texels from the left side of the face's square
  double y = 0.0;        ///< texels from its upper side
  double depth = 0.0;    ///< reversed, as the map has it
  double along_m = 0.0;  ///< along the face's axis; orthographic: from the near side
};

/// Nothing for what does not lie in front of a perspective face. Points beside the square, nearer than the near plane
/// or farther than the far one have coordinates beyond its limits.
[[nodiscard]] std::optional<FacePoint> project(const ShadowFace& face, const dvec3& world);

/// The world position that a face sees at these texels, along_m in front of it.
[[nodiscard]] dvec3 unproject(const ShadowFace& face, double x, double y, double along_m);

}  // namespace gloam
