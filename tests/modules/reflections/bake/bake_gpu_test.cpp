// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "engine/math/packing.h"
#include "engine/scene/resources.h"
#include "modules/grass/components.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/reflections/components.h"
#include "modules/reflections/relighting/light_states.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

gpu::Device* bake_device() {
  static const std::unique_ptr<gpu::Device> made = test::make_test_device();
  return made.get();
}

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

constexpr vec3 kRed(8.0f, 0.0f, 0.0f), kGreen(0.0f, 4.0f, 0.0f), kBlue(0.0f, 0.0f, 2.0f), kWhite(1.0f);

/// A world of walls that shine by themselves.
struct Bakes : testing::Test {
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
  test::SceneMaker scene{world};

  void SetUp() override {
    GLOAM_REQUIRE_GPU(bake_device());
    GLOAM_REQUIRE_DEPTH_TESTS(bake_device());
    renderer = open(*executor, world);
  }
  void TearDown() override {
    renderer.reset();
    if (bake_device() != nullptr) {
      EXPECT_EQ(bake_device()->validation_messages(), 0u);
    }
  }
  static std::unique_ptr<Renderer> open(JobExecutor& jobs, World& drawn) {
    RendererOptions options;
    options.device = bake_device();
    options.executor = &jobs;
    options.log = &test::gpu_log();
    options.modules = make_all_modules();
    auto renderer = test::value_of(Renderer::create(std::move(options)));
    renderer->prepare_world(drawn);
    return renderer;
  }
  std::uint32_t shining(const vec3& light) {
    Material material;
    material.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    material.metallic = 0.0f;
    material.emissive = light;
    material.double_sided = true;
    return scene.material(material);
  }
  /// A square wall with sides of 2 m in the matrix's XY plane.
  Entity wall(const vec3& light, const dmat4& matrix) {
    return scene.draw(scene.mesh(test::quad(1.0f, shining(light))), matrix);
  }
  /// The walls that expect_quarters() looks for, before a proxy of 4 m at the origin.
  void quarter_walls() {
    wall(kRed, at(-1, 1, -0.5));
    wall(kBlue, at(1, 1, -0.5));
    wall(kGreen, at(-1, -1, -0.5));
  }
  Entity proxy(const vec2& size_m, const dmat4& matrix) {
    IbrProxy quad;
    quad.size_m = size_m;
    return world.create(quad, WorldTransform{matrix});
  }
  [[nodiscard]] ReflectionCaptures bake(std::uint32_t proxy_side = 32) {
    return test::value_of(
        bake_reflections(*renderer, world, {.executor = executor.get(), .progress = {}, .proxy_side = proxy_side}));
  }
  /// Texel of mip 0 of a layer.
  static vec4 texel(const CapturedLayers& layers, std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
    const std::uint16_t* from = &layers.texels[layer * layers.layer_halves() + std::size_t{4} * (y * layers.side + x)];
    return {half_to_float(from[0]), half_to_float(from[1]), half_to_float(from[2]), half_to_float(from[3])};
  }
};

/// Expects the colours of the four quarters of a proxy of 4 x 4 m: red, blue; green, nothing.
void expect_quarters(const CapturedLayers& layers, std::uint32_t layer) {
  const std::uint32_t low = layers.side / 4, high = 3 * layers.side / 4;
  const auto near = [](const vec4& a, const vec4& b) { return glm::length(a - b) < 5e-3f; };
  EXPECT_TRUE(near(Bakes::texel(layers, layer, low, low), vec4(kRed, 1.0f)));
  EXPECT_TRUE(near(Bakes::texel(layers, layer, high, low), vec4(kBlue, 1.0f)));
  EXPECT_TRUE(near(Bakes::texel(layers, layer, low, high), vec4(kGreen, 1.0f)));
  EXPECT_EQ(Bakes::texel(layers, layer, high, high), vec4(0.0f)) << "nothing is there";
}

