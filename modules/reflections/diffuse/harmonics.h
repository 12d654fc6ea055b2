// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Diffuse light of an environment as spherical harmonics of order 2.
// Ramamoorthi and Hanrahan 2001, "An efficient representation for irradiance environment maps". Beyond it: the result
// is windowed where it would be negative.
#pragma once

#include <array>
#include <cstddef>

#include "engine/math/types.h"
#include "modules/reflections/bake/picture.h"
#include "modules/reflections/captures.h"

namespace gloam {

/// Radiance of an environment in all directions, projected on the nine harmonics up to order 2.
struct Harmonics {
  std::array<dvec3, kDiffuseTerms> coefficients{};

  /// direction: unit length. solid_angle: steradians; those of an environment sum to 4 π.
  void add(const dvec3& direction, const dvec3& radiance, double solid_angle);
};

/// The environment that a cube shows. faces: squares of one side, as cube_face_axes() orders and orients them; light
/// that is not finite counts as none.
[[nodiscard]] Harmonics project_cube(const std::array<CapturedPicture, 6>& faces);

/// The mean radiance of the hemisphere around a normal, weighted by the cosine, as a polynomial in the normal (see
/// diffuse_value()): irradiance is π times that. A constant environment gives its radiance. Where the polynomial would
/// be negative in some direction, as opposite a small bright source, its linear terms are scaled by up to 0.866 and its
/// quadratic ones by up to 0.8, all channels alike, as far as needed: with these factors the polynomial of a single
/// source is nowhere negative, so that of any environment is not. The mean over all normals stays.
[[nodiscard]] std::array<dvec3, kDiffuseTerms> diffuse_terms(const Harmonics& environment);

/// Value of the polynomial: terms for 1, y, z, x, xy, yz, 3z² − 1, xz and x² − y².
[[nodiscard]] dvec3 diffuse_value(const std::array<dvec3, kDiffuseTerms>& terms, const dvec3& normal);

}  // namespace gloam
