// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/lights/lists/light_scenes.h"
#include "tests/render/frame/failing_module.h"

// Tile light masks and zBins are uploaded only when they changed. A frame that reads old ones would lose lights, so
// pictures are compared with those of all lights.

namespace gloam::test {
namespace {

class LightUploads : public LightScenesTest {
 protected:
  [[nodiscard]] ModuleList make_modules() override {
    ModuleList modules = LightScenesTest::make_modules();
    modules.push_back(std::make_unique<FailingModule>());
    return modules;
  }
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LightScenesTest::SetUp());
    if (!IsSkipped()) set("lights.culling", "tiled");
  }
  /// A stage with lights of both kinds around it.
  LightScene scattered() {
    LightScene s = stage();
    for (int i = 0; i < 40; ++i) {
      const dvec3 at(-4.0 + 0.2 * i, 0.6 + 0.1 * (i % 9), -3.0 + 0.37 * (i % 13));
      lamps.push_back(i % 2 == 0 ? s.light(point_lamp(2.0f, 1.5f), at)
                                 : s.light(spot_lamp(4.0f, 2.5f, 0.6f), at, dvec3(0.2, -1.0, 0.1)));
    }
    return s;
  }
  [[nodiscard]] bool uploads(std::uint32_t view = 0) {
    const FrameReport report = renderer->report();
    return std::ranges::any_of(report.passes,
                               [&](const PassTime& pass) { return pass.name == "light_uploads" && pass.view == view; });
  }
  /// Draws until the farthest depth is known, on which zBins depend.
  void settle(LightScene& s) {
    for (int i = 0; i < 3; ++i) draw(*s.world, s.view);
  }
  void move(LightScene& s, Entity entity, const dvec3& by) {
    s.world->get<WorldTransform>(entity).matrix[3] += dvec4(by, 0.0);
    s.world->mark_changed<WorldTransform>(entity);
  }
  /// The last frame, which is compared with one that is drawn by looping over all lights.
  void expect_last_is_brute(LightScene& s, const std::string& what) {
    Drawn last;
    last.light = linear(s.view.id.value);
    last.picture = picture(s.view.id.value);
    expect_same(last, drawn(*s.world, s.view, "brute"), what);
    set("lights.culling", "tiled");
  }
  std::vector<Entity> lamps;
};

TEST_F(LightUploads, stop_while_camera_and_lights_stand) {
  LightScene s = scattered();
  draw(*s.world, s.view);
  EXPECT_TRUE(uploads());
  settle(s);
  for (int i = 0; i < 3; ++i) {
    draw(*s.world, s.view);
    EXPECT_FALSE(uploads()) << i;
  }
  expect_last_is_brute(s, "standing");
  renderer->release_world(*s.world);
}

TEST_F(LightUploads, follow_the_camera_and_the_lights) {
  LightScene s = scattered();
  settle(s);
  s.look(dvec3(-1.0, 1.5, 4.5), dvec3(0.3, 0.5, -1.0), 97, 65);
  draw(*s.world, s.view);
  EXPECT_TRUE(uploads()) << "camera";
  expect_last_is_brute(s, "camera");
  settle(s);
  move(s, lamps[3], dvec3(0.9, 0.2, 0.5));
  draw(*s.world, s.view);
  EXPECT_TRUE(uploads()) << "light";
  expect_last_is_brute(s, "light");
  settle(s);
  s.world->get<Light>(lamps[4]).color = vec3(0.1f, 0.2f, 1.0f);
  s.world->mark_changed<Light>(lamps[4]);
  draw(*s.world, s.view);
  EXPECT_FALSE(uploads()) << "a colour moves no light";
  expect_last_is_brute(s, "colour");
  renderer->release_world(*s.world);
}

TEST_F(LightUploads, are_made_again_after_a_frame_that_was_given_up) {
  LightScene s = scattered();
  settle(s);
  ViewSettings before = s.view;
  s.look(dvec3(-1.0, 1.5, 4.5), dvec3(0.3, 0.5, -1.0), 97, 65);
  for (const FailAt at : {FailAt::declaration_error, FailAt::recording_error}) {
    s.world->resource<Failure>().at = at;
    const ViewRequest request{s.view, {}};
    EXPECT_FALSE(renderer->render(*s.world, std::span(&request, 1)).ok());
    s.world->resource<Failure>().at = FailAt::nowhere;
    draw(*s.world, s.view);
    EXPECT_TRUE(uploads()) << static_cast<int>(at);
    expect_last_is_brute(s, "after the given-up frame");
    // A given-up frame writes nothing: the contents from before are still there.
    settle(s);
    s.world->resource<Failure>().at = at;
    const ViewRequest old{before, {}};
    EXPECT_FALSE(renderer->render(*s.world, std::span(&old, 1)).ok());
    s.world->resource<Failure>().at = FailAt::nowhere;
    draw(*s.world, s.view);
    EXPECT_FALSE(uploads()) << static_cast<int>(at);
    expect_last_is_brute(s, "back");
    settle(s);
    std::swap(s.view, before);
  }
  renderer->release_world(*s.world);
}

TEST_F(LightUploads, are_kept_apart_by_view_and_size) {
  LightScene s = scattered();
  ViewSettings other = look_at(dvec3(-4.0, 2.5, -1.0), dvec3(0.0, 0.5, -1.0), 33, 71);
  other.id = ViewId{1};
  const auto draw_both = [&] {
    const ViewRequest both[] = {{s.view, {}}, {other, {}}};
    ASSERT_TRUE(renderer->render(*s.world, both).ok());
    ASSERT_TRUE(renderer->wait().ok());
  };
  for (int i = 0; i < 4; ++i) draw_both();
  EXPECT_FALSE(uploads(0));
  EXPECT_FALSE(uploads(1));
  other.width = 97;
  draw_both();
  EXPECT_FALSE(uploads(0));
  EXPECT_TRUE(uploads(1)) << "another size";
  Drawn second;
  second.light = linear(1);
  second.picture = picture(1);
  expect_same(second, drawn(*s.world, other, "brute"), "resized");
  renderer->release_world(*s.world);
}

TEST_F(LightUploads, of_frames_in_flight_belong_to_their_frame) {
  LightScene s = scattered();
  const ViewSettings a = s.view;
  s.look(dvec3(-1.0, 1.5, 4.5), dvec3(0.3, 0.5, -1.0), 97, 65);
  const ViewSettings b = s.view;
  for (const int last : {4, 5}) {
    for (int i = 0; i <= last; ++i) {
      const ViewRequest request{i % 2 == 0 ? a : b, {}};
      ASSERT_TRUE(renderer->render(*s.world, std::span(&request, 1)).ok());
    }
    ASSERT_TRUE(renderer->wait().ok());
    s.view = last % 2 == 0 ? a : b;
    expect_last_is_brute(s, "in flight");
  }
  renderer->release_world(*s.world);
}

}  // namespace
}  // namespace gloam::test