TEST_F(Bakes, a_proxy_shows_the_wall_behind_it_upright_and_alpha_0_beside_it) {
  world.resource<SceneEnvironment>().sky_horizon = vec3(0.0f, 0.0f, 0.0f);
  // The same wall in front of three nodes: turned far from the origin; stretched; and mirrored, where the node's +X
  // points the other way.
  const dmat4 places[] = {at(1000, 5, -300) * glm::rotate(dmat4(1.0), 1.2, glm::normalize(dvec3(1, 2, 3))),
                          at(50, 0, 0) * glm::scale(dmat4(1.0), dvec3(2.0, 0.5, 1.0)),
                          at(-50, 0, 0) * glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0))};
  for (const dmat4& place : places) {
    proxy(vec2(4.0f, 4.0f), place);
    wall(kRed, place * at(-1, 1, -0.5));
    wall(kBlue, place * at(1, 1, 0.2));
    wall(kGreen, place * at(-1, -1, 0.0));
    wall(kWhite, place * at(1, -1, -2.5));  // too far behind
    wall(kWhite, place * at(0, 0, 1.5));    // too far in front
  }
  const ReflectionCaptures captures = bake();
  ASSERT_EQ(captures.proxy_entities.size(), 3u);
  ASSERT_EQ(captures.proxy_parts.size(), 3u);
  ASSERT_EQ(captures.proxies.count, 6u) << "each with a layer of its emission";
  EXPECT_EQ(captures.proxies.mips, 6u);
  EXPECT_EQ(captures.proxies.texels.size(), 6 * captures.proxies.layer_halves());
  for (std::uint32_t layer = 0; layer < 3; ++layer) {
    SCOPED_TRACE(layer);
    expect_quarters(captures.proxies, layer);
    EXPECT_EQ(captures.proxy_parts[layer].emission, static_cast<std::int32_t>(3 + layer));
    expect_quarters(captures.proxies, 3 + layer);
    EXPECT_EQ(captures.proxy_parts[layer].lit, 0.0f);
    // A wall is half a unit behind, one 0.2 before; the second node is as deep as it is, the third is mirrored in x.
    EXPECT_NEAR(captures.proxy_parts[layer].surface_m, (-0.5f + 0.2f + 0.0f) / 3.0f, 0.02f);
  }
  EXPECT_TRUE(captures.proxy_lights.empty());
}

TEST_F(Bakes, a_probe_shows_six_walls_where_they_are) {
  const double quarter = 1.5707963267948966;
  const dvec3 center(20.0, 3.0, -7.0);
  const vec3 lights[] = {vec3(1, 0, 0), vec3(0, 1, 1), vec3(0, 1, 0), vec3(1, 0, 1), vec3(0, 0, 1), vec3(1, 1, 0)};
  const dvec3 axes[] = {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
  for (int i = 0; i < 6; ++i) {
    const dvec3 toward = axes[i / 2] * (i % 2 == 0 ? 1.0 : -1.0);
    dmat4 turned(1.0);
    if (i / 2 == 0) turned = glm::rotate(dmat4(1.0), quarter, dvec3(0, 1, 0));
    if (i / 2 == 1) turned = glm::rotate(dmat4(1.0), quarter, dvec3(1, 0, 0));
    wall(lights[i], glm::translate(dmat4(1.0), center + toward) * turned);
  }
  CubeProbe probe;
  probe.size_m = vec3(2.0f);
  probe.resolution = 16;
  const Entity small = world.create(probe, WorldTransform{glm::translate(dmat4(1.0), center)});
  probe.resolution = 32;
  probe.global = true;
  probe.size_m = vec3(0.0f);
  const Entity global = world.create(probe, WorldTransform{glm::translate(dmat4(1.0), center)});
  probe.global = false;
  world.create(probe, WorldTransform{});  // without volume: not captured
  const ReflectionCaptures captures = bake();
  ASSERT_EQ(captures.probe_entities, (std::vector<Entity>{small, global}));
  EXPECT_EQ(captures.probes.side, 64u);
  EXPECT_EQ(captures.probes.mips, 4u);
  for (std::uint32_t layer = 0; layer < 2; ++layer)
    for (int i = 0; i < 6; ++i) {
      const vec3 toward = vec3(axes[i / 2]) * (i % 2 == 0 ? 1.0f : -1.0f);
      const vec2 code = octahedral_encode(vec3(toward.x, toward.z, toward.y));
      const auto index = [](float c) { return std::min(static_cast<std::uint32_t>((c * 0.5f + 0.5f) * 64.0f), 63u); };
      EXPECT_LT(glm::length(vec3(texel(captures.probes, layer, index(code.x), index(code.y))) - lights[i]), 0.01f) << i;
    }
}

TEST_F(Bakes, of_bright_light_are_those_of_ordinary_light_times_their_scale) {
  // The same walls with 2^k times the light, at no exposure, and at those of day and night: captures are kept for all.
  world.resource<SceneEnvironment>().sky_horizon = vec3(0.0f);
  proxy(vec2(4.0f, 4.0f), dmat4(1.0));
  CubeProbe probe;
  probe.global = true;
  probe.resolution = 16;
  world.create(probe, WorldTransform{at(0, 0, 2)});
  quarter_walls();
  const std::vector<Material> materials = scene.assets().materials;
  const ReflectionCaptures ordinary = bake();
  EXPECT_EQ(ordinary.light_scale, 1.0f);
  auto& environment = world.resource<SceneEnvironment>();
  for (const int k : {4, 12, 14, 20, 40})
    for (const float ev : {-10.0f, 5.0f, 20.0f, 100.0f}) {
      SCOPED_TRACE(k);
      environment.has_exposure = ev < 100.0f;
      environment.exposure_ev100 = ev;
      for (std::uint32_t i = 0; i < materials.size(); ++i) {
        scene.assets().materials[i].emissive = materials[i].emissive * std::exp2(static_cast<float>(k));
        scene.assets().mark_changed(AssetKind::material, i);
      }
      const ReflectionCaptures bright = bake();
      EXPECT_EQ(bright.light_scale == 1.0f, k <= 12);
      const float factor = std::exp2(static_cast<float>(k)) * bright.light_scale;
      for (const auto layers : {&ReflectionCaptures::proxies, &ReflectionCaptures::probes}) {
        const std::vector<std::uint16_t>&wanted = (ordinary.*layers).texels, &found = (bright.*layers).texels;
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
          const float expected = half_to_float(wanted[i]) * (i % 4 == 3 ? 1.0f : factor);
          ASSERT_NEAR(half_to_float(found[i]), expected, 2e-3f * expected + 6e-8f * std::max(factor, 1.0f)) << i;
        }
      }
    }
}

