// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/lens/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gloam::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RenderView view_of(const Camera& camera, std::uint32_t width = 640, std::uint32_t height = 360) {
  ViewSettings settings;
  settings.camera = camera;
  settings.width = width;
  settings.height = height;
  return make_view(settings, 0);
}

/// Value of the depth image at a view depth.
double depth_at(const RenderView& view, double z) {
  const glm::dvec4 clip = dmat4(view.clip_from_view) * dvec4(0.0, 0.0, -z, 1.0);
  return clip.z / clip.w;
}

/// Radius in pixels by the thin lens: images of the point and of the plane of focus behind a lens of diameter f/N.
double thin_lens_radius(double fov_y, double height, double focus, double f_number, double z) {
  const double f = 0.012 / std::tan(0.5 * fov_y);
  const double sensor = 1.0 / (1.0 / f - 1.0 / focus), image = 1.0 / (1.0 / f - 1.0 / z);
  const double diameter = f / f_number * (sensor - image) / image;
  return 0.5 * diameter / 0.024 * height;
}

TEST(Lens, circles_are_those_of_a_thin_lens) {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 300; ++i) {
    Camera camera;
    camera.fov_y = static_cast<float>(between(0.2, 1.5));
    camera.near_m = 0.05f;
    const RenderView view = view_of(camera);
    const DepthOfField values{static_cast<float>(between(0.5, 20.0)), static_cast<float>(between(0.7, 4.0))};
    const auto lens = lens_of(values, view);
    ASSERT_TRUE(lens);
    for (const double z : {0.11, 0.3, 1.0, 2.5, 10.0, 1e3}) {
      const double expected = thin_lens_radius(camera.fov_y, 360.0, values.focus_m, values.f_number, z);
      ASSERT_NEAR(lens->radius_px(depth_at(view, z)), expected, 1e-4 * std::abs(expected) + 1e-4) << z;
    }
    ASSERT_NEAR(lens->radius_px(0.0), thin_lens_radius(camera.fov_y, 360.0, values.focus_m, values.f_number, 1e12),
                1e-4 * lens->radius_px(0.0));
  }
}

TEST(Lens, the_circle_is_negative_before_the_focus_and_positive_behind_it) {
  const RenderView view = view_of({});
  const Lens lens = *lens_of({.focus_m = 3.0f, .f_number = 1.4f}, view);
  EXPECT_LT(lens.radius_px(depth_at(view, 1.0)), 0.0);
  EXPECT_NEAR(lens.radius_px(depth_at(view, 3.0)), 0.0, 1e-4);
  EXPECT_GT(lens.radius_px(depth_at(view, 9.0)), 0.0);
}

TEST(Lens, an_orthographic_circle_grows_evenly_on_both_sides_of_the_focus) {
  Camera camera;
  camera.orthographic = true;
  camera.half_height_m = 1.5f;
  camera.near_m = 0.1f;
  camera.far_m = 50.0f;
  const RenderView view = view_of(camera);
  const Lens lens = *lens_of({.focus_m = 4.0f, .f_number = 2.0f}, view);
  const double aperture = 0.012 * 4.0 / 1.5 / 2.0;  // f / N
  for (const double z : {1.0, 3.0, 4.0, 5.0, 9.0, 30.0}) {
    const double in_scene = aperture * (z - 4.0) / 4.0;  // diameter, metres
    EXPECT_NEAR(lens.radius_px(depth_at(view, z)), 0.5 * in_scene / 3.0 * 360.0, 1e-3) << z;
  }
}

// Hard case: dof.f_number_infinite, dof.focus_behind
TEST(Lens, an_aperture_without_size_or_without_a_focus_blurs_nothing) {
  const RenderView view = view_of({});
  const float nan = std::nanf("");
  EXPECT_FALSE(lens_of({.focus_m = 3.0f, .f_number = kInfinity}, view));
  EXPECT_FALSE(lens_of({.focus_m = 3.0f, .f_number = nan}, view));
  EXPECT_FALSE(lens_of({.focus_m = 3.0f, .f_number = -1.0f}, view));
  EXPECT_FALSE(lens_of({.focus_m = 0.0f}, view));
  EXPECT_FALSE(lens_of({.focus_m = -2.0f}, view)) << "behind the camera";
  EXPECT_FALSE(lens_of({.focus_m = nan}, view));
  EXPECT_FALSE(lens_of({.focus_m = kInfinity, .f_number = 1e9f}, view)) << "less than half a pixel at any depth";
}

