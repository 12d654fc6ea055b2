// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Diffuse light of probes against rays in a room, and against the probes' terms at each pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "engine/math/packing.h"
#include "modules/reflections/diffuse/harmonics.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/reference/shading.h"
#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

/// Frames whose light of the surroundings comes from probes.
class DiffuseProbes : public JudgedReflections {
 protected:
  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    JudgedReflections::SetUp();
    if (IsSkipped()) return;
    settings = look_at(dvec3(0.0, 1.5, 2.9), dvec3(0.0, 1.5, 0.0), 96, 64);
    environment() = {.sky_zenith = vec3(0.0f), .sky_horizon = vec3(0.0f), .sky_ground = vec3(0.0f)};
  }
  /// Six walls around a space, each with its colour: −X, +X, −Y, +Y, −Z, +Z.
  void room(const dvec3& center, const dvec3& half, const std::array<vec3, 6>& colors) {
    constexpr double kThick = 0.1;
    for (int wall = 0; wall < 6; ++wall) {
      const int axis = wall / 2;
      dvec3 at = center;
      vec3 size(half + kThick);
      at[axis] += (wall % 2 == 0 ? -1.0 : 1.0) * (half[axis] + 0.5 * kThick);
      size[axis] = static_cast<float>(0.5 * kThick);
      solid(matt(colors[static_cast<std::size_t>(wall)]), at, size);
    }
  }
  [[nodiscard]] LinearPicture with(const char* source) {
    EXPECT_TRUE(renderer->knobs().set("lighting.indirect", source).ok());
    return drawn();
  }
  /// A white room of 4 × 3 × 6 m whose left wall is red, under a lamp with a probe beside it.
  void red_room() {
    std::array<vec3, 6> colors;
    colors.fill(vec3(0.7f));
    colors[0] = vec3(0.7f, 0.02f, 0.02f);
    room({0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, colors);
    Light what;
    what.intensity = 6.0f;
    what.width_m = 0.2f;
    light(what, {0.0, 2.2, 0.0});
  }
  /// Probes in the cells of a box, each with its whole share in its cell.
  void probes(const dvec3& center, const dvec3& half, const glm::ivec3& cells) {
    const dvec3 size = 2.0 * half / dvec3(cells);
    for (int z = 0; z < cells.z; ++z)
      for (int y = 0; y < cells.y; ++y)
        for (int x = 0; x < cells.x; ++x) {
          const Entity one = probe(vec3(1.25 * size), center - half + (dvec3(x, y, z) + 0.5) * size);
          world.get<CubeProbe>(one).resolution = 4;  // its picture is not looked at
        }
  }
};

/// Directions of a Fibonacci spiral.
dvec3 spread(int index, int count) {
  const double y = 1.0 - (2.0 * index + 1.0) / count, radius = std::sqrt(1.0 - y * y);
  const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

/// Share of a probe with an upright box at a point of a surface.
double box_share(const dvec3& center, const dvec3& half, const dvec3& p, const dvec3& normal) {
  const auto share = [&](const dvec3& point) {
    const dvec3 inside = (1.0 - glm::abs((point - center) / half)) / 0.2;
    return std::clamp(std::min({inside.x, inside.y, inside.z}), 0.0, 1.0);
  };
  const dvec3 out = glm::abs(normal / half);
  return std::min(share(p), share(p + normal * (0.2 / std::max({out.x, out.y, out.z}))));
}

/// The red room by brute force in double precision: nothing stands in it, so that each ray meets a lit wall.
struct RoomOracle {
  dvec3 center, half, lamp;
  double candela;
  std::array<vec3, 6> colors;

  /// Light of the lamp from the wall that a ray meets.
  [[nodiscard]] dvec3 radiance(const dvec3& from, const dvec3& direction) const {
    double nearest = 1e30;
    int wall = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0.0) continue;
      const double side = direction[axis] < 0.0 ? -1.0 : 1.0;
      const double distance = (center[axis] + side * half[axis] - from[axis]) / direction[axis];
      if (distance < nearest) nearest = distance, wall = 2 * axis + (side > 0.0 ? 1 : 0);
    }
    dvec3 normal(0.0);
    normal[wall / 2] = wall % 2 == 0 ? 1.0 : -1.0;
    const dvec3 to_lamp = lamp - (from + nearest * direction);
    const double square = glm::dot(to_lamp, to_lamp);
    const TwinPoint point = twin_point(-direction, normal, dvec3(colors[static_cast<std::size_t>(wall)]), 0.0, 0.9);
    return reflected_light(point, to_lamp / std::sqrt(square), dvec3(candela / square));
  }
  /// Mean of the hemisphere, weighted by the cosine.
  [[nodiscard]] dvec3 hemisphere(const dvec3& p, const dvec3& n) const {
    constexpr int kSide = 32;
    const dvec3 across = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = glm::normalize(glm::cross(across, n)), v = glm::cross(n, u);
    dvec3 sum(0.0);
    for (int i = 0; i < kSide * kSide; ++i) {
      const double square = (i % kSide + 0.5) / kSide, angle = 2.0 * std::numbers::pi * (i / kSide + 0.5) / kSide;
      sum += radiance(p + 1e-9 * n,
                      std::sqrt(square) * (std::cos(angle) * u + std::sin(angle) * v) + std::sqrt(1.0 - square) * n);
    }
    return sum / static_cast<double>(kSide * kSide);
  }
};

