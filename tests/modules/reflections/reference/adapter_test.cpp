// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/adapter.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/modules/reflections/reference/reflection_scene.h"
#include "tests/support/memory_store.h"

namespace gloam {
namespace {

using test::MemoryStore;
using test::ReflectionScene;

/// A scene with the input of a reference, whose frame is a grey picture.
struct AdaptedScene : ReflectionScene {
  AdaptedScene() {
    sky() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(0.3f)};
    tracer = std::move(make_scene_tracer(world, *executor, view.position)).value();
    floor_material(100, 30, 150, 200);
    frame.linear = {view.width, view.height, std::vector<float>(4 * geometry.depth.size(), 0.5f)};
  }
  [[nodiscard]] ReferenceInput reference_input() {
    return {.world = world,
            .view = view,
            .knobs = knobs,
            .frame = frame,
            .samples = 8,
            .executor = *executor,
            .tracer = tracer.get(),
            .geometry = &geometry,
            .redraw = [this](const auto& change, const auto& restore) -> Result<FramePictures> {
              change(world);
              const auto* const how = world.try_resource<ReflectionOverride>();
              no_specular = how != nullptr && *how == ReflectionOverride::no_specular;
              replaced = world.try_resource<TracedReflections>() != nullptr;
              restore(world);
              return frame;
            },
            .store = &store};
  }
  KnobRegistry knobs;
  FramePictures frame;
  MemoryStore store;
  bool no_specular = false;
  bool replaced = false;
};

TEST(ReflectionReference, the_composite_adds_the_reflected_share_to_a_frame_without_specular_light) {
  AdaptedScene scene;
  const ReferenceInfo info = traced_reflections("reflections.tiers", true);
  EXPECT_EQ(info.knob, "reflections.tiers");
  EXPECT_EQ(info.kind, "traced");
  EXPECT_TRUE(info.samples);
  const auto drawn = info.draw(scene.reference_input());
  ASSERT_TRUE(drawn.ok());
  EXPECT_TRUE(scene.no_specular);
  EXPECT_EQ(scene.world.try_resource<ReflectionOverride>(), nullptr);
  const TracedReflections traced = scene.trace({.rays = 8});
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const std::size_t pixel = std::size_t{y} * traced.width + x;
    const GeometryTexel texel = scene.geometry.texel(pixel);
    const test::OracleSurface s = {.normal = dvec3(texel.normal),
                                   .to_eye = -glm::normalize(scene.geometry.position(x, y)),
                                   .base_color = dvec3(texel.base_color),
                                   .metallic = texel.metallic,
                                   .roughness = texel.roughness};
    // With the oracle's specular term for a sky of one colour, the share of that colour that is reflected.
    SceneEnvironment white{.sky_zenith = vec3(1.0f), .sky_horizon = vec3(1.0f), .sky_ground = vec3(1.0f)}, black;
    const dvec3 diffuse = (1.0 - s.metallic) * s.base_color;
    const dvec3 share = test::oracle_ambient(s, white) - diffuse;
    const dvec3 mirrored =
        (test::oracle_ambient(s, scene.sky()) - diffuse * test::oracle_hemisphere(scene.sky(), s.normal)) / share;
    const dvec3 expected = 0.5 + static_cast<double>(texel.occlusion) * share *
                                     glm::mix(mirrored, radiance, static_cast<double>(texel.reflectivity));
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(drawn->linear.rgba[4 * pixel + static_cast<std::size_t>(c)], expected[c], 1e-5);
  });
  for (std::size_t i = 0; i < traced.pixels(); ++i)
    if (scene.geometry.is_sky(i)) {
      EXPECT_EQ(drawn->linear.rgba[4 * i], 0.5f);
    }
}

TEST(ReflectionReference, specular_ambient_light_that_is_subtracted_comes_back_without_reflectivity) {
  AdaptedScene scene;
  scene.floor_material(100, 30, 0, 200);
  for (float& value : scene.frame.linear.rgba) value = 3.0f;
  const LinearPicture base = without_specular_ambient(scene.frame.linear, scene.geometry, scene.world);
  EXPECT_LT(base.rgba[4 * (20 * 40 + 5)], 2.99f);
  const LinearPicture again = compose_reflections(base, scene.geometry, scene.world, scene.trace({.rays = 4}));
  for (std::size_t i = 0; i < again.rgba.size(); ++i) ASSERT_NEAR(again.rgba[i], 3.0f, 1e-5);
}