// Hard case: dof.f_number_0
TEST(Lens, an_f_number_of_0_is_a_very_wide_and_finite_lens) {
  const RenderView view = view_of({});
  const Lens lens = *lens_of({.focus_m = 3.0f, .f_number = 0.0f}, view);
  const Lens least = *lens_of({.focus_m = 3.0f, .f_number = kLeastFNumber}, view);
  EXPECT_EQ(lens.offset_px, least.offset_px);
  for (const double depth : {0.0, 1e-3, 0.5, 1.0}) EXPECT_TRUE(std::isfinite(lens.radius_px(depth)));
  EXPECT_GT(lens.radius_px(0.0), 31.0);
}

// Hard case: dof.focus_infinity
TEST(Lens, a_focus_at_infinity_keeps_the_sky_sharp) {
  Camera camera;
  const RenderView view = view_of(camera);
  const Lens lens = *lens_of({.focus_m = kInfinity, .f_number = 1.4f}, view);
  EXPECT_EQ(lens.radius_px(0.0), 0.0);
  for (const double z : {0.2, 1.0, 30.0})
    EXPECT_NEAR(lens.radius_px(depth_at(view, z)), thin_lens_radius(camera.fov_y, 360.0, 1e9, 1.4, z),
                1e-4 * std::abs(lens.radius_px(depth_at(view, z))))
        << z;
}

// Hard case: dof.focus_near_plane
TEST(Lens, a_focus_at_the_near_plane_or_inside_the_focal_length_is_moved_out) {
  Camera camera;
  camera.near_m = 0.2f;
  camera.fov_y = 0.3f;  // focal length: 0.079 m
  const RenderView view = view_of(camera);
  EXPECT_EQ(lens_of({.focus_m = 1e-3f}, view)->focus_m, static_cast<double>(0.2f));
  EXPECT_NEAR(lens_of({.focus_m = 0.2f}, view)->radius_px(depth_at(view, 0.2f)), 0.0, 1e-3);
  camera.near_m = 0.01f;
  const Lens lens = *lens_of({.focus_m = 0.02f}, view_of(camera));
  EXPECT_NEAR(lens.focus_m, 1.01 * 0.012 / std::tan(0.15), 1e-6);
  for (const double depth : {0.0, 0.3, 1.0}) EXPECT_TRUE(std::isfinite(lens.radius_px(depth)));
}

/// Position in pixels of a point of the camera's space, in the picture of a view whose camera looks along −Z.
glm::dvec2 seen_at(const RenderView& view, const dvec3& point) {
  const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(point - view.position, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.width, (0.5 - 0.5 * clip.y / clip.w) * view.height};
}

TEST(LensPoint, views_from_the_edge_of_the_lens_differ_by_the_circle_of_confusion) {
  for (const bool orthographic : {false, true}) {
    ViewSettings settings;
    settings.width = 640;
    settings.height = 360;
    settings.camera.orthographic = orthographic;
    settings.camera.fov_y = 0.5f;
    settings.camera.far_m = 60.0f;
    const RenderView pinhole = make_view(settings, 0);
    const Lens lens = *lens_of({.focus_m = 3.0f, .f_number = 1.2f}, pinhole);
    for (const glm::dvec2 edge : {glm::dvec2(1.0, 0.0), glm::dvec2(0.0, -1.0), glm::dvec2(0.6, 0.8)}) {
      settings.lens = LensPoint{kNoEntity, edge * lens.aperture_radius_m, lens.focus_m};
      const RenderView view = make_view(settings, 0);
      for (const double z : {0.5, 1.5, 3.0, 7.0, 40.0}) {
        const dvec3 point(0.1, -0.05, -z);
        const glm::dvec2 moved = seen_at(view, point) - seen_at(pinhole, point);
        const double radius = lens.radius_px(depth_at(pinhole, z));
        // Behind the focus, a point moves with the eye; y of the picture is down.
        EXPECT_NEAR(moved.x, edge.x * radius, 2e-3 + 1e-4 * std::abs(radius)) << z;
        EXPECT_NEAR(moved.y, -edge.y * radius, 2e-3 + 1e-4 * std::abs(radius)) << z;
        EXPECT_NEAR(depth_at(view, z), depth_at(pinhole, z), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test