/// Probes in the cells of the room that are perfect but for what order 2 leaves out: the cosine lobe is cut off after
/// its quadratic part, 1 / 4 + x / 2 + 5 (3 x² − 1) / 32.
class PerfectProbes {
 public:
  PerfectProbes(const RoomOracle& room, const glm::ivec3& cells) : half_(1.25 * room.half / dvec3(cells)) {
    for (int z = 0; z < cells.z; ++z)
      for (int y = 0; y < cells.y; ++y)
        for (int x = 0; x < cells.x; ++x) {
          centers_.push_back(room.center - room.half + (dvec3(x, y, z) + 0.5) * (2.0 * room.half / dvec3(cells)));
          for (int i = 0; i < kRays; ++i) seen_.push_back(room.radiance(centers_.back(), spread(i, kRays)));
        }
  }
  [[nodiscard]] dvec3 light(const dvec3& p, const dvec3& normal) const {
    dvec3 sum(0.0);
    double covered = 0.0;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const double share = box_share(centers_[i], half_, p, normal) * (1.0 - covered);
      if (share <= 0.0) continue;
      dvec3 mean(0.0);
      for (int k = 0; k < kRays; ++k) {
        const double x = glm::dot(spread(k, kRays), normal);
        mean += (0.25 + 0.5 * x + 5.0 / 32.0 * (3.0 * x * x - 1.0)) * seen_[i * kRays + static_cast<std::size_t>(k)];
      }
      sum += share * glm::max(mean * (4.0 / kRays), dvec3(0.0));
      covered += share;
    }
    return sum;
  }

 private:
  static constexpr int kRays = 2048;
  dvec3 half_;
  std::vector<dvec3> centers_, seen_;
};

/// Mean distance of two sets of light, as a share of the second one's mean.
double difference(const std::vector<dvec3>& found, const std::vector<dvec3>& expected) {
  double sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    sum += glm::length(found[i] - expected[i]);
    all += glm::length(expected[i]);
  }
  return sum / all;
}

