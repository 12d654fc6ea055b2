// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "tests/modules/reflections/reference/reflection_scene.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

using test::glowing;
using test::OracleSurface;
using test::ReflectionScene;
using test::surface_of;

constexpr dvec3 kUpward(0.0, 1.0, 0.0);
constexpr double kCeiling = 2.0;

Material metal(const vec3& color, float roughness, float reflectivity = 1.0f) {
  Material material = test::painted(color, roughness, 1.0f);
  material.reflectivity = reflectivity;
  return material;
}

/// Share of mirrored radiance that a surface reflects, from the oracle of ambient light.
dvec3 share_of(const OracleSurface& s) {
  const SceneEnvironment white{.sky_zenith = vec3(1.0f), .sky_horizon = vec3(1.0f), .sky_ground = vec3(1.0f)};
  return test::oracle_ambient(s, white) - (1.0 - s.metallic) * s.base_color;
}

/// A floor (in the geometry buffer only) that mirrors a ceiling that mirrors what is below it.
struct MirroredCeiling : ReflectionScene {
  explicit MirroredCeiling(const Material& material) : ceiling(material) {
    sky() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = {0.1f, 0.3f, 0.2f}};
    square(50.0, {0.0, kCeiling, 0.0}, -kUpward, ceiling);
  }
  struct Seen {
    OracleSurface surface;  ///< of the ceiling
    Mirrored further;       ///< its mirror ray
  };
  [[nodiscard]] Seen seen(std::uint32_t x, std::uint32_t y) const {
    const Mirrored ray = mirrored(x, y);
    const dvec3 at = ray.at(kUpward, kCeiling).value();
    return {surface_of(ceiling, at, -kUpward, ray.direction), {at, ray.direction * dvec3(1.0, -1.0, 1.0)}};
  }
  Material ceiling;
};

void expect_close(const dvec3& actual, const dvec3& expected, double tolerance, std::uint32_t x, std::uint32_t y) {
  for (int c = 0; c < 3; ++c)
    ASSERT_NEAR(actual[c], expected[c], tolerance * (1e-3 + std::abs(expected[c]))) << "pixel " << x << ", " << y;
}

TEST(Bounces, a_gold_ceiling_in_a_mirror_shows_what_lies_below_it_in_gold) {
  MirroredCeiling scene(metal({1.0f, 0.77f, 0.34f}, 0.0f));
  const Material lamp = glowing({3.0f, 5.0f, 1.0f});
  const dvec3 center(0.2, -1.0, -3.0);
  const double half = 1.0;
  scene.square(half, center, kUpward, lamp);
  int on_lamp = 0, beside = 0;
  const TracedReflections traced = scene.trace({.rays = 4});
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const MirroredCeiling::Seen seen = scene.seen(x, y);
    const dvec3 at = seen.further.at(kUpward, center.y).value();
    const double margin = half - std::max(std::abs(at.x - center.x), std::abs(at.z - center.z));
    if (std::abs(margin) < 0.01) return;
    const OracleSurface lit = surface_of(lamp, at, kUpward, seen.further.direction);
    const dvec3 below = margin > 0.0 ? dvec3(lamp.emissive) + test::oracle_ambient(lit, scene.sky())
                                     : test::oracle_sky(scene.sky(), seen.further.direction);
    expect_close(radiance, share_of(seen.surface) * below, 2e-3, x, y);
    ++(margin > 0.0 ? on_lamp : beside);
  });
  EXPECT_GT(on_lamp, 20);
  EXPECT_GT(beside, 200);
}

TEST(Bounces, reflectivity_mixes_traced_surroundings_with_those_of_the_sky) {
  for (const float reflectivity : {0.0f, 0.25f, 1.0f}) {
    MirroredCeiling scene(metal(vec3(0.9f), 0.0f, reflectivity));
    const dvec3 emitted(2.0, 1.0, 4.0);
    scene.square(80.0, {0.0, -1.0, 0.0}, kUpward, glowing(vec3(emitted)));
    scene.sky().sky_zenith = vec3(0.0f);  // the glowing floor has no surroundings of its own
    scene.sky().sky_horizon = vec3(0.0f);
    scene.each_floor_pixel(scene.trace(), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
      const MirroredCeiling::Seen seen = scene.seen(x, y);
      const dvec3 of_sky = test::oracle_sky(scene.sky(), seen.further.direction);
      const double traced = static_cast<double>(reflectivity);
      expect_close(radiance, share_of(seen.surface) * glm::mix(of_sky, emitted, traced), 2e-3, x, y);
    });
  }
}

