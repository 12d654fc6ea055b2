// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/scene/components.h"
#include "modules/reflections/probes/rows.h"
#include "shaders/reflections_test/shaders.h"
#include "tests/modules/reflections/support/reflection_kernel.h"

namespace gloam::test {
namespace {

constexpr std::uint32_t kProbeSide = 64;

struct ProbeRay {
  vec3 position;
  float roughness;
  vec3 direction;
};

/// A probe of the world, and its oracle.
struct TestProbe {
  CubeProbe probe;
  dmat4 world_from_node = dmat4(1.0);
  /// The position in the node's space as a share of half the box: −1…1 inside.
  [[nodiscard]] dvec3 in_box(const dvec3& world) const {
    return dvec3(glm::inverse(world_from_node) * dvec4(world, 1.0)) / (0.5 * dvec3(probe.size_m));
  }
  [[nodiscard]] double share(const dvec3& world) const {
    if (probe.global) return 1.0;
    const dvec3 at = glm::abs(in_box(world));
    return std::clamp((1.0 - std::max({at.x, at.y, at.z})) / static_cast<double>(kProbeFade), 0.0, 1.0);
  }
  /// The direction from the centre to the point of the box that the ray meets.
  [[nodiscard]] dvec3 seen(const dvec3& world, const dvec3& direction) const {
    if (probe.global) return direction;
    const dvec3 at = in_box(world), along = in_box(world + direction) - at;
    double leave = 1e30;
    for (int i = 0; i < 3; ++i)
      if (along[i] != 0.0) leave = std::min(leave, ((along[i] > 0.0 ? 1.0 : -1.0) - at[i]) / along[i]);
    return glm::normalize(world + direction * leave - dvec3(world_from_node[3]));
  }
};

class ProbesRadiance : public KernelTest {
 protected:
  [[nodiscard]] static TestProbe box(const dvec3& center, vec3 size, double turn = 0.0) {
    TestProbe made;
    made.probe.size_m = size;
    made.world_from_node = glm::rotate(glm::translate(dmat4(1.0), center), turn, glm::normalize(dvec3(0.3, 1.0, 0.2)));
    return made;
  }
  [[nodiscard]] static TestProbe global() {
    TestProbe made;
    made.probe.global = true;
    return made;
  }
  /// The rows as the module makes them, for a camera in the world's origin. Layer i is probe i.
  [[nodiscard]] static std::vector<shaders::ProbeRow> rows(const std::vector<TestProbe>& probes) {
    World world;
    world.register_component<CubeProbe>();
    world.register_component<WorldTransform>();
    ReflectionCaptures captures;
    for (const TestProbe& p : probes)
      captures.probe_entities.push_back(world.create(p.probe, WorldTransform{p.world_from_node}));
    return probe_rows(world, view_from(dvec3(0.0), 0.0, 0.0), captures);
  }
  [[nodiscard]] std::vector<vec4> radiance(const std::vector<TestProbe>& probes, const FlatLayers& images,
                                           std::vector<ProbeRay> rays, const std::vector<vec4>& factors = {vec4(1.0f)},
                                           std::int32_t emission = -1) {
    const std::size_t count = rays.size();
    rays.resize((count + 63) / 64 * 64);
    std::vector<shaders::ProbeRow> made = rows(probes);
    const auto used = static_cast<std::uint32_t>(made.size());
    if (made.empty()) made.resize(1);
    for (shaders::ProbeRow& row : made) {
      row.emission = static_cast<float>(emission);
      if (factors.size() > 1) row.factor = 0.0f;
    }
    Kernel kernel(device(), shaders::reflections_test::probes_comp);
    kernel.input(0, rays);
    kernel.input(1, made);
    kernel.sampled_image(2, images.image(), gpu::Filter::linear);
    kernel.output(3, rays.size() * sizeof(vec4));
    kernel.input(4, factors);
    kernel.push(used);
    kernel.run(static_cast<std::uint32_t>(rays.size() / 64));
    std::vector<vec4> lights = kernel.read<vec4>(3);
    lights.resize(count);
    return lights;
  }
  /// A layer whose texels hold the direction that they show, plus 2.
  [[nodiscard]] static std::vector<HalfTexel> directions(std::uint32_t side) {
    std::vector<HalfTexel> texels;
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) texels.push_back(to_half(vec4(direction_of(x, y, side) + 2.0f, 1.0f)));
    return texels;
  }
  /// World direction of a texel, as ReflectionCaptures states it.
  [[nodiscard]] static vec3 direction_of(std::uint32_t x, std::uint32_t y, std::uint32_t side) {
    const vec2 uv = (vec2(x, y) + 0.5f) / static_cast<float>(side);
    const vec3 axes = octahedral_decode(uv * 2.0f - 1.0f);
    return {axes.x, axes.z, axes.y};
  }
};

TEST_F(ProbesRadiance, each_direction_shows_its_texel) {
  // Distinct values: a lookup through a texel's centre must give exactly that texel.
  std::vector<HalfTexel> texels;
  std::vector<ProbeRay> rays;
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 0; x < 32; ++x) {
      texels.push_back(to_half(vec4(x, y, 7.0f, 1.0f)));
      rays.push_back({vec3(3.0f, -2.0f, 8.0f), 0.0f, direction_of(x, y, 32)});
    }
  const FlatLayers images(device(), 32, 1, 1, texels);
  const std::vector<vec4> lights = radiance({global()}, images, rays);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ASSERT_NEAR(lights[i].x, static_cast<float>(i % 32), 0.02) << i;
    ASSERT_NEAR(lights[i].y, static_cast<float>(i / 32), 0.02) << i;
    ASSERT_EQ(lights[i].w, 1.0f);
  }
}

