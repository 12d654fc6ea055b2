// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/reflected_quad.h"

#include <gtest/gtest.h>

#include "tests/modules/reflections/culling/proxy_oracle.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr ReceiverBand kFromZero{0.0, std::numeric_limits<double>::infinity()};

PlacedProxy quad(const dvec3& center, const dvec3& toward, vec2 size) {
  test::ProxyScene scene;
  scene.add(center, toward, size);
  return scene.placed().proxies[0];
}

ScreenRange exact_range(const PlacedProxy& proxy, const RenderView& view, const ReceiverBand& band = kFromZero) {
  const ReflectionViewer viewer = reflection_viewer(view);
  return exact_screen_range(reflected_volume(proxy, band, viewer), viewer);
}

/// Half width of the screen at 1 m depth.
double half_width(const RenderView& view) { return 1.0 / static_cast<double>(view.clip_from_view[0][0]); }

TEST(ReflectedQuads, before_a_level_camera_cover_the_columns_of_the_quad) {
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, 0.0);
  const ScreenRange range = exact_range(quad({1.0, 1.5, -10.0}, {0.0, 0.0, 1.0}, {4.0f, 3.0f}), view);
  EXPECT_NEAR(range.min, -1.0 / 10.0 / half_width(view), 1e-6);
  EXPECT_NEAR(range.max, 3.0 / 10.0 / half_width(view), 1e-6);
}

// Hard case: reflections.near_plane
TEST(ReflectedQuads, that_cross_the_near_plane_reach_the_border_of_the_screen) {
  // From 10 m before the camera to 10 m behind it, 1 m to its right.
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, 0.0);
  const ScreenRange range = exact_range(quad({1.0, 1.5, 0.0}, {-1.0, 0.0, 0.0}, {20.0f, 3.0f}), view);
  EXPECT_NEAR(range.min, 1.0 / 10.0 / half_width(view), 1e-6);
  EXPECT_GT(range.max, 1.0);
}

// Hard case: reflections.behind_camera
TEST(ReflectedQuads, behind_a_level_camera_are_out_of_view) {
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, 0.0);
  EXPECT_TRUE(exact_range(quad({0.0, 1.5, 5.0}, {0.0, 0.0, -1.0}, {4.0f, 3.0f}), view).empty());
}

// Hard case: reflections.behind_camera
TEST(ReflectedQuads, of_a_ceiling_behind_a_camera_that_looks_down_stay) {
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, -1.4);
  const PlacedProxy ceiling = quad({0.0, 6.0, 1.0}, {0.0, -1.0, 0.0}, {1.0f, 1.0f});
  const dvec3 forward = reflection_viewer(view).forward;
  for (const dvec3& corner : ceiling.corners()) ASSERT_LT(glm::dot(corner - view.position, forward), 0.0);
  EXPECT_FALSE(exact_range(ceiling, view).empty());
  EXPECT_TRUE(may_face_viewer(ceiling, kFromZero, reflection_viewer(view)));
}

TEST(ReflectedQuads, are_not_shown_to_a_camera_that_looks_up_or_lies_below_the_floor) {
  const PlacedProxy proxy = quad({0.0, 5.0, -5.0}, {0.0, 0.0, 1.0}, {4.0f, 10.0f});
  EXPECT_TRUE(exact_range(proxy, test::view_from({0.0, 2.0, 0.0}, 0.0, 1.5707963)).empty());
  EXPECT_TRUE(exact_range(proxy, test::view_from({0.0, -0.5, 0.0}, 0.0, -0.2)).empty());
  EXPECT_TRUE(exact_range(proxy, test::view_from({0.0, 2.0, 0.0}, 0.0, 0.0, 0.0, 0.1f, true)).empty())
      << "orthographic and level: no view ray descends";
  EXPECT_FALSE(exact_range(proxy, test::view_from({0.0, 0.0, 0.0}, 0.0, -0.2)).empty()) << "camera on the plane";
}

