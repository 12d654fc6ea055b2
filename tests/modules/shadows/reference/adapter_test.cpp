// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/adapter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "modules/shadows/module.h"
#include "tests/modules/shadows/support/visibility_scene.h"
#include "tests/support/memory_store.h"

namespace gloam {
namespace {

class ShadowReference : public testing::Test {
 protected:
  ShadowReference() {
    light_ = scene_.light({.kind = LightKind::point, .intensity = 100.0f, .range_m = 50.0f, .width_m = 0.7f},
                          {0.3, 2.0, 0.2});
    scene_.sheet(0.5, {0.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
    scene_.build();
  }
  [[nodiscard]] ReferenceInput input() {
    return {.world = scene_.world,
            .view = scene_.view,
            .knobs = knobs_,
            .frame = frame_,
            .samples = 16,
            .executor = *scene_.executor,
            .tracer = scene_.tracer.get(),
            .geometry = &scene_.geometry};
  }

  test::VisibilityScene scene_;
  Entity light_;
  KnobRegistry knobs_;
  FramePictures frame_;
};

TEST_F(ShadowReference, bytes_give_the_same_visibility_back) {
  const TracedVisibility traced = scene_.trace(16);
  const std::string bytes = to_bytes(traced);
  const auto again = visibility_from_bytes(bytes);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->visibility, traced.visibility);
  EXPECT_EQ(again->judged, traced.judged);
  EXPECT_EQ(again->lights, traced.lights);
  EXPECT_EQ(again->version, traced.version);
  EXPECT_EQ(again->noise, traced.noise);
  EXPECT_EQ(again->samples, 16u);
  for (const std::size_t length : {std::size_t{0}, std::size_t{8}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_FALSE(visibility_from_bytes(std::string_view(bytes).substr(0, length)).has_value()) << length;
  EXPECT_FALSE(visibility_from_bytes(bytes + "x").has_value());
}

TEST_F(ShadowReference, what_was_traced_once_is_taken_from_the_store) {
  const test::MemoryStore store;
  ReferenceInput what = input();
  what.store = &store;
  const auto first = find_visibility(what);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(store.kept.size(), 1u);
  EXPECT_EQ(store.loads, 0);
  const auto second = find_visibility(what);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(store.loads, 1);
  EXPECT_EQ(second->visibility, first->visibility);
  // Damaged bytes are detected and traced again.
  store.kept.begin()->second.resize(100);
  const auto third = find_visibility(what);
  ASSERT_TRUE(third.ok());
  EXPECT_EQ(third->visibility, first->visibility);
}

TEST_F(ShadowReference, identity_tells_apart_what_gives_other_visibilities) {
  const std::string before = visibility_identity(scene_.input(16));
  EXPECT_EQ(visibility_identity(scene_.input(16)), before);
  EXPECT_NE(visibility_identity(scene_.input(32)), before);
  scene_.world.get<Light>(light_).width_m = 0.71f;
  EXPECT_NE(visibility_identity(scene_.input(16)), before);
  scene_.world.get<Light>(light_).width_m = 0.7f;
  scene_.world.get<Light>(light_).color = vec3(0.5f);
  EXPECT_EQ(visibility_identity(scene_.input(16)), before) << "colours cast the same shadow";
  scene_.geometry.depth[7] *= 1.01f;
  EXPECT_NE(visibility_identity(scene_.input(16)), before);
}

TEST_F(ShadowReference, the_frame_is_drawn_again_with_traced_visibility_in_the_world) {
  ReferenceInput what = input();
  int drawn = 0;
  what.redraw = [&](const std::function<void(World&)>& change,
                    const std::function<void(World&)>& restore) -> Result<FramePictures> {
    change(scene_.world);
    const TracedVisibility* traced = scene_.world.try_resource<TracedVisibility>();
    EXPECT_NE(traced, nullptr);
    EXPECT_TRUE(traced->shades);
    EXPECT_EQ(traced->lights, std::vector<Entity>{light_});
    ++drawn;
    restore(scene_.world);
    return FramePictures{.linear = {1, 1, {1, 2, 3, 4}}};
  };
  const std::vector<ReferenceInfo> references = shadow_references();
  ASSERT_FALSE(references.empty());
  const auto pictures = references.front().draw(what);
  ASSERT_TRUE(pictures.ok());
  EXPECT_EQ(pictures->linear.rgba, (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(drawn, 1);
  EXPECT_EQ(scene_.world.try_resource<TracedVisibility>(), nullptr);
}

TEST_F(ShadowReference, without_triangles_or_redraw_there_is_an_error_and_no_crash) {
  ReferenceInput what = input();
  EXPECT_FALSE(shadow_references().front().draw(what).ok());
  what.redraw = [](const auto&, const auto&) -> Result<FramePictures> { return FramePictures{}; };
  what.tracer = nullptr;
  EXPECT_FALSE(shadow_references().front().draw(what).ok());
  what.tracer = scene_.tracer.get();
  what.geometry = nullptr;
  EXPECT_FALSE(shadow_references().front().draw(what).ok());
}

TEST_F(ShadowReference, every_knob_that_changes_the_model_is_judged_by_tracing) {
  make_shadows_module()->knobs(knobs_);
  std::vector<std::string> known, judged;
  for (const Knob& knob : knobs_.knobs()) {
    if (knob.name == "shadows.reuse") continue;                       // it does not change the picture
    if (knob.name != "shadows.classify") known.push_back(knob.name);  // it has a measure
    EXPECT_EQ(knob.exact, "") << knob.name << ": which value is nearest to traced light depends on the scene";
  }
  for (const ReferenceInfo& reference : shadow_references()) {
    EXPECT_EQ(reference.kind, "traced");
    EXPECT_TRUE(reference.samples);
    EXPECT_EQ(reference.follows_value, reference.knob == "shadows.terminator");
    judged.push_back(reference.knob);
  }
  std::ranges::sort(known);
  std::ranges::sort(judged);
  EXPECT_EQ(judged, known);
}

TEST_F(ShadowReference, views_find_it_in_the_world_and_shading_leaves_it_alone) {
  ASSERT_TRUE(put_traced_visibility(scene_.world, input()).ok());
  const TracedVisibility* traced = scene_.world.try_resource<TracedVisibility>();
  ASSERT_NE(traced, nullptr);
  EXPECT_FALSE(traced->shades);
}

}  // namespace
}  // namespace gloam