TEST_F(ProbesRadiance, factors_scale_the_light_of_lamps_in_the_cells_of_the_map) {
  constexpr std::uint32_t kCells = GLOAM_PROBE_CELLS;
  std::vector<vec4> factors;
  std::vector<ProbeRay> rays;
  for (std::uint32_t y = 0; y < kCells; ++y)
    for (std::uint32_t x = 0; x < kCells; ++x) {
      factors.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.5f, 1.0f);
      rays.push_back({vec3(0.0f), 0.0f, direction_of(x, y, kCells)});
    }
  const FlatLayers images(device(), 8, 2, std::vector<vec4>{vec4(3.0f, 2.0f, 1.0f, 1.0f), vec4(1.0f)});
  for (const std::int32_t emission : {-1, 1}) {
    const std::vector<vec4> lights = radiance({global()}, images, rays, factors, emission);
    for (std::size_t i = 0; i < lights.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const float kept = emission < 0 ? 0.0f : 1.0f, all = 3.0f - static_cast<float>(c);
        ASSERT_NEAR(lights[i][c], kept + factors[i][c] * (all - kept), 0.05f) << i << ", " << c;
      }
  }
}

TEST_F(ProbesRadiance, all_directions_are_looked_up_where_they_were_stored) {
  const FlatLayers images(device(), kProbeSide, 1, 1, directions(kProbeSide));
  ProxyRandom random(51);
  std::vector<ProbeRay> rays;
  for (int i = 0; i < 2048; ++i) rays.push_back({vec3(0.0f), 0.0f, vec3(random.direction())});
  for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
    for (const float side : {1.0f, -1.0f}) rays.push_back({vec3(0.0f), 0.0f, side * axis});
  const std::vector<vec4> lights = radiance({global()}, images, rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    ASSERT_LT(glm::length(vec3(lights[i]) - 2.0f - rays[i].direction), 0.06f) << i;
}

TEST_F(ProbesRadiance, rays_show_the_point_of_the_box_that_they_meet) {
  const FlatLayers images(device(), kProbeSide, 1, 1, directions(kProbeSide));
  ProxyRandom random(52);
  for (const double turn : {0.0, 0.7, 2.0}) {
    const TestProbe probe = box({1.0, 0.5, -2.0}, {4.0f, 2.5f, 7.0f}, turn);
    std::vector<ProbeRay> rays;
    std::vector<dvec3> expected;
    for (int i = 0; i < 1024; ++i) {
      const dvec3 at =
          dvec3(probe.world_from_node * dvec4(random.inside(dvec3(0.75 * 2.0, 0.75 * 1.25, 0.75 * 3.5)), 1.0));
      const dvec3 direction = random.direction();
      rays.push_back({vec3(at), 0.0f, vec3(direction)});
      expected.push_back(probe.seen(at, direction));
    }
    const std::vector<vec4> lights = radiance({probe}, images, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_NEAR(lights[i].w, 1.0f, 1e-5f);
      ASSERT_LT(glm::length(dvec3(lights[i]) - 2.0 - expected[i]), 0.06) << turn << ", " << i;
    }
  }
}

TEST_F(ProbesRadiance, rays_along_an_axis_and_from_a_face_are_finite) {
  const FlatLayers images(device(), kProbeSide, 1, 1, directions(kProbeSide));
  const TestProbe probe = box(dvec3(0.0), vec3(4.0f));
  std::vector<ProbeRay> rays;
  for (const vec3& at : {vec3(0.0f), vec3(1.99f, 0.0f, 0.0f), vec3(2.0f, 2.0f, 2.0f), vec3(0.5f, -1.0f, 1.0f)})
    for (const vec3& axis : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1)})
      rays.push_back({at, 0.0f, axis});
  for (const vec4& light : radiance({probe, global()}, images, rays)) {
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(light[i]));
    EXPECT_NEAR(light.w, 1.0f, 1e-5f);
  }
}