TEST(Bounces, the_last_surface_has_the_surroundings_of_the_sky) {
  // Two parallel mirrors: the ray leaves a surface after each 3 m of height.
  const Material mirror = metal({0.9f, 0.8f, 0.6f}, 0.0f);
  for (const std::uint32_t bounces : {1u, 2u, 3u, 6u}) {
    MirroredCeiling scene(mirror);
    scene.square(200.0, {0.0, -1.0, 0.0}, kUpward, mirror);
    scene.each_floor_pixel(scene.trace({.bounces = bounces}),
                           [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
                             const MirroredCeiling::Seen seen = scene.seen(x, y);
                             if (seen.further.direction.y > -0.3) return;  // leaves the squares
                             const double up = bounces % 2 == 1 ? 1.0 : -1.0;
                             const dvec3 last = seen.further.direction * dvec3(1.0, up, 1.0);
                             dvec3 expected = test::oracle_sky(scene.sky(), last);
                             // All surfaces are seen under the same angle.
                             for (std::uint32_t i = 0; i < bounces; ++i) expected *= share_of(seen.surface);
                             expect_close(radiance, expected, 2e-3, x, y);
                           });
  }
}

TEST(Bounces, a_constant_surrounding_is_reflected_as_itself_by_any_chain_of_lobes) {
  for (const float roughness : {0.0f, 0.2f, 0.6f, 1.0f})
    for (const std::uint32_t pixel_roughness : {0u, 90u, 255u}) {
      MirroredCeiling scene(metal({1.0f, 0.7f, 0.4f}, roughness));
      scene.sky() = {.sky_zenith = vec3(0.7f), .sky_horizon = vec3(0.7f), .sky_ground = vec3(0.7f)};
      scene.floor_material(pixel_roughness, 0, 255);
      scene.each_floor_pixel(scene.trace({.rays = 16}), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
        const OracleSurface seen = scene.seen(x, y).surface;
        if (pixel_roughness > 0) {
          // The ceiling is seen under many angles, and the sky beside it.
          dvec3 least(1.0);
          for (int i = 1; i <= 100; ++i) {
            OracleSurface tilted = seen;
            tilted.to_eye = dvec3(std::sqrt(1.0 - 1e-4 * i * i), -0.01 * i, 0.0);
            least = glm::min(least, share_of(tilted));
          }
          for (int c = 0; c < 3; ++c) ASSERT_LE(radiance[c], 0.7 * std::max(1.0, share_of(seen)[c]) * 1.001);
          for (int c = 0; c < 3; ++c) ASSERT_GE(radiance[c], 0.7 * least[c] * 0.999);
          return;
        }
        expect_close(radiance, 0.7 * share_of(seen), 1e-4, x, y);
      });
    }
}

/// Integral of radiance over the GGX lobe of a surface over that of 1, by the midpoint rule about the mirror direction.
dvec3 lobe_mean(const OracleSurface& s, const dvec3& face_normal, int rings,
                const std::function<dvec3(const dvec3& direction)>& radiance) {
  const dvec3 pole = glm::reflect(-s.to_eye, s.normal);
  const dvec3 u = glm::normalize(glm::cross(pole, dvec3(0.3, 0.2, 0.9))), w = glm::cross(pole, u);
  dvec3 sum(0.0);
  double total = 0.0;
  for (int ring = 0; ring < rings; ++ring)
    for (int spoke = 0; spoke < rings; ++spoke) {
      const double at = (ring + 0.5) / rings, up = test::kPiOracle * at * at;  // fine near the pole
      const double about = 2.0 * test::kPiOracle * (spoke + 0.5) / rings;
      const dvec3 l = std::cos(up) * pole + std::sin(up) * (std::cos(about) * u + std::sin(about) * w);
      if (glm::dot(l, face_normal) <= 0.0) continue;
      OracleSurface white = s;
      white.metallic = 1.0;
      white.base_color = dvec3(1.0);  // Fresnel's term is 1
      const double density = test::oracle_reflected(white, l, dvec3(1.0)).x * std::sin(up) * at;
      sum += density * radiance(l);
      total += density;
    }
  return sum / total;
}

/// A rough metal ceiling over a lamp, in double precision.
struct RoughCeiling : MirroredCeiling {
  RoughCeiling(float roughness, double lamp_half)
      : MirroredCeiling(metal({1.0f, 0.8f, 0.4f}, roughness)), half(lamp_half) {
    if (half > 0.0) square(half, kCenter, kUpward, lamp);
  }
  double half;
  static constexpr dvec3 kCenter = dvec3(0.3, -1.0, -2.0);
  Material lamp = glowing({30.0f, 20.0f, 10.0f});