TEST(ReflectedQuads, below_the_floor_are_cut_there) {
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, -0.3);
  EXPECT_TRUE(exact_range(quad({0.0, -3.0, -6.0}, {0.0, 0.0, 1.0}, {4.0f, 2.0f}), view).empty());
  // A rhombus with its widest part below the floor: only the corner above it is left.
  PlacedProxy rhombus = quad({0.0, 0.0, -6.0}, {0.0, 0.0, 1.0}, {1.0f, 1.0f});
  rhombus.half_u = dvec3(1.0, 1.0, 0.0);
  rhombus.half_v = dvec3(-1.0, 1.0, 0.0);
  rhombus.center.y = -1.0;  // from −3 to 1, 1 m wide on each side of x = 0 at y = 0
  const ScreenRange range = exact_range(rhombus, view);
  rhombus.center.y = 2.5;
  const ScreenRange whole = exact_range(rhombus, view);
  EXPECT_NEAR(range.max - range.min, (whole.max - whole.min) * 0.5, 0.1 * (whole.max - whole.min));
}

TEST(ReflectedQuads, face_the_mirrored_eye_and_not_the_eye) {
  const ReflectionViewer high = reflection_viewer(test::view_from({0.0, 10.0, 0.0}, 0.0, -0.6));
  // The underside of a bridge below the eye: hidden from the eye, shown by the water under it.
  EXPECT_TRUE(may_face_viewer(quad({0.0, 4.0, -8.0}, {0.0, -1.0, 0.0}, {2.0f, 2.0f}), kFromZero, high));
  // A table top: the eye sees it, no reflection does.
  EXPECT_FALSE(may_face_viewer(quad({0.0, 4.0, -8.0}, {0.0, 1.0, 0.0}, {2.0f, 2.0f}), kFromZero, high));
  EXPECT_FALSE(may_face_viewer(quad({0.0, 4.0, -8.0}, {0.0, 0.0, -1.0}, {2.0f, 2.0f}), kFromZero, high));
  // Leans back: only low receivers see its front. Leans forward over the second floor: only high ones do.
  const PlacedProxy leaning = quad({0.0, 6.0, -4.0}, {0.0, -1.0, -0.5}, {1.0f, 1.0f});
  EXPECT_TRUE(may_face_viewer(leaning, kFromZero, high));
  EXPECT_FALSE(may_face_viewer(leaning, {6.9, 7.1}, high));
  const PlacedProxy rising = quad({0.0, 8.0, -6.0}, {0.0, 0.8, 1.0}, {1.0f, 1.0f});
  EXPECT_FALSE(may_face_viewer(rising, {-0.01, 0.01}, high));
  EXPECT_TRUE(may_face_viewer(rising, {5.99, 7.9}, high));
  EXPECT_TRUE(may_face_viewer(rising, kFromZero, high));
}

// Hard case: reflections.edge_on
TEST(ReflectedQuads, that_are_edge_on_may_face_the_viewer_and_have_a_narrow_range) {
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, -0.2);
  const PlacedProxy edge = quad({0.0, 1.5, -6.0}, {1.0, 0.0, 0.0}, {3.0f, 3.0f});
  EXPECT_TRUE(may_face_viewer(edge, kFromZero, reflection_viewer(view)));
  const ScreenRange range = exact_range(edge, view);
  ASSERT_FALSE(range.empty());
  EXPECT_NEAR(range.min, 0.0, 1e-6);
  EXPECT_NEAR(range.max, 0.0, 1e-6);
}

