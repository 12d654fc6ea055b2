// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Shadows of captures, which share an atlas.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "tests/modules/shadows/support/shadow_world.h"

namespace gloam {
namespace {

struct CaptureShadows : testing::Test {
  test::ShadowWorld scene;

  /// Captures that look at the lights from places 10 cm apart.
  [[nodiscard]] std::vector<ViewSettings> captures(std::uint32_t count) const {
    std::vector<ViewSettings> views(count, scene.settings);
    for (std::uint32_t i = 0; i < count; ++i) {
      views[i].id = ViewId{10 + i};
      views[i].purpose = ViewPurpose::capture;
      views[i].follow_camera = false;
      views[i].width = views[i].height = 128;
      views[i].world_from_camera = glm::translate(dmat4(1.0), dvec3(0.1 * i, 0, 0));
    }
    return views;
  }
  void run(std::span<const ViewSettings> views, std::uint64_t frame) {
    scene.run(*make_serial_executor(), views, frame);
  }
  [[nodiscard]] const ViewFaces& shadows(const ViewSettings& view) const {
    return scene.world.view_resource<ViewFaces>(view.id);
  }
};

TEST_F(CaptureShadows, find_room_for_all_with_local_lights_and_a_sun) {
  scene.add_random(40);
  scene.add_sun();
  const std::vector<ViewSettings> views = captures(24);
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    run(views, frame);
    for (const ViewSettings& view : views) {
      EXPECT_EQ(shadows(view).faces_left_out, 0u) << "frame " << frame << ", view " << view.id.value;
      EXPECT_EQ(shadows(view).faces_shrunk, 0u) << "frame " << frame << ", view " << view.id.value;
    }
  }
}

TEST_F(CaptureShadows, share_maps_of_local_lights) {
  scene.add_random(10);
  const std::vector<ViewSettings> views = captures(2);
  run(views, 0);
  ASSERT_FALSE(shadows(views[0]).faces.empty());
  for (const ShadowFace& first : shadows(views[0]).faces)
    for (const ShadowFace& second : shadows(views[1]).faces)
      if (first.light == second.light && first.index == second.index) {
        EXPECT_EQ(first.square, second.square);
      }
}

TEST_F(CaptureShadows, leave_no_room_idle_for_captures_that_are_not_drawn) {
  scene.add_sun();
  scene.add_mesh(dvec3(0, 0, -8));
  const std::vector<ViewSettings> views = captures(24);
  const auto size = [&](const ViewSettings& view) { return shadows(view).faces.at(0).square.size; };
  run({views.data(), 1}, 0);
  const std::uint32_t alone = size(views[0]);
  run(views, 1);
  run({views.data(), 1}, 2);
  EXPECT_EQ(size(views[0]), alone);
}

}  // namespace
}  // namespace gloam
