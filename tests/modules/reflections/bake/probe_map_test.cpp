// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/probe_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "engine/math/packing.h"
#include "modules/reflections/captures.h"

namespace gloam {
namespace {

using LightField = std::function<dvec3(const dvec3& direction)>;

/// The faces of a cube that show `light`: the mean of 4 x 4 points in each texel.
std::array<CapturedPicture, 6> faces_of(const LightField& light, std::uint32_t side) {
  std::array<CapturedPicture, 6> faces;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const CubeFaceAxes axes = cube_face_axes(face);
    faces[face] = {side, side, {}};
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        dvec3 sum(0.0);
        for (int i = 0; i < 16; ++i) {
          const double u = 2.0 * (x + (i % 4 + 0.5) / 4.0) / side - 1.0,
                       v = 1.0 - 2.0 * (y + (i / 4 + 0.5) / 4.0) / side;
          sum += light(glm::normalize(axes.forward + u * axes.right + v * axes.up)) / 16.0;
        }
        faces[face].texels.emplace_back(vec3(sum), 1.0f);
      }
  }
  return faces;
}

CapturedLayers map_of(const std::array<CapturedPicture, 6>& faces, std::uint32_t side, JobExecutor& executor) {
  CapturedLayers layers{side, probe_map_mips(side), 1, {}};
  append_probe_map(CapturedCube(faces, executor), side, executor, layers.texels);
  EXPECT_EQ(layers.texels.size(), layers.layer_halves());
  return layers;
}
CapturedLayers map_of(const LightField& light, std::uint32_t cube_side, std::uint32_t side) {
  return map_of(faces_of(light, cube_side), side, *make_serial_executor());
}

dvec3 texel(const CapturedLayers& layers, std::uint32_t mip, std::uint32_t x, std::uint32_t y) {
  const std::uint16_t* at = &layers.texels[layers.mip_offset(mip) + std::size_t{4} * (y * (layers.side >> mip) + x)];
  EXPECT_EQ(half_to_float(at[3]), 1.0f);
  return {half_to_float(at[0]), half_to_float(at[1]), half_to_float(at[2])};
}

/// World direction of a map's texel, from the words of ReflectionCaptures::probes.
dvec3 direction_of(std::uint32_t side, std::uint32_t x, std::uint32_t y) {
  const double a = 2.0 * (x + 0.5) / side - 1.0, b = 2.0 * (y + 0.5) / side - 1.0;
  dvec3 d(a, 1.0 - std::abs(a) - std::abs(b), b);
  if (d.y < 0.0) {
    d.x = (1.0 - std::abs(b)) * (a < 0.0 ? -1.0 : 1.0);
    d.z = (1.0 - std::abs(a)) * (b < 0.0 ? -1.0 : 1.0);
  }
  return glm::normalize(d);
}

/// Coloured walls in six directions.
dvec3 walls(const dvec3& d) {
  const dvec3 size = glm::abs(d);
  if (size.x > size.y && size.x > size.z) return d.x > 0.0 ? dvec3(1, 0, 0) : dvec3(0, 1, 1);
  if (size.y > size.z) return d.y > 0.0 ? dvec3(0, 1, 0) : dvec3(1, 0, 1);
  return d.z > 0.0 ? dvec3(0, 0, 1) : dvec3(1, 1, 0);
}

dvec3 smooth(const dvec3& d) { return {1.5 + d.x, 2.0 + d.y * d.z, 1.0 + 0.8 * std::sin(3.0 * d.z + d.y) * d.x}; }

