// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/modules/shadows/support/visibility_scene.h"

namespace gloam {
namespace {

using test::VisibilityScene;

/// Share of a disc of radius 1 beyond a chord at signed distance k from its centre; k < 0: the share contains the
/// centre.
double segment_share(double k) {
  if (k >= 1.0) return 0.0;
  if (k <= -1.0) return 1.0;
  return (std::acos(k) - k * std::sqrt(1.0 - k * k)) / 3.14159265358979323846;
}

/// Share of a disc around `middle`, perpendicular to the view from p, that the half plane x > 0 at height h does not
/// hide.
double half_plane_visibility(const dvec3& p, const dvec3& middle, double radius, double h) {
  const dvec3 toward = glm::normalize(middle - p);
  // Plane through p and the half plane's edge; its normal points toward x < 0.
  dvec3 normal = glm::normalize(glm::cross(dvec3(0.0, h, p.z) - p, dvec3(0.0, 0.0, 1.0)));
  if (normal.x > 0.0) normal = -normal;
  const double across = std::sqrt(1.0 - std::pow(glm::dot(normal, toward), 2));
  return segment_share(-glm::dot(normal, middle - p) / (across * radius));
}

struct Deviation {
  double mean = 0.0;
  double worst = 0.0;
  int partly = 0;
};

template <class Exact>
Deviation deviation(const VisibilityScene& scene, const TracedVisibility& traced, const Exact& exact) {
  Deviation found;
  for (std::uint32_t y = 0; y < traced.height; ++y)
    for (std::uint32_t x = 0; x < traced.width; ++x) {
      const double right = exact(scene.point(x, y));
      const double off = std::abs(traced.visibility[y * traced.width + x] / 255.0 - right);
      found.mean += off / static_cast<double>(traced.pixels());
      found.worst = std::max(found.worst, off);
      found.partly += right > 0.01 && right < 0.99 ? 1 : 0;
    }
  return found;
}

constexpr double kSheetHeight = 0.5;
void add_half_plane(VisibilityScene& scene) { scene.sheet(kSheetHeight, {0.0, 0.0, -60.0}, {60.0, 0.0, 60.0}); }

TEST(VisibilityTracing, a_half_plane_under_a_disc_leaves_the_exact_share_of_it) {
  for (const dvec3 place : {dvec3(0.0), dvec3(100e3, -2e3, 40e3)}) {
    VisibilityScene scene(place);
    const dvec3 lamp(0.3, 2.0, 0.2);
    scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = 1.2f}, lamp);
    add_half_plane(scene);
    const TracedVisibility traced = scene.trace(256);
    ASSERT_EQ(traced.lights.size(), 1u);
    const Deviation found =
        deviation(scene, traced, [&](const dvec3& p) { return half_plane_visibility(p, lamp, 0.6, kSheetHeight); });
    EXPECT_GT(found.partly, 100);
    EXPECT_LE(found.mean, traced.noise + 1e-3);
    EXPECT_LT(traced.noise, 0.01);
    EXPECT_LT(found.worst, 0.03);
  }
}

TEST(VisibilityTracing, a_half_plane_under_a_wide_sun_leaves_the_exact_share_of_it) {
  VisibilityScene scene;
  constexpr float kAngle = 0.5f;
  const dvec3 shines = glm::normalize(dvec3(0.3, -1.0, 0.1));
  scene.light({.kind = LightKind::directional, .intensity = 10.0f, .apparent_angle = kAngle}, {0, 0, 0}, shines);
  add_half_plane(scene);
  const TracedVisibility traced = scene.trace(256);
  const Deviation found = deviation(scene, traced, [&](const dvec3& p) {
    return half_plane_visibility(p, p - shines, std::tan(0.5 * static_cast<double>(kAngle)), kSheetHeight);
  });
  EXPECT_GT(found.partly, 100);
  EXPECT_LE(found.mean, traced.noise + 1e-3);
  EXPECT_LT(found.worst, 0.03);
}

TEST(VisibilityTracing, more_samples_come_nearer) {
  VisibilityScene scene;
  const dvec3 lamp(0.3, 2.0, 0.2);
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = 1.2f}, lamp);
  add_half_plane(scene);
  const auto mean_of = [&](std::uint32_t samples) {
    return deviation(scene, scene.trace(samples),
                     [&](const dvec3& p) { return half_plane_visibility(p, lamp, 0.6, kSheetHeight); })
        .mean;
  };
  const double few = mean_of(16), many = mean_of(256);
  EXPECT_LT(many, few * 0.4);
  EXPECT_LT(scene.trace(256).noise, scene.trace(16).noise);
}