TEST(ReflectionReference, a_drawn_reference_puts_traced_radiance_into_the_world) {
  AdaptedScene scene;
  ASSERT_TRUE(traced_reflections("reflections.tiers", false).draw(scene.reference_input()).ok());
  EXPECT_TRUE(scene.replaced);
  EXPECT_EQ(scene.world.try_resource<TracedReflections>(), nullptr);
  ASSERT_TRUE(put_traced_reflections(scene.world, scene.reference_input()).ok());
}

TEST(ReflectionReference, fog_and_fires_of_the_world_enter) {
  AdaptedScene scene;
  const ExtrasOf extras = [](const World&) {
    ReflectionExtras thick;
    thick.fog = {.density = 1e3, .color = dvec3(0.25)};
    return thick;
  };
  ASSERT_TRUE(put_traced_reflections(scene.world, scene.reference_input(), extras).ok());
  const TracedReflections& traced = scene.world.resource<TracedReflections>();
  for (std::size_t i = 0; i < traced.pixels(); ++i) {
    if (traced.radiance[4 * i + 3] > 0.0f) {
      EXPECT_NEAR(traced.radiance[4 * i], 0.25f, 1e-6f);
    }
  }
  EXPECT_TRUE(traced_reflections("reflections.tiers", true, extras).draw(scene.reference_input()).ok());
}

TEST(ReflectionReference, results_are_stored_and_found_again) {
  AdaptedScene scene;
  const auto first = find_reflections(scene.reference_input());
  ASSERT_TRUE(first.ok());
  ASSERT_EQ(scene.store.kept.size(), 1u);
  const auto second = find_reflections(scene.reference_input());
  EXPECT_EQ(second->radiance, first->radiance);
  EXPECT_EQ(scene.store.kept.size(), 1u);
  // Each change gives another identity.
  scene.sky().sky_zenith.x += 0.1f;
  ASSERT_TRUE(find_reflections(scene.reference_input()).ok());
  EXPECT_EQ(scene.store.kept.size(), 2u);
  scene.floor_material(101, 30, 150, 200);
  ASSERT_TRUE(find_reflections(scene.reference_input()).ok());
  EXPECT_EQ(scene.store.kept.size(), 3u);
  scene.light(Light{}, {0.0, 1.0, 0.0});
  ASSERT_TRUE(find_reflections(scene.reference_input()).ok());
  EXPECT_EQ(scene.store.kept.size(), 4u);
  ASSERT_TRUE(find_reflections(scene.reference_input(), {.fog = {.density = 0.1}}).ok());
  EXPECT_EQ(scene.store.kept.size(), 5u);
  ASSERT_TRUE(find_reflections(scene.reference_input(), {.bounces = 3}).ok());
  EXPECT_EQ(scene.store.kept.size(), 6u);
  scene.maker.material(test::painted(vec3(0.5f)));
  ASSERT_TRUE(find_reflections(scene.reference_input()).ok());
  EXPECT_EQ(scene.store.kept.size(), 7u);
  scene.world.resource<SceneAssets>().materials.back().reflectivity = 0.5f;
  ASSERT_TRUE(find_reflections(scene.reference_input()).ok());
  EXPECT_EQ(scene.store.kept.size(), 8u);
}

TEST(ReflectionReference, damaged_bytes_are_not_read) {
  AdaptedScene scene;
  const std::string bytes = to_bytes(scene.trace({.rays = 1}));
  EXPECT_TRUE(reflections_from_bytes(bytes).has_value());
  EXPECT_FALSE(reflections_from_bytes(bytes.substr(0, bytes.size() - 4)).has_value());
  EXPECT_FALSE(reflections_from_bytes(bytes + "0123456789abcdef").has_value());
  EXPECT_FALSE(reflections_from_bytes("").has_value());
}

TEST(ReflectionReference, missing_inputs_are_usage_errors) {
  AdaptedScene scene;
  ReferenceInput without_tracer = scene.reference_input();
  without_tracer.tracer = nullptr;
  EXPECT_FALSE(find_reflections(without_tracer).ok());
  ReferenceInput without_redraw = scene.reference_input();
  without_redraw.redraw = {};
  EXPECT_FALSE(trace_reflections(without_redraw).ok());
  EXPECT_FALSE(draw_traced_reflections(without_redraw).ok());
}

}  // namespace
}  // namespace gloam