TEST_F(Bakes, what_is_animated_is_in_no_capture) {
  const Entity quad = proxy(vec2(4.0f, 4.0f), dmat4(1.0));
  quarter_walls();
  const Entity moving = wall(kWhite, dmat4(1.0));
  world.add(moving, LocalTransform{});
  world.add(moving, SourceNode{0});
  AnimationClip clip;
  clip.duration_s = 1.0f;
  AnimationChannel& channel = clip.channels.emplace_back();
  channel.node = 0;
  channel.times = {0.0f, 1.0f};
  channel.values = {0, 0, 0, 1, 0, 0};
  scene.assets().clips.push_back(clip);
  const ReflectionCaptures captures = bake();
  ASSERT_EQ(captures.proxy_entities, std::vector<Entity>{quad});
  expect_quarters(captures.proxies, 0);
}

TEST_F(Bakes, light_that_is_not_a_number_does_not_spread) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  proxy(vec2(4.0f, 4.0f), dmat4(1.0));
  CubeProbe probe;
  probe.global = true;
  probe.resolution = 16;
  world.create(probe, WorldTransform{at(0, 0, 2)});
  wall(kRed, at(-1, 1, -0.5));
  wall(vec3(nan, 1.0f, nan), at(1, 1, -0.5));
  Light broken;
  broken.intensity = nan;
  const Entity light = world.create(broken, WorldTransform{at(0, 0, 1)});
  const ReflectionCaptures captures = bake();
  for (const CapturedLayers* layers : {&captures.proxies, &captures.probes})
    for (const std::uint16_t half : layers->texels) ASSERT_TRUE(std::isfinite(half_to_float(half)));
  EXPECT_EQ(vec3(texel(captures.proxies, 0, 8, 8)), kRed);
  ASSERT_EQ(captures.lights.size(), 1u);
  EXPECT_EQ(captures.lights[0].light, light);
  EXPECT_EQ(captures.lights[0].emitted, vec3(0.0f));
}