/// A triangulated ball of radius 1, slightly inside the true sphere.
Primitive ball() {
  constexpr std::uint32_t kAround = 96, kUp = 48;
  Primitive p;
  for (std::uint32_t j = 0; j <= kUp; ++j)
    for (std::uint32_t i = 0; i <= kAround; ++i) {
      const float polar = kPi * static_cast<float>(j) / kUp, turn = 2.0f * kPi * static_cast<float>(i) / kAround;
      p.positions.push_back({std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)});
    }
  for (std::uint32_t j = 0; j < kUp; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = j * (kAround + 1) + i, b = a + kAround + 1;
      p.indices.insert(p.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return test::finished(std::move(p));
}

TEST(VisibilityTracing, a_ball_hides_the_lamp_in_its_umbra_and_nothing_beyond_its_penumbra) {
  VisibilityScene scene;
  scene.look_from({0.0, 2.4, 3.0});
  const dvec3 lamp(0.0, 3.0, 0.0), middle(0.0, 1.0, 0.0);
  constexpr double kBall = 0.5, kLamp = 0.2;
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = static_cast<float>(2.0 * kLamp)}, lamp);
  dmat4 matrix(kBall);
  matrix[3] = dvec4(middle, 1.0);
  scene.maker.draw(scene.maker.mesh(ball()), matrix);
  const TracedVisibility traced = scene.trace(256);
  int hidden = 0, free = 0, partly = 0;
  for (std::uint32_t y = 0; y < traced.height; ++y)
    for (std::uint32_t x = 0; x < traced.width; ++x) {
      // Angles of ball and lamp as seen from p. The half angle of the lamp's disc is atan(radius / distance).
      const dvec3 p = scene.point(x, y);
      const double apart = std::acos(glm::dot(glm::normalize(lamp - p), glm::normalize(middle - p)));
      const double ball_angle = std::asin(kBall / glm::length(middle - p));
      const double lamp_angle = std::atan(kLamp / glm::length(lamp - p));
      const std::uint8_t seen = traced.visibility[y * traced.width + x];
      if (apart + lamp_angle < ball_angle - 0.01) {
        EXPECT_EQ(seen, 0);
        ++hidden;
      } else if (apart - lamp_angle > ball_angle + 0.01) {
        EXPECT_EQ(seen, 255);
        ++free;
      } else {
        ++partly;
      }
    }
  EXPECT_GT(hidden, 10);
  EXPECT_GT(free, 200);
  EXPECT_GT(partly, 10);
}

TEST(VisibilityTracing, results_do_not_depend_on_the_executor) {
  VisibilityScene scene;
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = 0.7f}, {0.3, 2.0, 0.2});
  scene.light({.kind = LightKind::directional, .intensity = 1.0f}, {0, 0, 0});
  add_half_plane(scene);
  const TracedVisibility expected = scene.trace(64);
  EXPECT_EQ(scene.trace(64).visibility, expected.visibility);
  for (auto& executor : {make_pool_executor(2), make_shuffled_executor(11)}) {
    VisibilityInput input = scene.input(64);
    const VisibilityInput other = {.world = input.world,
                                   .geometry = input.geometry,
                                   .tracer = input.tracer,
                                   .executor = *executor,
                                   .samples = input.samples};
    const TracedVisibility traced = trace_visibility(other);
    EXPECT_EQ(traced.visibility, expected.visibility);
    EXPECT_EQ(traced.judged, expected.judged);
    EXPECT_EQ(traced.noise, expected.noise);
    EXPECT_EQ(traced.version, expected.version);
    EXPECT_EQ(visibility_identity(other), visibility_identity(input));
  }
}

TEST(VisibilityTracing, a_light_without_width_is_seen_or_not) {
  VisibilityScene scene;
  scene.light({.kind = LightKind::point, .intensity = 100.0f}, {0.3, 2.0, 0.2});
  add_half_plane(scene);
  const TracedVisibility traced = scene.trace(256);
  EXPECT_EQ(traced.noise, 0.0);
  int lit = 0;
  for (std::uint32_t y = 0; y < traced.height; ++y)
    for (std::uint32_t x = 0; x < traced.width; ++x) {
      const dvec3 p = scene.point(x, y);
      const double crossing = p.x + (0.3 - p.x) * kSheetHeight / 2.0;
      if (std::abs(crossing) < 1e-3) continue;
      const int seen = traced.visibility[y * traced.width + x];
      EXPECT_EQ(seen, crossing > 0.0 ? 0 : 255);
      lit += seen > 0 ? 1 : 0;
    }
  EXPECT_GT(lit, 100);
}

