// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/lobe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace gloam {
namespace {

constexpr double kPiTest = 3.14159265358979323846;

/// Distribution · visibility · cosine of glTF 2.0, appendix B: what a perfect reflector reflects of radiance 1.
double lobe_density(const dvec3& n, const dvec3& v, const dvec3& l, double roughness) {
  const double nl = glm::dot(n, l), nv = glm::dot(n, v);
  if (nl <= 0.0) return 0.0;
  const double a2 = std::pow(roughness, 4.0), nh = glm::dot(n, glm::normalize(l + v));
  const auto smith = [&](double c) { return std::sqrt(a2 + (1.0 - a2) * c * c); };
  return a2 / (kPiTest * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0)) * 0.5 / (nl * smith(nv) + nv * smith(nl)) * nl;
}

/// Integrals over the hemisphere, by the midpoint rule around the mirror direction: of 1 and of the direction.
std::array<dvec3, 2> integrated(const dvec3& v, double roughness) {
  const dvec3 n(0.0, 1.0, 0.0), pole = glm::reflect(-v, n);
  const dvec3 u = glm::normalize(glm::cross(pole, dvec3(0.3, 0.2, 0.9))), w = glm::cross(pole, u);
  dvec3 sum(0.0), direction(0.0);
  constexpr int kRings = 1500, kSpokes = 400;
  for (int ring = 0; ring < kRings; ++ring)
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double s = (ring + 0.5) / kRings;
      const double up = kPiTest * s * s, about = 2.0 * kPiTest * (spoke + 0.5) / kSpokes;  // fine near the pole
      const dvec3 l = std::cos(up) * pole + std::sin(up) * (std::cos(about) * u + std::sin(about) * w);
      const double area = std::sin(up) * 2.0 * kPiTest * s / kRings * 2.0 * kPiTest / kSpokes;
      const double density = lobe_density(n, v, l, roughness) * area;
      sum += density;
      direction += density * l;
    }
  return {sum, direction};
}

TEST(ReflectionLobe, weights_and_directions_integrate_the_brdf) {
  for (const double roughness : {0.25, 0.5, 0.8, 1.0})
    for (const dvec3 v : {dvec3(0.1, 1.0, 0.2), dvec3(0.9, 0.6, -0.3), dvec3(-1.0, 0.25, 0.4)}) {
      const dvec3 to_eye = glm::normalize(v), up(0.0, 1.0, 0.0);
      const ReflectionLobe lobe(up, up, to_eye, roughness);
      const PixelSequence sequence(7);
      constexpr std::uint32_t kSamples = 1u << 15;
      double weight = 0.0;
      dvec3 direction(0.0);
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const PixelSequence::Pair at = sequence.direction(i);
        const LobeDirection sampled = lobe.sample(at.x, at.y);
        weight += sampled.weight / kSamples;
        direction += sampled.weight * sampled.direction / static_cast<double>(kSamples);
      }
      const auto [exact_weight, exact_direction] = integrated(to_eye, roughness);
      EXPECT_NEAR(weight, exact_weight.x, 2e-3) << roughness;
      EXPECT_LT(glm::length(direction - exact_direction), 3e-3) << roughness;
    }
}

TEST(ReflectionLobe, no_direction_leads_below_the_face) {
  const dvec3 face(0.0, 1.0, 0.0);
  for (const dvec3 tilted : {dvec3(0.3, 1.0, 0.0), dvec3(-2.0, 1.0, 0.5), dvec3(0.0, 0.1, 1.0)}) {
    const dvec3 normal = glm::normalize(tilted), to_eye = glm::normalize(dvec3(1.0, 0.2, 0.1));
    const ReflectionLobe lobe(normal, face, to_eye, 0.5);
    EXPECT_GT(glm::dot(lobe.mirror(), face), 0.0);
    EXPECT_NEAR(glm::length(lobe.mirror()), 1.0, 1e-12);
    const PixelSequence sequence(1);
    for (std::uint32_t i = 0; i < 500; ++i) {
      const PixelSequence::Pair at = sequence.direction(i);
      const LobeDirection sampled = lobe.sample(at.x, at.y);
      ASSERT_TRUE(std::isfinite(sampled.weight));
      if (sampled.weight > 0.0) {
        ASSERT_GT(glm::dot(sampled.direction, face), 0.0);
        ASSERT_GT(glm::dot(sampled.direction, normal), 0.0);
        ASSERT_NEAR(glm::length(sampled.direction), 1.0, 1e-9);
      }
    }
  }
}

TEST(ReflectionLobe, smooth_lobes_close_in_on_the_mirror_direction) {
  const dvec3 up(0.0, 1.0, 0.0), to_eye = glm::normalize(dvec3(0.7, 0.5, -0.2));
  double before = 0.0;
  for (const double roughness : {0.04, 0.1, 0.3, 0.6}) {
    const ReflectionLobe lobe(up, up, to_eye, roughness);
    const PixelSequence sequence(3);
    double mean = 0.0;
    for (std::uint32_t i = 0; i < 1024; ++i) {
      const PixelSequence::Pair at = sequence.direction(i);
      mean += glm::length(lobe.sample(at.x, at.y).direction - lobe.mirror()) / 1024.0;
    }
    EXPECT_LT(before, mean);
    EXPECT_LT(mean, 6.0 * roughness * roughness);
    before = mean;
  }
}

TEST(PixelSequence, any_first_power_of_two_is_stratified) {
  for (const std::uint32_t pixel : {0u, 1u, 12345u})
    for (const std::uint32_t count : {16u, 64u, 256u}) {
      const PixelSequence sequence(pixel);
      const auto side = static_cast<std::uint32_t>(std::sqrt(count));
      std::vector<int> cells(count), parts(count);
      for (std::uint32_t i = 0; i < count; ++i) {
        const PixelSequence::Pair at = sequence.direction(i);
        ++cells[static_cast<std::uint32_t>(at.x * side) * side + static_cast<std::uint32_t>(at.y * side)];
        ++parts[static_cast<std::uint32_t>(sequence.choice(i) * count)];
      }
      for (const int hits : cells) EXPECT_EQ(hits, 1);
      for (const int hits : parts) EXPECT_LE(hits, 3);
    }
}

}  // namespace
}  // namespace gloam
