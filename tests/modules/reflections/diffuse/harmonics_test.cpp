// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/harmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "modules/reflections/bake/cube.h"

namespace gloam {
namespace {

constexpr double kPi = std::numbers::pi;
using Environment = std::function<dvec3(const dvec3& direction)>;
using Terms = std::array<dvec3, kDiffuseTerms>;

/// Calls visit(direction, solid angle) for directions all around, in rings.
template <class Visit>
void each_direction(int rings, const Visit& visit) {
  for (int ring = 0; ring < rings; ++ring) {
    const double y = 1.0 - (2.0 * ring + 1.0) / rings, radius = std::sqrt(1.0 - y * y);
    for (int i = 0; i < 2 * rings; ++i) {
      const double angle = kPi * (i + 0.5) / rings;
      visit(dvec3(radius * std::cos(angle), y, radius * std::sin(angle)), 4.0 * kPi / (2.0 * rings * rings));
    }
  }
}

Harmonics projected(const Environment& environment) {
  Harmonics sum;
  each_direction(256, [&](const dvec3& d, double solid_angle) { sum.add(d, environment(d), solid_angle); });
  return sum;
}

/// The mean of the hemisphere, by its definition.
dvec3 hemisphere_mean(const Environment& environment, const dvec3& normal) {
  dvec3 sum(0.0);
  each_direction(256, [&](const dvec3& d, double solid_angle) {
    sum += (std::max(glm::dot(d, normal), 0.0) * solid_angle / kPi) * environment(d);
  });
  return sum;
}

std::array<CapturedPicture, 6> cube_of(const Environment& environment, std::uint32_t side) {
  std::array<CapturedPicture, 6> faces;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const CubeFaceAxes axes = cube_face_axes(face);
    faces[face] = {side, side, {}};
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const double right = (x + 0.5) / side * 2.0 - 1.0, up = 1.0 - (y + 0.5) / side * 2.0;
        const dvec3 d = glm::normalize(axes.forward + right * axes.right + up * axes.up);
        faces[face].texels.emplace_back(vec3(environment(d)), 1.0f);
      }
  }
  return faces;
}

const std::vector<dvec3> kNormals = {{1, 0, 0},      {-1, 0, 0},       {0, 1, 0},       {0, -1, 0},
                                     {0, 0, 1},      {0, 0, -1},       {0.6, 0.8, 0.0}, {-0.36, 0.48, 0.8},
                                     {0, -0.6, 0.8}, {-0.8, 0.0, -0.6}};

void expect_means(const Terms& terms, const Environment& environment, double tolerance) {
  for (const dvec3& normal : kNormals) {
    const dvec3 expected = hemisphere_mean(environment, normal), found = diffuse_value(terms, normal);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << normal.x << " " << normal.y;
  }
}

double least_value(const Terms& terms) {
  double least = std::numeric_limits<double>::infinity();
  each_direction(64, [&](const dvec3& d, double) {
    const dvec3 value = diffuse_value(terms, d);
    least = std::min({least, value.x, value.y, value.z});
  });
  return least;
}

TEST(DiffuseHarmonics, a_constant_environment_gives_its_own_radiance_to_all_normals) {
  const Environment constant = [](const dvec3&) { return dvec3(2.0, 0.5, 0.125); };
  for (const Terms& terms : {diffuse_terms(projected(constant)), diffuse_terms(project_cube(cube_of(constant, 16)))})
    for (const dvec3& normal : kNormals)
      EXPECT_LT(glm::length(diffuse_value(terms, normal) - dvec3(2.0, 0.5, 0.125)), 1e-4);
}

TEST(DiffuseHarmonics, environments_of_order_2_are_exact_and_not_windowed) {
  const Environment smooth = [](const dvec3& d) {
    const double along = glm::dot(d, glm::normalize(dvec3(1.0, -2.0, 0.5)));
    return dvec3(1.0 + 0.6 * along, 0.4 + along * along, 1.0 + 0.3 * d.x * d.y - 0.2 * d.y * d.z + 0.3 * d.x * d.z);
  };
  expect_means(diffuse_terms(projected(smooth)), smooth, 2e-4);
  expect_means(diffuse_terms(project_cube(cube_of(smooth, 64))), smooth, 2e-3);
}

TEST(DiffuseHarmonics, one_red_side_is_within_a_twentieth_of_its_light) {
  const Environment red = [](const dvec3& d) { return d.x > 0.0 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0); };
  // The hemisphere's next term is of order 3, which a cosine lobe does not have; order 4 has 1/24 of it at most.
  expect_means(diffuse_terms(project_cube(cube_of(red, 64))), red, 0.05);
}

TEST(DiffuseHarmonics, a_small_source_is_nowhere_negative_and_loses_no_light) {
  for (const dvec3& toward : kNormals) {
    Harmonics source;
    source.add(toward, dvec3(100.0, 40.0, 1.0), 0.01);
    const Terms terms = diffuse_terms(source);
    EXPECT_GT(least_value(terms), -1e-4 * 100.0 * 0.01);
    dvec3 mean(0.0);
    each_direction(
        64, [&](const dvec3& d, double solid_angle) { mean += solid_angle / (4.0 * kPi) * diffuse_value(terms, d); });
    EXPECT_NEAR(mean.x, 100.0 * 0.01 / (4.0 * kPi), 1e-4) << "the mean over all normals";
    EXPECT_GT(diffuse_value(terms, toward).x, 3.0 * mean.x) << "it still comes from one side";
  }
}

TEST(DiffuseHarmonics, the_sum_over_environments_of_both_signs_of_window_stays_positive) {
  Harmonics sources;
  for (std::size_t i = 0; i < kNormals.size(); i += 3) sources.add(kNormals[i], dvec3(i == 0 ? 50.0 : 1.0), 0.02);
  EXPECT_GT(least_value(diffuse_terms(sources)), -1e-3);
}

TEST(DiffuseHarmonics, light_that_is_not_finite_counts_as_none) {
  std::array<CapturedPicture, 6> faces = cube_of([](const dvec3&) { return dvec3(1.0); }, 8);
  faces[2].texels[11] = vec4(std::numeric_limits<float>::quiet_NaN());
  faces[4].texels[3].x = std::numeric_limits<float>::infinity();
  const Terms terms = diffuse_terms(project_cube(faces));
  for (const dvec3& normal : kNormals) EXPECT_NEAR(diffuse_value(terms, normal).y, 1.0, 0.03);
}

}  // namespace
}  // namespace gloam