TEST(VisibilityTracing, pairs_beyond_range_or_cone_and_sky_are_not_judged) {
  VisibilityScene scene;
  scene.look_from({0.0, 1.0, 3.0});  // the sky is in the picture
  const Entity near = scene.light({.kind = LightKind::point, .intensity = 1.0f, .range_m = 1.5f}, {0.5, 1.0, 0.0});
  const Entity spot = scene.light({.kind = LightKind::spot, .intensity = 50.0f, .range_m = 9.0f, .outer_angle = 0.4f},
                                  {-0.5, 1.5, 0.0});
  const TracedVisibility traced = scene.trace(4);
  ASSERT_EQ(traced.lights, (std::vector<Entity>{near, spot}));
  int counts[2] = {0, 0};
  int sky = 0;
  for (std::uint32_t y = 0; y < traced.height; ++y)
    for (std::uint32_t x = 0; x < traced.width; ++x) {
      const std::size_t pixel = y * traced.width + x;
      const bool near_judged = traced.is_judged(pixel), spot_judged = traced.is_judged(traced.pixels() + pixel);
      if (scene.geometry.is_sky(pixel)) {
        EXPECT_FALSE(near_judged || spot_judged);
        ++sky;
        continue;
      }
      const dvec3 p = scene.point(x, y), away = p - dvec3(-0.5, 1.5, 0.0);
      EXPECT_EQ(near_judged, glm::length(p - dvec3(0.5, 1.0, 0.0)) < 1.5);
      EXPECT_EQ(spot_judged, glm::dot(glm::normalize(away), glm::normalize(dvec3(0.0, -1.0, 0.001))) > std::cos(0.4f) &&
                                 glm::length(away) < 9.0);
      counts[0] += near_judged ? 1 : 0;
      counts[1] += spot_judged ? 1 : 0;
    }
  EXPECT_GT(sky, 0);
  EXPECT_GT(counts[0], 10);
  EXPECT_GT(counts[1], 10);
}

TEST(VisibilityTracing, lights_that_cast_nothing_here_have_no_layer) {
  VisibilityScene scene;
  const Light lamp = {.kind = LightKind::point, .intensity = 100.0f};
  const Entity casting = scene.light(lamp, {0, 2, 0});
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .range_m = 1.0f}, {0, 50, 0});
  scene.world.add<ShadowCaster>(scene.light(lamp, {0, 2, 0}), {.enabled = false});
  scene.light({.kind = LightKind::point, .intensity = std::numeric_limits<float>::quiet_NaN()}, {0, 2, 0});
  scene.light({.kind = LightKind::point, .intensity = -5.0f}, {0, 2, 0});
  scene.light({.kind = LightKind::point, .color = vec3(0.0f), .intensity = 5.0f}, {0, 2, 0});
  scene.light(lamp, {std::numeric_limits<double>::infinity(), 2, 0});
  EXPECT_EQ(scene.trace(1).lights, std::vector<Entity>{casting});
}

TEST(VisibilityTracing, a_world_without_lights_gives_nothing) {
  VisibilityScene scene;
  const TracedVisibility traced = scene.trace(16);
  EXPECT_TRUE(traced.lights.empty());
  EXPECT_TRUE(traced.visibility.empty());
  EXPECT_EQ(traced.width, 48u);
  EXPECT_EQ(traced.noise, 0.0);
}

// Hard case: further.light_inside_geometry
TEST(VisibilityTracing, a_dark_ball_round_a_lamp_hides_it_however_small) {
  for (const double radius : {1e-3, 0.045, 0.5}) {
    VisibilityScene scene;
    scene.light({.kind = LightKind::point, .intensity = 100.0f}, {0, 2, 0});
    dmat4 matrix(radius);
    matrix[3] = dvec4(0.0, 2.0, 0.0, 1.0);
    scene.maker.draw(scene.maker.mesh(ball()), matrix);
    const TracedVisibility traced = scene.trace(16);
    ASSERT_FALSE(traced.visibility.empty());
    std::size_t judged = 0, seen = 0;
    for (std::size_t i = 0; i < traced.visibility.size(); ++i) {
      if ((traced.judged[i / 8] >> (i % 8) & 1) == 0) continue;
      ++judged;
      seen += traced.visibility[i] != 0 ? 1 : 0;
    }
    EXPECT_GT(judged, 100u);
    EXPECT_EQ(seen, 0u) << radius;
  }
}