// What perfect probes miss of the light, because their light is that of other places and of order 2, is no fault of the
// picture. So the picture is compared with perfect probes. Its own errors: the cubes have 64² pixels a face, 1.4° wide,
// and half floats.
TEST_F(DiffuseProbes, a_white_floor_beside_a_red_wall_turns_as_red_as_perfect_probes_of_order_two_make_it) {
  red_room();
  settings = look_at(dvec3(0.0, 1.5, 2.9), dvec3(0.0, 1.5, 0.0), 48, 32);
  std::array<vec3, 6> colors;
  colors.fill(vec3(0.7f));
  colors[0] = vec3(0.7f, 0.02f, 0.02f);
  const RoomOracle room{{0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, {0.0, 2.2, 0.0}, 6.0, colors};
  const LinearPicture lamp = with("sky");
  sky(vec3(1.0f));
  const LinearPicture even = with("sky");  // by which each pixel reflects the light that is the same from all sides
  sky(vec3(0.0f));
  const GeometryPicture seen = geometry();
  double before = 1.0;
  for (const glm::ivec3 cells : {glm::ivec3(1), glm::ivec3(3, 2, 4)}) {
    std::vector<Entity> old;
    world.view<const CubeProbe>().each([&](Entity entity, const CubeProbe&) { old.push_back(entity); });
    for (const Entity entity : old) world.destroy(entity);
    probes(room.center, room.half, cells);
    bake(world);
    const LinearPicture picture = with("probes");
    const PerfectProbes perfect(room, cells);
    std::vector<dvec3> found, expected, truth;
    dvec3 floor(0.0), floor_truth(0.0), floor_expected(0.0);
    for (std::uint32_t y = 0; y < settings.height; y += 2)
      for (std::uint32_t x = 0; x < settings.width; x += 2) {
        const dvec3 normal = glm::normalize(dvec3(seen.texel(std::size_t{y} * settings.width + x).normal));
        const dvec3 p = seen.position(x, y) + seen.view.position;
        found.push_back((pixel(picture, x, y) - pixel(lamp, x, y)) / (pixel(even, x, y) - pixel(lamp, x, y)));
        expected.push_back(perfect.light(p, normal));
        truth.push_back(room.hemisphere(p, normal));
        if (normal.y < 0.99 || p.x > -1.0) continue;
        floor += found.back(), floor_expected += expected.back(), floor_truth += truth.back();
      }
    const double wrong = difference(found, expected), inherent = difference(expected, truth);
    std::printf("%d probes: %.4f from perfect ones, which are %.4f from the truth; floor %.3f %.3f %.3f of it\n",
                cells.x * cells.y * cells.z, wrong, inherent, floor.r / floor_truth.r, floor.g / floor_truth.g,
                floor.b / floor_truth.b);
    EXPECT_LT(wrong, 0.01);
    EXPECT_LT(inherent, before) << "more probes come nearer to the truth";
    before = inherent;
    EXPECT_GT(floor.r, 1.02 * floor.g) << "it is red";
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(floor[c] / floor_expected[c], 1.0, 0.01);
  }
}

TEST_F(DiffuseProbes, the_light_of_a_room_does_not_pass_its_wall) {
  std::array<vec3, 6> white;
  white.fill(vec3(0.7f));
  room({0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, white);
  room({4.2, 1.5, 0.0}, {2.0, 1.5, 3.0}, white);
  Light what;
  what.intensity = 20.0f;
  light(what, {4.2, 2.2, 0.0});
  // Boxes that end in the wall's middle, with the dark room in view.
  probe({4.2f, 3.2f, 6.2f}, {0.0, 1.5, 0.0});
  probe({4.2f, 3.2f, 6.2f}, {4.2, 1.5, 0.0});
  bake(world);
  const LinearPicture dark = with("probes");
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) ASSERT_LT(greatest(pixel(dark, x, y)), 1e-3) << x << " " << y;
}

TEST_F(DiffuseProbes, of_a_matt_room_do_not_depend_on_the_mode_of_reflections) {
  red_room();
  probe(vec3(4.0f, 3.0f, 6.0f), {0.0, 1.5, 0.0});
  bake(world);
  const LinearPicture on = with("probes");
  ASSERT_TRUE(renderer->knobs().set("reflections.mode", "off").ok());
  EXPECT_EQ(with("probes").rgba, on.rgba);
  EXPECT_NE(with("sky").rgba, on.rgba);
}

TEST_F(DiffuseProbes, where_nothing_shines_all_is_black) {
  room({0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, {});
  solid(matt(vec3(0.8f)), {0.0, 0.5, 0.0}, vec3(0.4f));
  probe({}, {0.0, 1.5, 0.0}, true);
  bake(world);
  const LinearPicture black = with("probes");
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) ASSERT_EQ(greatest(pixel(black, x, y)), 0.0);
}

TEST_F(DiffuseProbes, a_closed_room_has_no_light_of_the_sky_outside) {
  environment() = {.sky_zenith = vec3(10.0f), .sky_horizon = vec3(10.0f), .sky_ground = vec3(10.0f)};
  std::array<vec3, 6> white;
  white.fill(vec3(0.7f));
  room({0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, white);
  probe({}, {0.0, 1.5, 0.0}, true);
  bake(world);
  EXPECT_GT(greatest(pixel(with("sky"), 48, 32)), 1.0);
  const LinearPicture closed = with("probes");
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) ASSERT_LT(greatest(pixel(closed, x, y)), 1e-3);
}

TEST_F(DiffuseProbes, far_from_a_probe_without_a_box_the_sky_lights_as_without_it) {
  environment() = {.sky_zenith = vec3(0.2f, 0.3f, 0.5f), .sky_horizon = vec3(0.3f), .sky_ground = vec3(0.1f)};
  ground(matt(vec3(0.5f)), {0.0, 0.0, 0.0}, {200.0, 200.0});
  solid(matt(vec3(0.7f, 0.1f, 0.1f)), {0.0, 1.0, -1.2}, vec3(1.5f, 1.0f, 0.1f));
  light({.intensity = 60.0f}, {0.0, 1.5, -0.4});
  probe({}, {0.0, 1.0, 0.0}, true);
  bake(world);
  // 100 m away, out of the lamp's reach of view: a box in the open.
  solid(matt(vec3(0.7f)), {100.0, 1.0, 0.0}, vec3(1.0f));
  settings = look_at(dvec3(103.0, 2.5, 3.0), dvec3(100.0, 1.0, 0.0), 48, 32);
  const LinearPicture far = with("probes"), sky = with("sky");
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x)
      ASSERT_LT(greatest(glm::abs(pixel(far, x, y) / pixel(sky, x, y) - 1.0)), 0.02) << x << " " << y;
  settings = look_at(dvec3(0.0, 1.5, 1.5), dvec3(0.0, 0.5, -0.5), 48, 32);
  EXPECT_GT(pixel(with("probes"), 24, 28).r, 1.05 * pixel(with("sky"), 24, 28).r) << "near it the red wall's light";
}