TEST_F(ProbesRadiance, shares_are_1_inside_and_0_on_the_faces) {
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{vec4(10.0f)});
  ProxyRandom random(53);
  const TestProbe probe = box({1.0, 0.5, -2.0}, {4.0f, 2.5f, 7.0f}, 0.4);
  std::vector<ProbeRay> rays;
  std::vector<double> expected;
  for (int i = 0; i < 1024; ++i) {
    const dvec3 at = dvec3(probe.world_from_node * dvec4(random.inside(dvec3(2.2, 1.4, 3.8)), 1.0));
    rays.push_back({vec3(at), 0.0f, vec3(random.direction())});
    expected.push_back(probe.share(at));
  }
  for (int axis = 0; axis < 3; ++axis) {
    dvec4 face(0.0, 0.0, 0.0, 1.0);
    face[axis] = 0.5 * static_cast<double>(probe.probe.size_m[axis]);
    rays.push_back({vec3(dvec3(probe.world_from_node * face)), 0.0f, vec3(0.0f, 1.0f, 0.0f)});
    expected.push_back(0.0);
  }
  rays.push_back({vec3(dvec3(probe.world_from_node[3])), 0.0f, vec3(0.0f, 1.0f, 0.0f)});
  expected.push_back(1.0);
  const std::vector<vec4> lights = radiance({probe}, images, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(lights[i].w), expected[i], 2e-5) << i;
    ASSERT_NEAR(static_cast<double>(lights[i].x), 10.0 * expected[i], 2e-3) << i;
  }
}

// Hard case: reflections.outside_probes
TEST_F(ProbesRadiance, small_boxes_come_first_and_the_global_probe_and_the_sky_last) {
  // Layer i has radiance 2^i.
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{vec4(1.0f), vec4(2.0f), vec4(4.0f), vec4(8.0f)});
  const std::vector<TestProbe> probes = {global(), box(dvec3(0.0), vec3(20.0f)), box(dvec3(0.0), vec3(4.0f)),
                                         box({30.0, 0.0, 0.0}, vec3(10.0f), 0.5)};
  const auto at = [](float x) { return ProbeRay{vec3(x, 0.0f, 0.0f), 0.0f, vec3(0.0f, 1.0f, 0.0f)}; };
  // In both boxes; at the fade of the small one; in the great one alone; in the third; outside all.
  const std::vector<vec4> lights = radiance(probes, images, {at(0.0f), at(1.8f), at(5.0f), at(30.0f), at(-50.0f)});
  const std::vector<float> expected = {4.0f, 3.0f, 2.0f, 8.0f, 1.0f};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(lights[i].x, expected[i], 2e-3f) << i;
    EXPECT_NEAR(lights[i].w, 1.0f, 1e-6f) << i;
  }
  std::vector<TestProbe> without_global = probes;
  without_global[0] = box({90.0, 0.0, 0.0}, vec3(1.0f));
  const vec4 outside = radiance(without_global, images, {at(-50.0f)}).front();
  EXPECT_EQ(outside, vec4(0.0f)) << "the sky has all of it";
}

