// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/resolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gloam {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

RenderView view_of(bool orthographic = false) {
  ViewSettings settings;
  settings.width = 1280;
  settings.height = 720;
  settings.camera.fov_y = 2.0f * std::atan(0.5f);
  settings.camera.orthographic = orthographic;
  settings.camera.half_height_m = 10.0f;
  return make_view(settings, 0);
}

TEST(ShadowResolution, pixels_fall_with_distance) {
  const RenderView view = view_of();
  EXPECT_NEAR(pixels_across(view, dvec3(0, 0, -100), 1.0f), 2.0f / 100.0f * 720.0f, 0.05f);
  EXPECT_NEAR(pixels_across(view, dvec3(0, 0, -200), 1.0f), 2.0f / 200.0f * 720.0f, 0.05f);
}

TEST(ShadowResolution, pixels_are_the_same_whichever_way_the_camera_looks) {
  const RenderView view = view_of();
  EXPECT_FLOAT_EQ(pixels_across(view, dvec3(0, 0, -30), 1.0f), pixels_across(view, dvec3(0, 0, 30), 1.0f));
  EXPECT_FLOAT_EQ(pixels_across(view, dvec3(0, 0, -30), 1.0f), pixels_across(view, dvec3(30, 0, 0), 1.0f));
}

TEST(ShadowResolution, from_within_a_light_it_covers_the_picture) {
  const RenderView view = view_of();
  for (const double z : {0.0, -2.0, -4.999, 4.0, -5.0}) {
    EXPECT_EQ(pixels_across(view, dvec3(0, 0, z), 5.0f), 1280.0f);
    EXPECT_EQ(coverage(view, dvec3(0, 0, z), 5.0f), 1.0f);
  }
  EXPECT_EQ(pixels_across(view, dvec3(0, 0, -5.001), 5.0f), 1280.0f);
  EXPECT_EQ(pixels_across(view, dvec3(0, 0, -1e6), 1e9f), 1280.0f);
}

TEST(ShadowResolution, of_an_orthographic_camera_does_not_depend_on_distance) {
  const RenderView view = view_of(true);
  EXPECT_FLOAT_EQ(pixels_across(view, dvec3(0, 0, -5), 1.0f), 72.0f);
  EXPECT_FLOAT_EQ(pixels_across(view, dvec3(0, 0, -500), 1.0f), 72.0f);
  EXPECT_NEAR(coverage(view, dvec3(0, 0, -500), 1.0f), 3.14159f * 36.0f * 36.0f / (1280.0f * 720.0f), 1e-5f);
}

TEST(ShadowResolution, far_from_the_origin_is_no_different) {
  ViewSettings settings;
  settings.world_from_camera[3] = dvec4(1e5, 1e5, 1e5, 1.0);
  EXPECT_NEAR(pixels_across(make_view(settings, 0), dvec3(1e5, 1e5, 1e5 - 50.0), 1.0f),
              pixels_across(make_view(ViewSettings{}, 0), dvec3(0, 0, -50), 1.0f), 1e-4f);
}

TEST(ShadowResolution, sizes_are_the_nearest_powers_of_two_within_limits) {
  EXPECT_EQ(wanted_size(0.0f, 0), 16u);
  EXPECT_EQ(wanted_size(1.0f, 0), 16u);
  EXPECT_EQ(wanted_size(17.0f, 0), 16u);
  EXPECT_EQ(wanted_size(500.0f, 0), 512u);
  EXPECT_EQ(wanted_size(600.0f, 0), 512u);
  EXPECT_EQ(wanted_size(800.0f, 0), 1024u);
  EXPECT_EQ(wanted_size(1e30f, 0), 2048u);
  EXPECT_EQ(wanted_size(std::numeric_limits<float>::infinity(), 0), 2048u);
  EXPECT_EQ(wanted_size(kNaN, 0), 16u);
  EXPECT_EQ(wanted_size(-5.0f, 0), 16u);
}