TEST_F(DiffuseProbes, captures_show_the_light_of_probes_and_in_a_closed_room_no_sky) {
  red_room();
  const Entity one = probe(vec3(5.0f, 3.75f, 7.5f), {0.0, 1.5, 0.0});
  world.get<CubeProbe>(one).resolution = 16;
  const auto mean_of_captured = [&](const char* source, float outside) {
    EXPECT_TRUE(renderer->knobs().set("lighting.indirect", source).ok());
    sky(vec3(outside));
    bake(world);
    const auto& captures = world.resource<ReflectionCaptures>();
    EXPECT_EQ(captures.content, capture_content(world, renderer->knobs().value(kIndirectLight)));
    dvec3 sum(0.0);
    const std::size_t texels = std::size_t{captures.probes.side} * captures.probes.side;
    for (std::size_t i = 0; i < texels; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sum[static_cast<int>(c)] += static_cast<double>(half_to_float(captures.probes.texels[4 * i + c]));
    return sum / (static_cast<double>(captures.light_scale) * static_cast<double>(texels));
  };
  const dvec3 lamp = mean_of_captured("sky", 0.0f), dark = mean_of_captured("probes", 0.0f);
  const dvec3 bright = mean_of_captured("probes", 10.0f);
  EXPECT_GT(mean_of_captured("sky", 10.0f).r, 5.0) << "the room's walls in the light of the sky";
  EXPECT_LT(greatest(glm::abs(bright / dark - 1.0)), 0.01);
  EXPECT_GT(greatest(dark - lamp), 0.05 * lamp.r) << "the walls light each other";
  EXPECT_GT((dark - lamp).r, 1.1 * (dark - lamp).g) << "in red";
}

TEST_F(DiffuseProbes, a_lamp_that_dims_takes_its_bounced_light_along) {
  red_room();
  probe({}, {0.0, 1.5, 0.0}, true);
  bake(world);
  const LinearPicture before = with("probes");
  world.view<Light>().each([](Light& lamp) { lamp.intensity *= 0.25f; });
  const LinearPicture after = with("probes");
  for (std::uint32_t y = 0; y < settings.height; y += 4)
    for (std::uint32_t x = 0; x < settings.width; x += 4)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(pixel(after, x, y)[c], 0.25 * pixel(before, x, y)[c], 0.01 * pixel(before, x, y)[c] + 1e-4);
}

/// Terms that differ in every channel and direction.
ProbeDiffuse uneven(double seed) {
  ProbeDiffuse diffuse;
  for (std::size_t k = 0; k < kDiffuseTerms; ++k)
    for (int c = 0; c < 3; ++c)
      diffuse.unlit[k][c] =
          static_cast<float>((k == 0 ? 1.0 : 0.1) * (1.2 + std::sin(seed + 3.0 * static_cast<double>(k) + c)));
  return diffuse;
}

// The twin knows boxes without rotation only.
TEST_F(DiffuseProbes, each_pixel_has_the_value_of_its_probes_by_their_boxes) {
  environment() = {.sky_zenith = vec3(0.3f), .sky_horizon = vec3(0.2f), .sky_ground = vec3(0.1f)};
  settings = look_at(dvec3(3.0, 4.0, 9.0), dvec3(0.0, 0.5, 0.0), 96, 64);
  ground(matt(vec3(0.8f)), {0.0, 0.0, 0.0}, {9.0, 9.0});
  Material white = matt(vec3(0.8f));
  scene.draw(scene.mesh(round_ball(1.0f, 48, 24, scene.material(white))), at(0.0, 1.5, 0.0));
  const dvec3 centers[] = {{-1.5, 1.0, 0.0}, {2.0, 1.0, 0.5}};
  const dvec3 halves[] = {{2.0, 2.0, 3.0}, {3.0, 2.5, 3.5}};
  for (int i = 0; i < 2; ++i) probe(vec3(2.0 * halves[i]), centers[i]);
  capture(world, {}, {vec4(0.0f), vec4(0.0f)});
  auto& captures = world.resource<ReflectionCaptures>();
  captures.probe_diffuse = {uneven(0.0), uneven(1.0)};
  const LinearPicture picture = with("probes");
  const GeometryPicture seen = geometry();
  double worst = 0.0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const std::size_t i = std::size_t{y} * settings.width + x;
      if (seen.is_sky(i)) continue;
      const dvec3 normal = glm::normalize(dvec3(seen.texel(i).normal)), p = seen.position(x, y) + seen.view.position;
      dvec3 light(0.0);
      double covered = 0.0;
      for (int box = 0; box < 2; ++box) {
        const double part = box_share(centers[box], halves[box], p, normal) * (1.0 - covered);
        std::array<dvec3, kDiffuseTerms> terms;
        for (std::size_t k = 0; k < kDiffuseTerms; ++k)
          terms[k] = dvec3(captures.probe_diffuse[static_cast<std::size_t>(box)].unlit[k]);
        light += part * diffuse_value(terms, normal);
        covered += part;
      }
      light += (1.0 - covered) * (0.1 + (0.25 - 0.1) * (0.5 + 0.5 * normal.y));
      // Specular: at most 4 % of the same at normal incidence, more at grazing angles. Only its bounds are known here.
      const dvec3 found = pixel(picture, x, y), diffuse = 0.8 * light;
      for (int c = 0; c < 3; ++c) {
        ASSERT_GT(found[c], 0.985 * diffuse[c]) << x << " " << y;
        ASSERT_LT(found[c], diffuse[c] + 0.12 * (light[c] + 0.3)) << x << " " << y;
      }
      worst = std::max(worst, greatest(glm::abs(found - diffuse)));
    }
  EXPECT_GT(worst, 0.0);
}

TEST_F(DiffuseProbes, light_of_the_sky_alone_makes_the_same_picture_as_without_probes) {
  environment() = {.sky_zenith = vec3(0.3f), .sky_horizon = vec3(0.2f), .sky_ground = vec3(0.1f)};
  ground(matt(vec3(0.8f)), {0.0, 0.0, 0.0}, {9.0, 9.0});
  const LinearPicture without = with("probes");
  EXPECT_EQ(with("sky").rgba, without.rgba) << "no probe";
}

}  // namespace
}  // namespace gloam::test