// Hard case: reflections.camera_on_plane
TEST(ReflectedQuads, that_lie_in_the_planes_of_the_floor_and_the_eye_have_finite_ranges) {
  // Rotated horizontal proxies, whose corners are rounded to both sides of the plane.
  test::ProxyRandom random(21);
  for (int n = 0; n < 3000; ++n) {
    const double height = random.between(0.0, 3.0);
    test::SceneProxy proxy;
    proxy.proxy.size_m = vec2(2.0f, 3.0f);
    proxy.world_from_node = glm::translate(dmat4(1.0), dvec3(0.0, height, -4.0));
    proxy.world_from_node = glm::rotate(proxy.world_from_node, random.between(-3.0, 3.0), dvec3(0.0, 1.0, 0.0));
    proxy.world_from_node = glm::rotate(proxy.world_from_node, 1.5707963267948966, dvec3(1.0, 0.0, 0.0));
    proxy.world_from_node = glm::rotate(proxy.world_from_node, random.between(-3.0, 3.0), dvec3(0.0, 0.0, 1.0));
    test::ProxyScene scene;
    scene.proxies.push_back(proxy);
    const double above = random.one_in(2) ? 1e-16 : 0.0;
    const RenderView view = test::view_from({0.0, height + above, 0.0}, 0.0, -0.5);
    const ReflectionViewer viewer = reflection_viewer(view);
    const ReflectedVolume volume = reflected_volume(scene.placed().proxies[0], {height, height + 1.0}, viewer);
    ASSERT_LE(volume.count, ReflectedVolume::kCapacity);
    for (const dvec3& point : volume.all()) EXPECT_NEAR(point.y, 0.0, 1e-12);
    const ScreenRange range = exact_screen_range(volume, viewer);
    EXPECT_TRUE(range.empty() || (std::isfinite(range.min) && std::isfinite(range.max)));
  }
}

TEST(ReflectedQuads, that_overflow_cover_the_screen) {
  PlacedProxy proxy = quad({0.0, 1.5, -6.0}, {0.0, 0.0, 1.0}, {3.0f, 3.0f});
  proxy.half_u *= 1e308;
  proxy.half_v *= 1e308;
  const ScreenRange range = exact_range(proxy, test::view_from({0.0, 2.0, 0.0}, 0.4, -0.2));
  EXPECT_LE(range.min, -1.0);
  EXPECT_GE(range.max, 1.0);
}

/// Range of NDC x of many sampled mirror images on the screen.
ScreenRange sampled_range(const test::SceneProxy& proxy, const RenderView& view, double floor) {
  ScreenRange range;
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const dvec3 point = proxy.point(i / double{kSteps} - 0.5, j / double{kSteps} - 0.5);
      const double top = std::min(point.y, view.position.y);
      if (top < floor) continue;
      for (int k = 0; k <= kSteps; ++k) {
        const double height = floor + (top - floor) * k / double{kSteps};
        const auto pixel = test::receiver_that_shows(view, point - view.position, height - view.position.y);
        if (pixel) range.grow(pixel->ndc.x);
      }
    }
  }
  return range;
}

TEST(ReflectedQuads, have_ranges_no_wider_than_their_mirror_images) {
  test::ProxyRandom random(11);
  int compared = 0;
  double excess = 0.0;
  const int views = test::scaled(150);
  for (int n = 0; n < views; ++n) {
    test::ProxyScene scene;
    scene.add({random.between(-6.0, 6.0), random.between(0.5, 5.0), random.between(-12.0, 3.0)}, random.direction(),
              {static_cast<float>(random.between(0.5, 4.0)), static_cast<float>(random.between(0.5, 4.0))});
    const RenderView view = test::view_from({0.0, random.between(0.5, 4.0), 0.0}, 0.0, random.between(-1.5, 0.2),
                                            random.one_in(2) ? random.between(-0.5, 0.5) : 0.0, 1e-3f);
    const ScreenRange sampled = sampled_range(scene.proxies[0], view, 0.0);
    if (sampled.empty()) continue;
    const ScreenRange range = exact_range(scene.placed().proxies[0], view);
    ASSERT_FALSE(range.empty());
    EXPECT_LE(range.min, sampled.min + 1e-9) << n;
    EXPECT_GE(range.max, sampled.max - 1e-9) << n;
    ++compared;
    excess += (std::min(range.max, 1.0) - std::max(range.min, -1.0)) - (sampled.max - sampled.min);
  }
  EXPECT_GE(compared, test::scaled(60));
  RecordProperty("excess", std::to_string(excess / compared));
  EXPECT_LT(excess / compared, 0.015) << "mean excess in NDC; the screen is 2 wide";
}

}  // namespace
}  // namespace gloam
