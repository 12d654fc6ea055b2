// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "engine/scene/resources.h"

// Shading in double precision: twins of shaders/lighting/brdf_api.glsl and environment_api.glsl.

namespace gloam {

/// Twin of ShadingPoint, without position. Normal and to_eye: unit length.
struct TwinPoint {
  dvec3 normal = dvec3(0.0, 1.0, 0.0);
  dvec3 to_eye = dvec3(0.0, 1.0, 0.0);
  dvec3 diffuse = dvec3(0.0);  ///< (1 - metallic) · base colour / π
  dvec3 f0 = dvec3(0.0);
  double roughness = 1.0;
  double alpha2 = 1.0;   ///< roughness⁴
  double n_dot_v = 1.0;  ///< > 0
};

[[nodiscard]] TwinPoint twin_point(const dvec3& to_eye, const dvec3& normal, const dvec3& base_color, double metallic,
                                   double roughness);

/// Radiance toward the eye for an illuminance (on a plane that faces the light) from the unit direction to_light.
/// half_angle: apparent radius of the light in radians, as in reflected_disc(); 0: a point.
[[nodiscard]] dvec3 reflected_light(const TwinPoint& p, const dvec3& to_light, const dvec3& illuminance,
                                    double half_angle = 0.0);

/// Radiance of the sky, and of the ground below the horizon, in a unit direction.
[[nodiscard]] dvec3 sky_radiance(const SceneEnvironment& sky, const dvec3& direction);
[[nodiscard]] dvec3 hemisphere_radiance(const SceneEnvironment& sky, const dvec3& normal);
/// Diffuse ambient term before occlusion.
[[nodiscard]] dvec3 diffuse_ambient(const SceneEnvironment& sky, const TwinPoint& p);
[[nodiscard]] dvec3 specular_share(const TwinPoint& p);
[[nodiscard]] dvec3 mirrored_radiance(const SceneEnvironment& sky, const TwinPoint& p);

}  // namespace gloam