  /// Radiance of everything below the ceiling in a direction from a point of it.
  [[nodiscard]] dvec3 below(const dvec3& from, const dvec3& direction) {
    const std::optional<dvec3> at = Mirrored{from, direction}.at(kUpward, kCenter.y);
    if (!at || std::max(std::abs(at->x - kCenter.x), std::abs(at->z - kCenter.z)) > half)
      return test::oracle_sky(sky(), direction);
    return dvec3(lamp.emissive) + test::oracle_ambient(surface_of(lamp, *at, kUpward, direction), sky());
  }
  /// Radiance of the ceiling on a ray from the floor.
  [[nodiscard]] dvec3 above(const dvec3& from, const dvec3& direction, int rings) {
    const dvec3 at = Mirrored{from, direction}.at(kUpward, kCeiling).value();
    const OracleSurface s = surface_of(ceiling, at, -kUpward, direction);
    return share_of(s) * lobe_mean(s, -kUpward, rings, [&](const dvec3& l) { return below(at, l); });
  }
};

/// Traced radiance against expected radiance, over some pixels.
struct Sums {
  dvec3 traced = dvec3(0.0);
  dvec3 expected = dvec3(0.0);
  double worst = 0.0;  ///< relative error of a pixel
  int pixels = 0;

  void add(const dvec3& found, const dvec3& right) {
    traced += found;
    expected += right;
    for (int c = 0; c < 3; ++c) worst = test::worse(worst, std::abs(found[c] - right[c]) / (0.1 + right[c]));
    ++pixels;
  }
  void expect_equal(double mean_error, double pixel_error, float roughness) const {
    EXPECT_GT(pixels, 2);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(traced[c] / expected[c], 1.0, mean_error) << roughness;
    EXPECT_LT(worst, pixel_error) << roughness;
  }
};

TEST(Bounces, a_rough_metal_in_a_mirror_shows_its_lobe) {
  for (const float roughness : {0.15f, 0.4f, 0.8f}) {
    RoughCeiling scene(roughness, 0.8);
    Sums sums;
    scene.each_floor_pixel(scene.trace({.rays = 4096}), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
      if (x % 10 != 3 || y % 6 != 5) return;
      const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
      sums.add(radiance, scene.above(ray.origin, ray.direction, 300));
    });
    sums.expect_equal(0.01, 0.05, roughness);
  }
}

TEST(Bounces, one_ray_for_each_surface_has_the_right_mean_also_where_weights_differ) {
  // Rough pixels at a grazing angle: the weights of their directions, and those of the ceiling's, differ most.
  RoughCeiling scene(0.8f, 0.0);
  scene.sky() = {.sky_zenith = vec3(0.0f), .sky_horizon = {8.0f, 4.0f, 1.0f}, .sky_ground = vec3(0.1f)};
  scene.look_from({0.0, 0.6, 3.0});
  scene.floor_material(150, 0, 255);
  Sums sums;
  scene.each_floor_pixel(scene.trace({.rays = 8192}), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    if (x != 20 || y % 5 != 3) return;
    const OracleSurface floor = {.position = scene.mirrored(x, y).origin,
                                 .normal = kUpward,
                                 .to_eye = -glm::normalize(scene.geometry.position(x, y)),
                                 .roughness = 150.0 / 255.0};
    sums.add(
        radiance, lobe_mean(floor, kUpward, 32, [&](const dvec3& direction) {
          const std::optional<dvec3> at = ReflectionScene::Mirrored{floor.position, direction}.at(kUpward, kCeiling);
          if (!at || std::max(std::abs(at->x), std::abs(at->z)) > 50.0) return test::oracle_sky(scene.sky(), direction);
          return scene.above(floor.position, direction, 24);
        }));
  });
  sums.expect_equal(0.015, 0.05, 0.8f);
}

TEST(Bounces, surfaces_that_reflect_little_show_as_much_as_they_should) {
  for (const std::uint32_t pixel_roughness : {0u, 20u}) {
    Material matt = test::painted(vec3(0.0f), 0.6f);  // f0 is 0.04
    matt.reflectivity = 0.3f;
    MirroredCeiling scene(matt);
    scene.sky() = {.sky_zenith = vec3(0.0f), .sky_horizon = vec3(0.0f), .sky_ground = vec3(0.0f)};
    scene.floor_material(pixel_roughness, 0, 255);
    scene.square(400.0, {0.0, -1.0, 0.0}, kUpward, glowing({20.0f, 10.0f, 5.0f}));
    Sums sums;
    scene.each_floor_pixel(scene.trace({.rays = 1024}), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
      const dvec3 share = share_of(scene.seen(x, y).surface);
      if (y < 12) return;  // far rough pixels see the ceiling under many angles
      EXPECT_LT(share.g * 0.3, 0.05);
      sums.add(radiance, share * 0.3 * dvec3(20.0, 10.0, 5.0));
    });
    sums.expect_equal(0.02, 0.2, 0.6f);
  }
}

