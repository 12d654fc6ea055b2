// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

/// Roughness below which a surface is a mirror: one ray.
inline constexpr double kMirrorRoughness = 0.03;

/// Directions of which ReflectionLobe::one() takes one.
inline constexpr std::uint32_t kLobeCandidates = 16;

/// A direction of reflected light and its weight in the mean.
struct LobeDirection {
  dvec3 direction = dvec3(0.0);  ///< unit
  double weight = 0.0;           ///< ≥ 0; 0 for directions below the surface
};

/// Evenly spread numbers in [0, 1) for one pixel: a scrambled (0, 2)-sequence for directions, additive recurrences for
/// the choice of a light and for points of emitters. Any first part of a sequence is evenly spread. Deterministic.
class PixelSequence {
 public:
  struct Pair {
    double x = 0.0, y = 0.0;
  };
  /// stream: sequences of one pixel for different uses, not correlated with each other.
  explicit PixelSequence(std::uint32_t pixel, std::uint32_t stream = 0);
  [[nodiscard]] Pair direction(std::uint32_t index) const;
  [[nodiscard]] double choice(std::uint32_t index) const;
  [[nodiscard]] Pair emitter(std::uint32_t index) const;

 private:
  std::uint32_t scramble_x_ = 0, scramble_y_ = 0;
  dvec3 shift_ = dvec3(0.0);
};

/// The GGX lobe of a surface, sampled by the normals that the viewer sees (Heitz 2018, "Sampling the GGX distribution
/// of visible normals"). The mean of radiance times weight, divided by the sum of weights, is the integral of radiance
/// · distribution · visibility · cosine over its integral for radiance 1: what the split sum multiplies with
/// specular_share(). Fresnel's variation over the lobe is left out, as there.
class ReflectionLobe {
 public:
  /// All unit length. face_normal: toward the viewer; directions below its plane have weight 0.
  ReflectionLobe(const dvec3& normal, const dvec3& face_normal, const dvec3& to_eye, double roughness);

  /// The mirror direction; if it lies below the face's plane, it is moved onto it.
  [[nodiscard]] dvec3 mirror() const;
  /// The direction of two numbers in [0, 1).
  [[nodiscard]] LobeDirection sample(double u1, double u2) const;
  /// One direction that stands for the lobe: its mean radiance over many calls is the weighted mean of sample(). It is
  /// chosen among kLobeCandidates samples in proportion to their weights (Talbot and others 2005,
  /// "Importance resampling for global illumination"). index: of the call; choice: in [0, 1). Weight: of all
  /// candidates, in the mean; 0 if none is above the surface.
  [[nodiscard]] LobeDirection one(const PixelSequence& sequence, std::uint32_t index, double choice) const;

 private:
  dvec3 normal_, face_normal_, to_eye_;
  dvec3 across_, along_;  ///< with normal_ an orthonormal frame
  dvec3 view_;            ///< to_eye in that frame, above the horizon
  double alpha_;
};

}  // namespace gloam