/// Mean radiance under a GGX lobe whose viewer looks along the normal, by a sum over all directions.
dvec3 lobe_mean(const LightField& light, const dvec3& normal, double roughness) {
  const dvec3 helper = std::abs(normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 x = glm::normalize(glm::cross(helper, normal)), y = glm::cross(normal, x);
  const double alpha2 = std::pow(roughness, 4.0);
  dvec3 sum(0.0);
  double weights = 0.0;
  constexpr int kRings = 600, kSectors = 240;
  for (int ring = 0; ring < kRings; ++ring) {
    const double theta = (ring + 0.5) / kRings * 0.5 * std::numbers::pi;
    // The half vector is halfway between the normal, which is the viewer's direction, and the light.
    const double h = std::cos(0.5 * theta), f = h * h * (alpha2 - 1.0) + 1.0;
    // density of the light direction · n·l · solid angle
    const double weight = alpha2 / (f * f) * std::cos(theta) * std::sin(theta);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double phi = (sector + 0.5) / kSectors * 2.0 * std::numbers::pi;
      const dvec3 d = std::sin(theta) * (std::cos(phi) * x + std::sin(phi) * y) + std::cos(theta) * normal;
      sum += weight * light(d);
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(ProbeMap, has_the_side_and_mips_of_its_resolution) {
  EXPECT_EQ(probe_map_side(128), 256u);
  EXPECT_EQ(probe_map_side(100), 256u);
  EXPECT_EQ(probe_map_side(1), 8u);
  EXPECT_EQ(probe_map_side(4096), 1024u);
  EXPECT_EQ(probe_face_side(128), 128u);
  EXPECT_EQ(probe_map_mips(256), 6u);
  EXPECT_EQ(probe_map_mips(8), 1u);
}

TEST(ProbeMap, looks_up_in_the_middle_and_shows_six_walls_where_they_are) {
  const CapturedLayers map = map_of(&walls, 32, 64);
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      const dvec3 d = direction_of(64, x, y), size = glm::abs(d);
      EXPECT_LT(glm::length(dvec3(probe_map_direction((vec2(x, y) + 0.5f) / 64.0f)) - d), 1e-5);
      const double largest = std::max({size.x, size.y, size.z});
      const double second = size.x + size.y + size.z - largest - std::min({size.x, size.y, size.z});
      if (second > 0.85 * largest) continue;  // near an edge of the cube two walls mix
      EXPECT_LT(glm::length(texel(map, 0, x, y) - walls(d)), 1e-3) << x << ", " << y;
    }
  EXPECT_LT(glm::length(texel(map, 0, 32, 32) - dvec3(0, 1, 0)), 1e-3) << "up";
  EXPECT_LT(glm::length(texel(map, 0, 0, 0) - dvec3(1, 0, 1)), 1e-3) << "down";
}

TEST(ProbeMap, of_constant_light_is_constant_in_every_mip) {
  const CapturedLayers map = map_of([](const dvec3&) { return dvec3(0.37, 1.0, 123.0); }, 16, 64);
  for (std::uint32_t mip = 0; mip < map.mips; ++mip)
    for (std::uint32_t y = 0; y < 64u >> mip; ++y)
      for (std::uint32_t x = 0; x < 64u >> mip; ++x)
        EXPECT_LT(glm::length(texel(map, mip, x, y) / dvec3(0.37, 1.0, 123.0) - 1.0), 2e-3) << mip;
}

TEST(ProbeMap, equals_the_integral_over_the_lobe_of_each_mip) {
  const CapturedLayers map = map_of(&smooth, 64, 128);
  for (std::uint32_t mip = 0; mip < map.mips; ++mip) {
    const std::uint32_t side = 128u >> mip;
    const double roughness = static_cast<double>(mip) / (map.mips - 1);
    for (std::uint32_t i = 0; i < 23; ++i) {
      const std::uint32_t x = i * 37 % side, y = i * 53 % side;
      const dvec3 d = direction_of(side, x, y);
      const dvec3 expected = mip == 0 ? smooth(d) : lobe_mean(&smooth, d, roughness);
      EXPECT_LT(glm::length(texel(map, mip, x, y) - expected), 0.03) << "mip " << mip << " at " << x << ", " << y;
    }
  }
}

TEST(ProbeMap, does_not_depend_on_threads) {
  const auto faces = faces_of(&smooth, 32);
  const CapturedLayers serial = map_of(faces, 64, *make_serial_executor());
  for (const std::uint32_t threads : {1u, 2u, 8u})
    EXPECT_EQ(map_of(faces, 64, *make_pool_executor(threads)).texels, serial.texels) << threads;
}

TEST(CapturedCube, interpolates_across_the_edges_of_its_faces) {
  const CapturedCube cube(faces_of(&smooth, 32), *make_serial_executor());
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    dvec3 d(any(engine), any(engine), any(engine));
    if (i % 2 == 0) d[i % 3] = d[(i + 1) % 3] * (i % 4 == 0 ? 1.0 : -1.0);  // on the plane of an edge
    if (glm::length(d) < 0.1) continue;
    d = glm::normalize(d);
    EXPECT_LT(glm::length(dvec3(cube.sample(vec3(d), 0.0f)) - smooth(d)), 0.06);
    EXPECT_LT(glm::length(dvec3(cube.sample(vec3(d), 1.5f)) - smooth(d)), 0.25);
  }
}

TEST(CapturedCube, its_last_mip_is_the_mean_by_solid_angle) {
  // Light from one corner of a face: a mean without weights would overrate it.
  const auto corner = [](const dvec3& d) { return dvec3(d.x > 0.45 && d.y > 0.45 && d.z > 0.45 ? 1.0 : 0.0); };
  const CapturedCube cube(faces_of(corner, 32), *make_serial_executor());
  double lit = 0.0, mean = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps / 4; ++j) {
      const double y = 2.0 * (i + 0.5) / kSteps - 1.0, angle = 8.0 * std::numbers::pi * (j + 0.5) / kSteps;
      const double r = std::sqrt(1.0 - y * y);
      lit += corner(dvec3(r * std::cos(angle), y, r * std::sin(angle))).x / (kSteps * kSteps / 4.0);
    }
  for (std::uint32_t face = 0; face < 6; ++face)
    mean += static_cast<double>(cube.sample(vec3(cube_face_axes(face).forward), 10.0f).x) / 6.0;
  EXPECT_NEAR(mean, lit, 0.02 * lit);
}

}  // namespace
}  // namespace gloam