TEST_F(ProbesRadiance, white_probes_are_white_and_their_shares_sum_to_the_covered_part) {
  ProxyRandom random(54);
  std::vector<TestProbe> probes;
  std::vector<vec4> white;
  for (int i = 0; i < 12; ++i) {
    probes.push_back(
        box(random.inside(dvec3(4.0)), vec3(static_cast<float>(random.between(1.0, 8.0))), random.between(0.0, 3.0)));
    white.emplace_back(1.0f);
  }
  const FlatLayers images(device(), 8, 4, white);
  std::vector<ProbeRay> rays;
  for (int i = 0; i < 2048; ++i)
    rays.push_back(
        {vec3(random.inside(dvec3(6.0))), static_cast<float>(random.between(0.0, 1.0)), vec3(random.direction())});
  const std::vector<vec4> lights = radiance(probes, images, rays);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    double rest = 1.0;
    for (const TestProbe& probe : probes) rest *= 1.0 - probe.share(dvec3(rays[i].position));
    ASSERT_NEAR(static_cast<double>(lights[i].w), 1.0 - rest, 1e-4) << i;
    ASSERT_NEAR(lights[i].x, lights[i].w, 1e-4f) << i;
  }
}

TEST_F(ProbesRadiance, roughness_chooses_the_mip) {
  std::vector<HalfTexel> texels;
  for (std::uint32_t mip = 0; mip < 4; ++mip)
    texels.insert(texels.end(), std::size_t{16u >> mip} * (16u >> mip), to_half(vec4(static_cast<float>(mip))));
  const FlatLayers images(device(), 16, 4, 1, texels);
  std::vector<ProbeRay> rays;
  for (int i = 0; i <= 12; ++i)
    rays.push_back({vec3(0.0f), static_cast<float>(i) / 12.0f, glm::normalize(vec3(1, -2, 3))});
  const std::vector<vec4> lights = radiance({global()}, images, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_NEAR(lights[i].x, 3.0f * rays[i].roughness, 0.02f) << i;
}

// Hard case: reflections.probe_no_size
TEST_F(ProbesRadiance, probes_without_a_box_are_left_out) {
  EXPECT_EQ(rows({box(dvec3(0.0), {2.0f, 0.0f, 2.0f})}).size(), 0u);
  EXPECT_EQ(rows({box(dvec3(0.0), vec3(-1.0f))}).size(), 0u);
  EXPECT_EQ(rows({box(dvec3(0.0), vec3(std::numeric_limits<float>::quiet_NaN()))}).size(), 0u);
  EXPECT_EQ(rows({box(dvec3(0.0), vec3(std::numeric_limits<float>::infinity()))}).size(), 0u);
  TestProbe flat = box(dvec3(0.0), vec3(1.0f));
  flat.world_from_node[1] = dvec4(0.0);
  EXPECT_EQ(rows({flat}).size(), 0u);
  const std::vector<shaders::ProbeRow> kept =
      rows({flat, box(dvec3(0.0), vec3(3.0f)), global(), box(dvec3(0.0), vec3(1.0f))});
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].layer, 3.0f);
  EXPECT_EQ(kept[1].layer, 1.0f);
  EXPECT_EQ(kept[2].layer, 2.0f);
  EXPECT_EQ(kept[2].global, 1.0f);
}

}  // namespace
}  // namespace gloam::test
