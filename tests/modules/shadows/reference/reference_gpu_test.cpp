// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "modules/shadows/reference/adapter.h"
#include "modules/shadows/reference/statistics.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

using test::value_of;

/// A floor with a box under a wide lamp, seen from above, with some sky.
class ShadowReferenceFrames : public test::LitSceneTest {
 protected:
  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    LitSceneTest::SetUp();
    if (IsSkipped()) return;
    dmat4 floor(1.0);
    floor[1] = dvec4(0.0, 0.0, -1.0, 0.0);
    floor[2] = dvec4(0.0, 1.0, 0.0, 0.0);
    scene.draw(scene.mesh(test::quad(4.0f)), floor);
    scene.draw(scene.mesh(test::box({0.4f, 0.5f, 0.4f})), glm::translate(dmat4(1.0), dvec3(0.0, 0.5, 0.0)));
    lamp_ = light({.kind = LightKind::point, .intensity = 200.0f, .range_m = 6.0f, .width_m = 0.5f}, {-1.2, 3.0, 0.5});
    world.resource<SceneNames>().add("light", "lamp", lamp_);
    settings = test::look_at({0.0, 3.0, 5.0}, {0.0, 0.4, 0.0}, 96, 64);
    draw();
  }

  [[nodiscard]] TracedVisibility trace(std::uint32_t samples = 64) {
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    const auto tracer = value_of(make_scene_tracer(world, *executor, geometry.view.position));
    return trace_visibility(
        {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .samples = samples});
  }
  /// The one-channel image that a visualizer writes.
  [[nodiscard]] std::vector<float> shown(const std::string& view, std::string_view image) {
    settings.visualizer = view;
    draw();
    const ImageBytes bytes = value_of(renderer->read_image(world, settings.id, image));
    settings.visualizer = "none";
    std::vector<float> values(bytes.bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.bytes.data(), bytes.bytes.size());
    return values;
  }

  Entity lamp_;
};

TEST_F(ShadowReferenceFrames, the_view_of_a_light_shows_what_was_traced) {
  TracedVisibility traced = trace();
  ASSERT_EQ(traced.lights, std::vector<Entity>{lamp_});
  traced.shades = false;
  world.set_resource(traced);
  const std::vector<float> seen = shown("shadow_reference:lamp", "shadow_reference");
  ASSERT_EQ(seen.size(), traced.pixels());
  std::size_t judged = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // At the border of the light's reach, floats and doubles may decide differently.
    if (!traced.is_judged(i) || seen[i] < 0.0f) continue;
    EXPECT_NEAR(seen[i], traced.visibility[i] / 255.0f, 1e-3f);
    ++judged;
  }
  EXPECT_GT(judged, traced.pixels() / 3);
}

TEST_F(ShadowReferenceFrames, the_view_of_errors_shows_how_far_drawn_visibility_is_from_traced) {
  TracedVisibility traced = trace();
  traced.shades = false;
  world.set_resource(traced);
  const std::vector<float> error = shown("error", "shadow_error");
  const std::vector<float> drawn = shown("shadow:lamp", "shadow_visibility");
  ASSERT_EQ(error.size(), drawn.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    EXPECT_EQ(error[i] < 0.0f, drawn[i] < 0.0f);
    if (drawn[i] < 0.0f || !traced.is_judged(i)) continue;
    EXPECT_NEAR(error[i], std::abs(drawn[i] - traced.visibility[i] / 255.0f), 1e-3f);
    ++compared;
  }
  EXPECT_GT(compared, traced.pixels() / 3);
}