TEST_F(Bakes, lights_that_reach_a_proxy_dim_it_and_light_its_capture) {
  world.resource<SceneEnvironment>() = {
      .sky_zenith = vec3(0.02f), .sky_horizon = vec3(0.02f), .sky_ground = vec3(0.02f)};
  proxy(vec2(2.0f, 2.0f), dmat4(1.0));
  Material plaster;
  plaster.metallic = 0.0f;
  scene.draw(scene.mesh(test::quad(2.0f, scene.material(plaster))), at(0, 0, -0.2));
  Light lamp;
  lamp.intensity = 100.0f;
  const Entity light = world.create(lamp, WorldTransform{at(0, 0, 4)});
  lamp.range_m = 1.0f;
  world.create(lamp, WorldTransform{at(0, 0, 4)});
  const ReflectionCaptures captures = bake();
  ASSERT_EQ(captures.proxy_lights.size(), 1u);
  EXPECT_EQ(captures.proxy_lights[0].light, light);
  EXPECT_EQ(captures.proxy_lights[0].weight, 1.0f);
  EXPECT_EQ(captures.lights.size(), 2u);
  const double expected = 100.0 / (4.2 * 4.2) / 3.14159265;  // a white diffuse wall, without its highlight
  EXPECT_NEAR(texel(captures.proxies, 0, 16, 16).x, expected, 0.15 * expected);
  const CapturedParts& parts = captures.proxy_parts.at(0);
  EXPECT_NEAR(parts.lamps_lux.at(kProxyCells * kProxyCells / 2 + kProxyCells / 2).x, 100.0 / (4.2 * 4.2),
              0.1 * 100.0 / (4.2 * 4.2));
  EXPECT_NEAR(parts.lit, expected, 0.15 * expected);
  EXPECT_NEAR(parts.surface_m, -0.2f, 1e-3f);
  ASSERT_EQ(parts.emission, 1) << "what the sky lights";
  EXPECT_LT(texel(captures.proxies, 1, 16, 16).x, 0.1 * expected);
  EXPECT_GT(texel(captures.proxies, 1, 16, 16).x, 0.0f);
}

TEST_F(Bakes, on_any_number_of_threads_are_equal_to_the_bit) {
  const auto fill = [](World& filled) {
    test::SceneMaker maker(filled);
    for (int i = 0; i < 20; ++i)
      maker.draw(maker.mesh(test::box(vec3(0.3f + 0.02f * static_cast<float>(i)))), at(i % 5 - 2, i / 5, -1 - i % 3));
    Light lamp;
    lamp.intensity = 300.0f;
    for (int i = 0; i < 3; ++i) filled.create(lamp, WorldTransform{at(2 * i - 2, 3, 2)});
    IbrProxy quad;
    quad.size_m = vec2(4.0f, 3.0f);
    filled.create(quad, WorldTransform{});
    CubeProbe probe;
    probe.global = true;
    probe.resolution = 16;
    filled.create(probe, WorldTransform{at(0, 1, 2)});
  };
  std::vector<ReflectionCaptures> all;
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    const auto jobs = make_pool_executor(threads);
    World own;
    const auto drawing = open(*jobs, own);
    fill(own);
    all.push_back(test::value_of(bake_reflections(*drawing, own, {.executor = jobs.get(), .progress = {}})));
    EXPECT_EQ(all.back().proxies.texels, all[0].proxies.texels) << threads;
    EXPECT_EQ(all.back().probes.texels, all[0].probes.texels) << threads;
    EXPECT_EQ(all.back().content, all[0].content) << threads;
  }
}