TEST(Bounces, fog_and_quads_lie_along_the_second_ray) {
  MirroredCeiling scene(metal({1.0f, 0.8f, 0.5f}, 0.0f));
  const std::vector<vec4> image = {vec4(1.0f, 0.5f, 0.25f, 0.5f)};
  // Below the ceiling, facing up: only rays that come down see it.
  const EmissiveQuad quad = {.center = {0.0, 1.0, 0.0},
                             .half_u = {40.0, 0.0, 0.0},
                             .half_v = {0.0, 0.0, -40.0},
                             .width = 1,
                             .height = 1,
                             .rgba = image,
                             .radiance = 4.0f};
  const double density = 0.2, sky_distance = 7.0;
  const dvec3 color(0.1, 0.2, 0.3);
  const TracedReflections traced =
      scene.trace({.fog = {.density = density, .color = color, .sky_distance_m = sky_distance}, .quads = {&quad, 1}});
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const MirroredCeiling::Seen seen = scene.seen(x, y);
    const dvec3 at = seen.further.at(kUpward, 1.0).value();
    if (std::max(std::abs(at.x), std::abs(at.z)) > 39.9) return;
    const auto in_fog = [&](const dvec3& light, double alpha, double distance) {
      const double through = std::exp(-density * distance);
      return through * light + (1.0 - through) * alpha * color;
    };
    const dvec3 sky = in_fog(test::oracle_sky(scene.sky(), seen.further.direction), 1.0, sky_distance);
    const dvec3 below = in_fog(dvec3(4.0, 2.0, 1.0), 0.5, glm::length(at - seen.further.origin)) + 0.5 * sky;
    const double way = glm::length(seen.further.origin - scene.mirrored(x, y).origin);
    expect_close(radiance, in_fog(share_of(seen.surface) * below, 1.0, way), 2e-3, x, y);
  });
}

TEST(Bounces, rays_leave_a_double_sided_surface_on_the_side_that_is_seen) {
  MirroredCeiling scene(metal(vec3(1.0f), 0.0f));
  Material both = metal({0.9f, 0.6f, 0.3f}, 0.0f);
  both.double_sided = true;
  scene.square(50.0, {0.0, 1.5, 0.0}, kUpward, both);  // its back hides the ceiling
  int judged = 0;
  scene.each_floor_pixel(scene.trace(), [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
    const OracleSurface s = surface_of(both, ray.at(kUpward, 1.5).value(), -kUpward, ray.direction);
    expect_close(radiance, share_of(s) * test::oracle_sky(scene.sky(), ray.direction * dvec3(1.0, -1.0, 1.0)), 2e-3, x,
                 y);
    ++judged;
  });
  EXPECT_GT(judged, 400);
}

TEST(Bounces, a_ball_does_not_meet_its_own_surface) {
  for (const double scale : {1.0, 0.01, 100.0}) {
    ReflectionScene scene;
    SCOPED_TRACE(scale);
    scene.sky() = {.sky_zenith = vec3(0.7f), .sky_horizon = vec3(0.7f), .sky_ground = vec3(0.7f)};
    scene.look_from(scale * dvec3(0.0, 1.5, 2.5));
    scene.floor_material(0, 255, 255);
    const Material gold = metal(vec3(1.0f), 0.3f);
    dmat4 place = glm::scale(dmat4(1.0), dvec3(scale));
    place[3] = dvec4(scale * dvec3(0.0, 1.0, -1.0), 1.0);
    scene.maker.draw(scene.maker.mesh(test::round_ball(0.8f, 48, 24, scene.maker.material(gold))), place);
    int on_ball = 0;
    scene.each_floor_pixel(scene.trace({.rays = 32}), [&](std::uint32_t, std::uint32_t, const dvec3& radiance) {
      const bool ball = radiance.g < 0.699;
      // White metal of this roughness reflects the same share at all angles; a second meeting would cost it again.
      ASSERT_NEAR(radiance.g, ball ? 0.7 * (1.0 - 0.55 * 0.3) : 0.7, 1e-5);
      on_ball += ball ? 1 : 0;
    });
    EXPECT_GT(on_ball, 50) << "the ball is seen";
  }
}

}  // namespace
}  // namespace gloam