TEST_F(ShadowReferenceFrames, drawn_shadows_are_near_to_traced_ones) {
  const TracedVisibility traced = trace(256);
  const std::vector<float> drawn = shown("shadow:lamp", "shadow_visibility");
  const ShadowError error = compare_visibility(traced, 0, drawn);
  std::printf("mean %.4f, in penumbrae %.4f, wrong %.4f, acne %.4f, leaks %.4f; noise of the reference %.4f\n",
              error.mean(), error.penumbra_mean(), error.wrong_share(), error.acne_share(), error.leak_share(),
              traced.noise);
  EXPECT_GT(error.penumbra_pairs, 50u);
  EXPECT_LE(error.mean(), 0.02);
  EXPECT_LE(error.penumbra_mean(), 0.06);
  EXPECT_LE(error.wrong_share(), 0.005);
  EXPECT_EQ(error.acne, 0u);
  EXPECT_EQ(error.leaks, 0u);
  EXPECT_LE(error.unreached, traced.pixels() / 100);
}

TEST_F(ShadowReferenceFrames, shading_takes_what_was_traced_where_it_shall) {
  TracedVisibility traced = trace();
  const LinearPicture before = linear();
  std::ranges::fill(traced.visibility, std::uint8_t{0});
  traced.shades = false;
  world.set_resource(traced);
  draw();
  EXPECT_EQ(linear().rgba, before.rgba);
  traced.shades = true;
  world.set_resource(traced);
  draw();
  const LinearPicture dark = linear();
  for (std::size_t i = 0; i < traced.pixels(); ++i)
    if (traced.is_judged(i)) {
      EXPECT_EQ(dark.rgba[4 * i], 0.0f);
    }
  world.remove_resource<TracedVisibility>();
  draw();
  EXPECT_EQ(linear().rgba, before.rgba);
}

TEST_F(ShadowReferenceFrames, views_of_what_nobody_has_traced_are_an_error) {
  settings.visualizer = "error";
  const ViewRequest request{settings, {}};
  EXPECT_FALSE(renderer->render(world, std::span(&request, 1)).ok());
}

TEST_F(ShadowReferenceFrames, the_courtyard_is_traced_in_seconds) {
  const std::string file = GLOAM_SHARED_DIR "/scenes/courtyard/courtyard.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  World courtyard;
  renderer->prepare_world(courtyard);
  const KeyRegistry registry = make_key_registry(renderer->modules());
  const SceneInfo info = value_of(import_gltf(file, {}, registry, courtyard, *executor, test::gpu_log()));
  ASSERT_FALSE(info.cameras.empty());
  ViewSettings view = settings_for_camera(courtyard, info.cameras.front(), 320, 180);
  draw(courtyard, view);
  const GeometryPicture geometry = value_of(renderer->read_geometry(courtyard, view.id));
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const auto tracer = value_of(make_scene_tracer(courtyard, *executor, geometry.view.position));
  const double built = seconds();
  const TracedVisibility traced = trace_visibility(
      {.world = courtyard, .geometry = geometry, .tracer = *tracer, .executor = *executor, .samples = 64});
  std::size_t pairs = 0, dark = 0, lit = 0;
  for (std::size_t i = 0; i < traced.visibility.size(); ++i) {
    if (!traced.is_judged(i)) continue;
    ++pairs;
    dark += traced.visibility[i] == 0 ? 1 : 0;
    lit += traced.visibility[i] == 255 ? 1 : 0;
  }
  std::printf("courtyard: %llu triangles built in %.2f s; %zu lights, %zu pairs, 64 samples: %.2f s, noise %.4f\n",
              static_cast<unsigned long long>(tracer->triangles()), built, traced.lights.size(), pairs,
              seconds() - built, traced.noise);
  EXPECT_GE(traced.lights.size(), 5u);
  EXPECT_GT(pairs, traced.pixels() / 4);
  EXPECT_LT(pairs, traced.visibility.size());
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(pairs); };
  EXPECT_GT(share(dark), 0.01) << "walls and trees stand in the light";
  EXPECT_GT(share(lit), 0.1);
  EXPECT_LT(share(dark) + share(lit), 1.0) << "some pixels see a part of a lamp";
  EXPECT_GT(traced.noise, 0.0);
  EXPECT_LT(traced.noise, 0.01);
}

}  // namespace
}  // namespace gloam
