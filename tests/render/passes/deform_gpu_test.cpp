// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/ecs/view.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "tests/render/draws/drawn_scene.h"

// Skinned and morphed meshes are deformed only if a view or a shadow map of the frame shows them, and are right in the
// frame in which they come.

namespace gloam::test {
namespace {

dmat4 at(const dvec3& where) { return glm::translate(dmat4(1.0), where); }

class Deforming : public DrawingTest {
 protected:
  void SetUp() override {
    DrawingTest::SetUp();
    if (stage == nullptr) return;
    World& world = stage->world;
    stage->scene.draw(stage->scene.mesh(box(vec3(6.0f, 0.1f, 6.0f))), at(dvec3(0.0, -0.1, 0.0)));
    Light lamp{.kind = LightKind::spot, .intensity = 900.0f, .range_m = 9.0f};
    const dmat4 down = glm::rotate(dmat4(1.0), -1.5707963, dvec3(1.0, 0.0, 0.0));
    lamp_ = world.create(WorldTransform{at(dvec3(0.0, 7.0, 0.0)) * down}, lamp, ShadowCaster{});
    const std::uint32_t skin = two_joint_skin(world, 0, dmat4(1.0), dmat4(1.0));
    bar_ = world.create(WorldTransform{}, MeshInstance{stage->scene.mesh(skinned_bar()), skin});
    world.view<const SourceNode>().each([&](Entity entity, const SourceNode& node) { joints_[node.index] = entity; });
    // Looks down at the floor's middle: what is higher than the camera is out of view, and casts.
    stage->settings = look_at(dvec3(0.0, 3.0, 1.5), dvec3(0.0, 0.0, 0.0), 64, 48);
    place(out_of_reach(), 0.0);
    stage->render();
  }
  /// Puts the bar somewhere, bent by an angle.
  void place(const dvec3& where, double angle) {
    const dmat4 upper = at(where + dvec3(0.0, 1.0, 0.0)) * glm::rotate(dmat4(1.0), angle, dvec3(0.0, 0.0, 1.0));
    const dmat4 small = glm::scale(dmat4(1.0), dvec3(0.4));
    stage->world.get<WorldTransform>(joints_[0]).matrix = at(where) * small;
    stage->world.get<WorldTransform>(joints_[1]).matrix = upper * small;
  }
  static dvec3 in_view() { return {0.3, 0.1, 0.0}; }
  static dvec3 casting() { return {0.2, 3.6, -0.2}; }
  static dvec3 out_of_reach() { return {0.0, 0.5, 30.0}; }
  /// Dispatches of a pass in the next frame; it must equal a frame that is drawn from nothing.
  std::uint32_t dispatches(std::string_view name = "deform") {
    stage->render();
    const Picture now = stage->picture();
    std::uint32_t count = 0;
    for (const PassTime& pass : stage->renderer->report().passes)
      if (pass.name == name) count += pass.dispatches;
    stage->renderer->release_world(stage->world);
    EXPECT_EQ(now.rgba, stage->drawn().rgba);
    return count;
  }

  Entity lamp_, bar_, joints_[2];
};

TEST_F(Deforming, follows_what_views_and_shadow_maps_show) {
  const std::vector<std::uint8_t> empty = stage->drawn().rgba;
  EXPECT_EQ(dispatches(), 0u) << "nothing sees it";
  place(out_of_reach(), 0.4);
  EXPECT_EQ(dispatches(), 0u) << "it moves, and nothing sees it";
  place(casting(), 0.7);
  EXPECT_EQ(dispatches(), 1u) << "it casts";
  EXPECT_NE(stage->picture().rgba, empty) << "its shadow is seen";
  stage->world.get<Light>(lamp_).intensity = 0.0f;
  stage->world.mark_changed<Light>(lamp_);
  place(casting(), -0.7);
  EXPECT_EQ(dispatches(), 0u) << "its lamp is out";
  stage->world.get<Light>(lamp_).intensity = 900.0f;
  stage->world.mark_changed<Light>(lamp_);
  EXPECT_EQ(dispatches(), 1u) << "its lamp shines again";
  place(in_view(), 0.9);
  EXPECT_EQ(dispatches(), 1u) << "it is in view";
  stage->world.get<MeshInstance>(bar_).casts_shadows = false;
  place(casting(), 0.2);
  EXPECT_EQ(dispatches(), 0u) << "it casts nothing";
  EXPECT_EQ(stage->drawn().rgba, empty);
}

TEST_F(Deforming, rests_while_maps_are_kept) {
  place(casting(), 0.7);
  for (int frame = 0; frame < 4; ++frame) stage->render();
  std::uint32_t count = 0;
  for (const PassTime& pass : stage->renderer->report().passes)
    if (pass.name == "deform") count += pass.dispatches;
  EXPECT_EQ(count, 0u) << "the map holds its shadow";
  place(casting(), 0.75);
  EXPECT_EQ(dispatches(), 1u);
}

TEST_F(Deforming, is_shared_by_views) {
  place(in_view(), 0.5);
  ViewRequest main = stage->request(), behind = stage->request(1);
  behind.settings = look_at(dvec3(0.0, 3.0, 1.5), dvec3(0.0, 6.0, 1.4), 64, 48);
  behind.settings.id = ViewId{1};
  for (const auto& views : {std::vector{behind, main}, std::vector{main, behind}}) {
    stage->render(views);
    const Picture now = stage->picture();
    stage->renderer->release_world(stage->world);
    EXPECT_EQ(now.rgba, stage->drawn().rgba);
    place(in_view(), 0.8);
  }
}

}  // namespace
}  // namespace gloam::test
