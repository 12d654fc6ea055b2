// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Diffuse light of probes against one traced bounce, and against the probes' terms at each pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "modules/reflections/diffuse/harmonics.h"
#include "modules/reflections/reference/indirect_tracing.h"
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
  [[nodiscard]] LinearPicture one_bounce(std::uint32_t rays) {
    draw();
    const GeometryPicture seen = geometry();
    const auto tracer = value_of(make_scene_tracer(world, *executor, seen.view.position));
    world.set_resource(trace_indirect(
        {.world = world, .geometry = seen, .tracer = *tracer, .executor = *executor, .settings = {.rays = rays}}));
    LinearPicture picture = shot();
    world.remove_resource<TracedIndirect>();
    return picture;
  }
  /// Mean of the pixels whose surface has this normal and lies in a box.
  [[nodiscard]] dvec3 mean(const LinearPicture& picture, const dvec3& normal, const dvec3& least, const dvec3& most) {
    const GeometryPicture seen = geometry();
    dvec3 sum(0.0);
    int count = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const std::size_t i = std::size_t{y} * settings.width + x;
        if (seen.is_sky(i) || glm::dot(dvec3(seen.texel(i).normal), normal) < 0.99) continue;
        const dvec3 position = seen.position(x, y) + seen.view.position;
        if (!glm::all(glm::greaterThan(position, least)) || !glm::all(glm::lessThan(position, most))) continue;
        sum += pixel(picture, x, y);
        ++count;
      }
    EXPECT_GT(count, 20);
    return sum / static_cast<double>(std::max(count, 1));
  }
  [[nodiscard]] double error(const LinearPicture& picture, const LinearPicture& truth) const {
    double sum = 0.0, all = 0.0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        sum += glm::length(pixel(picture, x, y) - pixel(truth, x, y));
        all += glm::length(pixel(truth, x, y));
      }
    return sum / all;
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
        for (int x = 0; x < cells.x; ++x) probe(vec3(1.25 * size), center - half + (dvec3(x, y, z) + 0.5) * size);
  }
};

TEST_F(DiffuseProbes, a_white_floor_beside_a_red_wall_turns_as_red_as_in_traced_light) {
  red_room();
  const LinearPicture traced = one_bounce(256), sky = with("sky");
  const double of_sky = error(sky, traced);
  const dvec3 up(0, 1, 0), least(-1.9, -0.1, -2.9), most(-1.0, 0.1, 2.9);
  const dvec3 lamp = mean(sky, up, least, most), expected = mean(traced, up, least, most) - lamp;
  double before = of_sky;
  // Without the lamp's own light. One probe stands for the whole room: what is near a wall has the light of the middle.
  // Within a probe's cell the light of the middle stays, so that more probes come nearer to traced light.
  const struct {
    glm::ivec3 cells;
    double bar;    // of the mean error, as a share of the light
    double wrong;  // of the floor's red light, as a share
  } kCases[] = {{{1, 1, 1}, 0.3, 2.0}, {{4, 3, 6}, 0.07, 0.12}};
  for (const auto& one : kCases) {
    std::vector<Entity> old;
    world.view<const CubeProbe>().each([&](Entity entity, const CubeProbe&) { old.push_back(entity); });
    for (const Entity entity : old) world.destroy(entity);
    probes({0.0, 1.5, 0.0}, {2.0, 1.5, 3.0}, one.cells);
    bake(world);
    const LinearPicture picture = with("probes");
    const double found_error = error(picture, traced);
    const dvec3 found = mean(picture, up, least, most) - lamp;
    std::printf(
        "%d probes: error %.3f, with the sky %.3f; floor beside the red wall %.4f %.4f %.4f, traced %.4f %.4f %.4f\n",
        one.cells.x * one.cells.y * one.cells.z, found_error, of_sky, found.r, found.g, found.b, expected.r, expected.g,
        expected.b);
    EXPECT_LT(found_error, one.bar);
    EXPECT_LT(found_error, before);
    before = found_error;
    EXPECT_GT(found.r, 1.02 * found.g) << "it is red";
    EXPECT_NEAR(found.r / expected.r, 1.0, one.wrong);
    EXPECT_NEAR(found.g / expected.g, 1.0, one.wrong + 0.5 * one.wrong);
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
      const auto share = [&](int box, const dvec3& point) {
        const dvec3 inside = (1.0 - glm::abs((point - centers[box]) / halves[box])) / 0.2;
        return std::clamp(std::min({inside.x, inside.y, inside.z}), 0.0, 1.0);
      };
      dvec3 light(0.0);
      double covered = 0.0;
      for (int box = 0; box < 2; ++box) {
        const dvec3 out = normal / halves[box], size = glm::abs(out);
        const dvec3 further = p + normal * (0.2 / std::max({size.x, size.y, size.z}));
        const double part = std::min(share(box, p), share(box, further)) * (1.0 - covered);
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