TEST(ShadowResolution, sizes_hold_on_near_a_limit_and_follow_beyond_it) {
  const float limit = 512.0f * std::sqrt(2.0f);
  std::uint32_t size = 512;
  int changes = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const std::uint32_t next = wanted_size(limit * (frame % 2 == 0 ? 1.1f : 0.9f), size);
    changes += next == size ? 0 : 1;
    size = next;
  }
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(wanted_size(limit * 1.2f, 512), 1024u);
  EXPECT_EQ(wanted_size(limit / 1.2f, 1024), 512u);
  EXPECT_EQ(wanted_size(2000.0f, 16), 2048u);
}

/// Texels by density, for maps that take this many at density 1.
auto maps_of(double texels) {
  return [texels](float density) { return texels * static_cast<double>(density) * static_cast<double>(density); };
}

TEST(ShadowResolution, maps_are_as_dense_as_the_atlas_has_room_for) {
  EXPECT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(0.0)), 2.0f);
  EXPECT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(224.0)), 2.0f);
  EXPECT_FLOAT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(226.0)), 2.0f * std::exp2(-0.25f));
  EXPECT_FLOAT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(890.0)), 1.0f);
  EXPECT_FLOAT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(3590.0)), 0.5f);
  EXPECT_FLOAT_EQ(fitting_density(2.0f, 0.0f, 1000.0, maps_of(1e9)), 1.0f / 32.0f);
}

TEST(ShadowResolution, density_holds_on_while_maps_fit_and_follows_when_they_take_far_less) {
  float density = 0.0f;
  int changes = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const float next = fitting_density(2.0f, density, 1000.0, maps_of(frame % 2 == 0 ? 440.0 : 220.0));
    changes += next == density ? 0 : 1;
    density = next;
  }
  EXPECT_EQ(changes, 1);
  EXPECT_FLOAT_EQ(density, std::sqrt(2.0f));
  EXPECT_EQ(fitting_density(2.0f, density, 1000.0, maps_of(149.0)), 2.0f);
  EXPECT_FLOAT_EQ(fitting_density(2.0f, density, 1000.0, maps_of(890.0)), 1.0f);
  EXPECT_EQ(fitting_density(1.0f, 2.0f, 1000.0, maps_of(100.0)), 1.0f) << "the knob has changed";
}

TEST(ShadowResolution, what_a_caster_asks_for_is_a_power_of_two) {
  EXPECT_EQ(asked_size(1), 16u);
  EXPECT_EQ(asked_size(16), 16u);
  EXPECT_EQ(asked_size(1000), 1024u);
  EXPECT_EQ(asked_size(1024), 1024u);
  EXPECT_EQ(asked_size(8192), 4096u);
}

TEST(ShadowResolution, a_rim_holds_the_smallest_kernel_and_a_gutter_in_faces_of_any_size) {
  for (std::uint32_t size = 16; size <= 4096; size *= 2) {
    const float share = rim_share(size, 0.125f), half = 0.5f * static_cast<float>(size);
    const float texels = half - half / (1.0f + share);
    EXPECT_GE(share, 0.125f);
    EXPECT_GE(texels, std::min(6.0f, 0.25f * half) * 0.9999f) << size;
    EXPECT_LE(texels, 0.25f * half * 1.0001f) << size;
  }
  EXPECT_EQ(rim_share(1024, 0.125f), 0.125f);
}

TEST(ShadowResolution, brightness_is_a_number_whatever_the_light) {
  Light light;
  light.intensity = 10.0f;
  light.color = vec3(0.5f, 2.0f, -1.0f);
  EXPECT_FLOAT_EQ(brightness_of(light), 20.0f);
  light.intensity = -1.0f;
  EXPECT_EQ(brightness_of(light), 0.0f);
  light.intensity = kNaN;
  EXPECT_EQ(brightness_of(light), 0.0f);
  light.intensity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(std::isfinite(brightness_of(light)));
}

}  // namespace
}  // namespace gloam