TEST(VisibilityTracing, a_surface_does_not_shadow_itself_and_hides_what_is_behind_it) {
  for (const double distance : {0.5, 3.0, 300.0}) {
    VisibilityScene scene;
    scene.look_from({0.0, distance, 0.001 * distance});
    scene.sheet(0.0, {-2.0 * distance, 0.0, -2.0 * distance}, {2.0 * distance, 0.0, 2.0 * distance});
    const auto range = static_cast<float>(20.0 * distance);
    scene.light({.kind = LightKind::point, .intensity = 100.0f, .range_m = range}, {0.0, distance * 0.02, 0.0});
    scene.light({.kind = LightKind::point, .intensity = 100.0f, .range_m = range}, {0.0, -distance, 0.0});
    const TracedVisibility traced = scene.trace(1);
    ASSERT_EQ(traced.lights.size(), 2u);
    EXPECT_TRUE(std::ranges::all_of(traced.layer(0), [](std::uint8_t seen) { return seen == 255; })) << distance;
    EXPECT_TRUE(std::ranges::all_of(traced.layer(1), [](std::uint8_t seen) { return seen == 0; })) << distance;
  }
}

// Nothing is under the floor that a ray could hit: the floor's own plane hides what is below it.
TEST(VisibilityTracing, a_surface_hides_the_part_of_a_lamp_that_is_below_its_plane) {
  VisibilityScene scene;
  const dvec3 lamp(0.0, 0.05, -8.0);
  constexpr double kRadius = 0.3;
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = static_cast<float>(2.0 * kRadius)}, lamp);
  const TracedVisibility traced = scene.trace(256);
  const Deviation found = deviation(scene, traced, [&](const dvec3& p) {
    const dvec3 to = lamp - p;
    const double across = std::sqrt(1.0 - std::pow(to.y / glm::length(to), 2));
    return segment_share(-to.y / (across * kRadius));
  });
  EXPECT_GT(found.partly, 1000);
  EXPECT_LE(found.mean, traced.noise + 2e-3);
  EXPECT_LT(found.worst, 0.03);
}

TEST(VisibilityTracing, light_reaches_subsurface_materials_from_either_side) {
  VisibilityScene scene;
  scene.look_from({0.0, 3.0, 0.001}, true);
  scene.sheet(0.0, {-20.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = 0.2f}, {0.0, -2.0, 0.0});
  const TracedVisibility traced = scene.trace(16);
  EXPECT_TRUE(std::ranges::all_of(traced.visibility, [](std::uint8_t seen) { return seen == 255; }));
}

/// The floor is the top of a slab of this thickness that light passes through; all of it is seen from above.
void make_slab(VisibilityScene& scene, double thickness_m, double extinction_m, bool mirrored) {
  scene.look_from({0.0, 3.0, 0.001}, true);
  const auto root = float_to_half(static_cast<float>(std::sqrt(extinction_m)));
  scene.geometry.emissive.assign(scene.geometry.depth.size(), uvec2(0u, std::uint32_t{root} << 16));
  dmat4 matrix = glm::translate(dmat4(1.0), dvec3(0.0, -0.5 * thickness_m, 0.0));
  if (mirrored) matrix[0] = -matrix[0];
  scene.maker.draw(scene.maker.mesh(test::box(vec3(20.0f, static_cast<float>(0.5 * thickness_m), 20.0f))), matrix);
}

TEST(VisibilityTracing, light_through_a_body_falls_with_its_way_inside) {
  for (const bool mirrored : {false, true})
    for (const double thickness : {0.01, 0.1, 0.5}) {
      constexpr double kExtinction = 0.0625;
      VisibilityScene scene;
      make_slab(scene, thickness, kExtinction, mirrored);
      scene.light({.kind = LightKind::point, .intensity = 100.0f}, {0.0, -2.0, 0.0});
      const TracedVisibility traced = scene.trace(1);
      for (std::uint32_t y = 0; y < traced.height; ++y)
        for (std::uint32_t x = 0; x < traced.width; ++x) {
          const dvec3 to = dvec3(0.0, -2.0, 0.0) - scene.point(x, y);
          const double way = thickness * glm::length(to) / -to.y;
          EXPECT_NEAR(traced.visibility[y * traced.width + x], 255.0 * std::exp(-way / kExtinction), 1.0);
        }
    }
}