// A mirror wall opposite to a wall that shines red and is lit by a green lamp, under a black sky.
TEST_F(Bakes, show_what_reflecting_surfaces_reflect) {
  Material mirror;
  mirror.roughness = 0.0f;
  mirror.metallic = 1.0f;
  mirror.reflectivity = 1.0f;
  scene.draw(scene.mesh(test::quad(2.0f, scene.material(mirror))), at(0, 0, -0.2));
  Material shining_plaster;
  shining_plaster.base_color = vec4(1.0f);
  shining_plaster.metallic = 0.0f;
  shining_plaster.roughness = 1.0f;
  shining_plaster.reflectivity = 0.0f;
  shining_plaster.emissive = vec3(2.0f, 0.0f, 0.0f);
  scene.draw(scene.mesh(test::quad(6.0f, scene.material(shining_plaster))),
             glm::rotate(at(0, 0, 4), 3.14159265358979, dvec3(0, 1, 0)));
  proxy(vec2(2.0f, 2.0f), dmat4(1.0));
  CubeProbe probe;
  probe.size_m = vec3(20.0f, 20.0f, 8.0f);
  probe.resolution = 32;
  world.create(probe, WorldTransform{at(0.3, 0, 2)});
  Light lamp;
  lamp.color = vec3(0.0f, 1.0f, 0.0f);
  lamp.intensity = 100.0f;
  world.create(lamp, WorldTransform{at(0, 0, 2.5)});
  const ReflectionCaptures captures = bake();
  ASSERT_EQ(captures.proxy_parts.size(), 1u);
  ASSERT_EQ(captures.proxy_parts[0].emission, 1);
  const vec4 all = texel(captures.proxies, 0, 26, 26), unlit = texel(captures.proxies, 1, 26, 26);
  EXPECT_NEAR(all.x, 2.0f, 0.2f) << "the wall as the mirror shows it";
  EXPECT_GT(all.y, 1.0f) << "and the lamp's light on it";
  EXPECT_NEAR(unlit.x, 2.0f, 0.2f);
  EXPECT_LT(unlit.y, 0.02f) << "no lamp's light is among the light without lamps";
}

TEST_F(Bakes, show_grass_at_rest_equally_in_the_first_and_the_last_capture) {
  Material earth;
  earth.metallic = 0.0f;
  earth.emissive = vec3(0.1f);
  const dmat4 flat = glm::rotate(at(0, 0, -1), -1.57079632679489661923, dvec3(1, 0, 0));
  const Entity lawn = scene.draw(scene.mesh(test::quad(2.0f, scene.material(earth))), flat);
  GrassSurface grass;
  grass.density = 400.0f;
  grass.height_m = vec2(0.8f, 0.05f);
  grass.width_m = 0.02f;
  world.add(lawn, grass);
  Light lamp;
  lamp.intensity = 100.0f;
  world.create(lamp, WorldTransform{at(0, 3, 3)});
  for (int i = 0; i < 4; ++i) proxy(vec2(3.0f, 2.0f), at(0, 1, 0));
  const ReflectionCaptures captures = bake(64);
  ASSERT_EQ(captures.proxy_entities.size(), 4u);
  std::size_t covered = 0, higher = 0;
  for (std::uint32_t x = 0; x < 64; ++x) {
    for (std::uint32_t y = 46; y < 60; ++y) covered += texel(captures.proxies, 0, x, y).w > 0.3f ? 1 : 0;
    for (std::uint32_t y = 0; y < 24; ++y) higher += texel(captures.proxies, 0, x, y).w > 0.0f ? 1 : 0;
  }
  EXPECT_GT(covered, 600u) << "of 896 texels between 0.12 m and 0.56 m above the ground";
  EXPECT_EQ(higher, 0u);
  const std::size_t layer = captures.proxies.layer_halves();
  const auto first = captures.proxies.texels.begin();
  for (std::ptrdiff_t i = 1; i < 4; ++i)
    EXPECT_TRUE(
        std::equal(first, first + static_cast<std::ptrdiff_t>(layer), first + i * static_cast<std::ptrdiff_t>(layer)))
        << i;
  const std::uint64_t before = capture_content(world);
  world.get<GrassSurface>(lawn).density = 100.0f;
  EXPECT_NE(capture_content(world), before);
}

TEST_F(Bakes, leave_the_worlds_captures_as_they_were) {
  proxy(vec2(4.0f, 4.0f), dmat4(1.0));
  quarter_walls();
  ReflectionCaptures own;
  own.content = 77;
  own.version = 5;
  world.set_resource(own);
  EXPECT_NE(bake().content, 77u);
  EXPECT_EQ(world.resource<ReflectionCaptures>().content, 77u);
  EXPECT_GT(world.resource<ReflectionCaptures>().version, 5u) << "what a bake has uploaded is not taken for these";
}

TEST_F(Bakes, of_a_world_without_proxies_and_probes_are_empty) {
  const ReflectionCaptures captures = bake();
  EXPECT_EQ(captures.proxies.count + captures.probes.count, 0u);
  EXPECT_NE(captures.content, 0u);
}

}  // namespace
}  // namespace gloam