TEST(VisibilityTracing, light_that_something_else_blocks_does_not_pass_through_a_body) {
  VisibilityScene scene;
  make_slab(scene, 0.01, 0.0625, false);
  scene.sheet(-1.0, {-20.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
  scene.light({.kind = LightKind::point, .intensity = 100.0f, .width_m = 0.2f}, {0.0, -2.0, 0.0});
  const TracedVisibility traced = scene.trace(16);
  EXPECT_TRUE(std::ranges::all_of(traced.visibility, [](std::uint8_t seen) { return seen == 0; }));
}

TEST(VisibilityTracing, a_sheet_lets_all_of_the_light_through) {
  VisibilityScene scene;
  make_slab(scene, 0.01, 0.0625, false);
  const GeometryPicture thin = scene.geometry;
  VisibilityScene other;
  other.look_from({0.0, 3.0, 0.001}, true);
  other.geometry.emissive = thin.emissive;
  other.sheet(0.0, {-20.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
  other.light({.kind = LightKind::directional, .intensity = 1.0f, .apparent_angle = 0.01f}, {}, {0.3, 1.0, 0.1});
  const TracedVisibility traced = other.trace(16);
  EXPECT_TRUE(std::ranges::all_of(traced.visibility, [](std::uint8_t seen) { return seen == 255; }));
}

// Hard case: shadows.sheet_present
TEST(VisibilityTracing, a_sheet_three_millimetres_above_the_floor_casts_its_shadow) {
  VisibilityScene scene;
  scene.sheet(0.0, {-20.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
  scene.sheet(0.003, {0.0, 0.0, -20.0}, {20.0, 0.0, 20.0});
  scene.light({.kind = LightKind::point, .intensity = 100.0f}, {0.0, 2.0, 0.0});
  const TracedVisibility traced = scene.trace(1);
  for (std::uint32_t y = 0; y < traced.height; ++y)
    for (std::uint32_t x = 0; x < traced.width; ++x)
      if (const double at = scene.point(x, y).x; std::abs(at) > 1e-3) {
        EXPECT_EQ(traced.visibility[y * traced.width + x], at > 0.0 ? 0 : 255);
      }
}

TEST(VisibilityTracing, progress_counts_every_row_once) {
  VisibilityScene scene;
  scene.light({.kind = LightKind::point, .intensity = 100.0f}, {0.0, 2.0, 0.0});
  scene.build();
  const auto pool = make_pool_executor(2);
  std::vector<std::size_t> told;
  static_cast<void>(trace_visibility({.world = scene.world,
                                      .geometry = scene.geometry,
                                      .tracer = *scene.tracer,
                                      .executor = *pool,
                                      .samples = 1,
                                      .progress = [&](std::size_t done, std::size_t total) {
                                        EXPECT_EQ(total, 32u);
                                        told.push_back(done);
                                      }}));
  ASSERT_EQ(told.size(), 32u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], i + 1);
}

TEST(VisibilityTracing, rays_begin_on_the_smooth_surface_and_end_below_its_normal) {
  VisibilityScene scene;
  scene.light({.kind = LightKind::directional, .intensity = 10.0f}, dvec3(0.0), dvec3(-1.0, -1.0, 0.0));
  scene.sheet(0.1, dvec3(-50.0), dvec3(50.0));
  const auto mean = [&] {
    const TracedVisibility traced = scene.trace(1);
    double sum = 0.0;
    for (const std::uint8_t visible : traced.visibility) sum += visible / 255.0;
    return sum / static_cast<double>(traced.pixels());
  };
  const std::string drawn = visibility_identity((scene.build(), scene.input(1)));
  EXPECT_EQ(mean(), 0.0) << "below the sheet";
  // 20 cm up, with a normal 60° from the light, then more than 90° from it.
  const std::uint32_t up = std::uint32_t{float_to_half(0.2f)} << 16 | 255u << 8 | 128u;
  const auto set = [&](const vec3& normal) {
    scene.geometry.smooth_surfaces.assign(scene.geometry.depth.size(), uvec2(pack_normal_snorm16(normal), up));
  };
  set(glm::normalize(vec3(-0.2f, 1.0f, 0.0f)));
  EXPECT_EQ(mean(), 1.0) << "above the sheet";
  EXPECT_NE(visibility_identity(scene.input(1)), drawn);
  set(glm::normalize(vec3(-1.0f, 0.9f, 0.0f)));
  EXPECT_EQ(mean(), 0.0) << "the smooth surface faces away";
  scene.look_from({0.0, 3.0, 0.001}, true);
  set(glm::normalize(vec3(-0.2f, 1.0f, 0.0f)));
  EXPECT_EQ(mean(), 0.0) << "subsurface materials are judged where they are drawn";
}

}  // namespace
}  // namespace gloam
