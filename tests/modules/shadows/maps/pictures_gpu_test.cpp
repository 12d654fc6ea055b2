// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "modules/shadows/filter/cookies.h"
#include "tests/modules/shadows/support/shadowed_scene.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

class ShadowPictures : public test::ShadowedScene {
 protected:
  /// The point of the wall under a pixel; none when a box is in front of it.
  [[nodiscard]] std::optional<dvec3> wall_point(std::uint32_t x, std::uint32_t y) const {
    const Ray r = ray(x, y);
    const dvec3 point = r.origin - r.direction * (r.origin.z / r.direction.z);
    if (std::max(std::abs(point.x), std::abs(point.y)) > 3.9 || blocked(point, r.origin)) return std::nullopt;
    return point;
  }
  /// 1: lit, 0: in shadow, none: too close to a shadow's edge.
  [[nodiscard]] std::optional<float> true_visibility(const dvec3& point, const dvec3& to_light) const {
    const bool middle = blocked(point, to_light);
    for (const dvec3 offset :
         {dvec3(0.03, 0.0, 0.0), dvec3(-0.03, 0.0, 0.0), dvec3(0.0, 0.03, 0.0), dvec3(0.0, -0.03, 0.0)})
      if (blocked(point + offset, to_light) != middle) return std::nullopt;
    return middle ? 0.0f : 1.0f;
  }
  /// Compares visualizer "shadow" with geometry. position: of the light, or a point in the direction that a directional
  /// light comes from.
  void expect_true_shadows(const std::string& name, const dvec3& position) {
    const std::vector<float> seen = visibility(name);
    ASSERT_EQ(seen.size(), std::size_t{settings.width} * settings.height);
    int lit = 0, dark = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const auto point = wall_point(x, y);
        const float at = seen[y * settings.width + x];
        if (!point || at < 0.0f) continue;
        const auto truth = true_visibility(*point, position);
        if (!truth) continue;
        EXPECT_NEAR(at, *truth, 1e-3f) << name << " at " << x << "," << y;
        (*truth > 0.5f ? lit : dark) += 1;
      }
    EXPECT_GT(lit, 300) << name;
    EXPECT_GT(dark, 20) << name;
  }
};

TEST_F(ShadowPictures, boxes_cast_their_shadows_where_geometry_says) {
  box(dvec3(0.1, 0.0, 0.6), dvec3(0.25, 0.2, 0.1));
  box(dvec3(-0.7, 0.3, 0.4), dvec3(0.1, 0.15, 0.2));
  lamp("point", LightKind::point, dvec3(0.3, 0.5, 2.2));
  lamp("spot", LightKind::spot, dvec3(-0.6, -0.4, 2.6), dvec3(0.15, 0.1, -1.0));
  lamp("sun", LightKind::directional, dvec3(0.0), dvec3(-0.4, -0.3, -1.0));
  for (const char* filter : {"hard", "pcf", "pcss", "chs"}) {
    set("shadows.filter", filter);
    expect_true_shadows("point", dvec3(0.3, 0.5, 2.2));
    expect_true_shadows("spot", dvec3(-0.6, -0.4, 2.6));
    expect_true_shadows("sun", dvec3(0.4, 0.3, 1.0) * 1000.0);
  }
}

TEST_F(ShadowPictures, holds_depth_in_16_bits_as_well) {
  box(dvec3(0.1, 0.0, 0.6), dvec3(0.25, 0.2, 0.1));
  lamp("point", LightKind::point, dvec3(0.3, 0.5, 1.6));
  set("shadows.depth", "d16");
  expect_true_shadows("point", dvec3(0.3, 0.5, 1.6));
}

TEST_F(ShadowPictures, what_is_lit_gets_the_light_it_gets_without_shadows_and_what_is_dark_none) {
  box(dvec3(0.1, 0.0, 0.6), dvec3(0.25, 0.2, 0.1));
  const dvec3 position(0.3, 0.5, 2.2);
  lamp("point", LightKind::point, position);
  const LinearPicture with = drawn(), without = drawn("shadows.mode", "off");
  int dark = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const auto point = wall_point(x, y);
      const auto truth = point ? true_visibility(*point, position) : std::nullopt;
      if (!truth) continue;
      EXPECT_EQ(pixel(with, x, y), *truth > 0.5f ? pixel(without, x, y) : dvec3(0.0)) << x << "," << y;
      dark += *truth < 0.5f ? 1 : 0;
    }
  EXPECT_GT(dark, 20);
}

TEST_F(ShadowPictures, tiles_and_all_lights_give_the_same_shadows) {
  box(dvec3(0.1, 0.0, 0.6), dvec3(0.25, 0.2, 0.1));
  Material glass = exact_material(60, 180, 120, 100, 0);
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.4f;
  scene.draw(scene.mesh(test::quad(0.4f, scene.material(glass))), glm::translate(dmat4(1.0), dvec3(0.4, 0.0, 0.3)));
  for (int i = 0; i < 12; ++i) {
    Light made;
    made.kind = i % 3 == 0 ? LightKind::spot : LightKind::point;
    made.width_m = 0.05f * static_cast<float>(i % 4);
    made.range_m = 1.5f;
    light(made, dvec3(0.3 * i - 1.8, 0.4 * std::sin(1.7 * i), 1.0 + 0.05 * i));
  }
  lamp("sun", LightKind::directional, dvec3(0.0), dvec3(-0.4, -0.3, -1.0));
  set("shadows.visibility_bits", "8");
  const LinearPicture tiled = drawn("lights.culling", "tiled"), brute = drawn("lights.culling", "brute");
  EXPECT_EQ(tiled.rgba, brute.rgba);
  EXPECT_NE(brute.rgba, drawn("shadows.mode", "off").rgba);
}

TEST_F(ShadowPictures, glass_is_in_shadow_at_its_own_depth) {
  // The box's shadow falls on the pane, not on the wall behind it, which no light reaches.
  Material glass = exact_material(200, 200, 200, 255, 0);
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.5f;
  scene.draw(scene.mesh(test::quad(0.6f, scene.material(glass))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 1.0)));
  box(dvec3(0.0, 0.45, 1.3), dvec3(0.2, 0.05, 0.05));
  Light made;
  made.range_m = 1.0f;
  made.intensity = 5.0f;
  const dvec3 position(0.0, 0.7, 1.6);
  world.add(light(made, position), ShadowCaster{true, 1024});
  const LinearPicture with = drawn(), without = drawn("shadows.mode", "off");
  int dark = 0, lit = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const Ray r = ray(x, y);
      const dvec3 point = r.origin + r.direction * ((1.0 - r.origin.z) / r.direction.z);
      if (std::max(std::abs(point.x), std::abs(point.y)) > 0.57 || blocked(point, r.origin)) continue;
      const auto truth = true_visibility(point, position);
      if (!truth || glm::distance(point, position) > 0.95) continue;
      if (*truth > 0.5f) {
        EXPECT_EQ(pixel(with, x, y), pixel(without, x, y));
        ++lit;
      } else {
        EXPECT_EQ(pixel(with, x, y), dvec3(0.0)) << x << "," << y;
        ++dark;
      }
    }
  EXPECT_GT(dark, 10);
  EXPECT_GT(lit, 50);
}

TEST_F(ShadowPictures, cut_outs_cast_the_shadow_of_what_is_there) {
  Material grid = exact_material(200, 200, 200, 255, 0);
  grid.alpha_mode = AlphaMode::mask;
  // Left half solid, right half open.
  grid.base_color_texture.texture = scene.texture(2, 1, {255, 255, 255, 255, 255, 255, 255, 0}, true);
  scene.draw(scene.mesh(test::quad(0.5f, scene.material(grid))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 1.0)));
  lamp("lamp", LightKind::point, dvec3(0.0, 0.0, 2.0));
  settings = test::look_at(dvec3(0.0, 3.0, 2.0), dvec3(0.0), 95, 63);
  set("shadows.filter", "hard");
  const std::vector<float> seen = visibility("lamp");
  int open = 0, closed = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const Ray r = ray(x, y);
      const dvec3 point = r.origin - r.direction * (r.origin.z / r.direction.z);
      const dvec3 sheet = r.origin + r.direction * ((1.0 - r.origin.z) / r.direction.z);
      if (std::max(std::abs(sheet.x), std::abs(sheet.y)) < 0.55) continue;
      if (std::abs(point.y) > 0.9 || std::abs(point.x) > 0.9 || std::abs(point.x) < 0.1) continue;
      const float at = seen[y * settings.width + x];
      EXPECT_EQ(at, point.x < 0.0 ? 0.0f : 1.0f) << x << "," << y;
      (point.x < 0.0 ? closed : open) += 1;
    }
  EXPECT_GT(open, 30);
  EXPECT_GT(closed, 30);
}

/// The wall under a spot with a cookie: red, green, blue and white quarters, from the upper left.
class CookiePictures : public ShadowPictures {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowPictures::SetUp());
    if (IsSkipped()) return;
    Image image{"quarters", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
    Cookies cookies;
    spot = lamp("spot", LightKind::spot, dvec3(0.0, 0.0, 1.5));
    world.get<Light>(spot).cookie = world.resource<SceneStrings>().intern("quarters.png");
    cookies.layers[world.get<Light>(spot).cookie] = 0;
    cookies.texels.push_back(resampled_cookie(image));
    cookies.version = 1;
    world.set_resource(std::move(cookies));
    settings = test::look_at(dvec3(0.0, 0.0, 3.0), dvec3(0.0), 95, 63);
  }
  /// Compares colours in the quarters with the picture without a cookie.
  void expect_quarters(const LinearPicture& with, const LinearPicture& without) {
    const dvec3 colors[] = {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1)};
    int looked = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const auto point = wall_point(x, y);
        if (!point || std::abs(point->x) < 0.66 || std::abs(point->y) < 0.66) continue;
        if (glm::length(*point) > 1.2) continue;  // the cone's square is 1.26 m to each side
        const dvec3 color = colors[(point->x > 0.0 ? 1 : 0) + (point->y > 0.0 ? 0 : 2)];
        const dvec3 expected = color * pixel(without, x, y);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(with, x, y)[c], expected[c], 1e-3 * glm::length(expected));
        ++looked;
      }
    EXPECT_GT(looked, 60);
  }
  Entity spot;
};

TEST_F(CookiePictures, a_spot_projects_its_cookie_upright_with_and_without_shadows) {
  const LinearPicture with = drawn(), off = drawn("shadows.mode", "off");
  EXPECT_EQ(with.rgba, off.rgba);  // nothing blocks the light
  world.get<Light>(spot).cookie = 0;
  const LinearPicture plain = drawn();
  expect_quarters(with, plain);
  EXPECT_EQ(plain.rgba, drawn("shadows.mode", "monolithic").rgba);
}

// Up to four cookies are read once per surface, more of them once per light: the picture must be the same.
TEST_F(CookiePictures, any_number_of_lights_project_with_and_without_shadows_and_out_of_view) {
  const LinearPicture one = drawn();
  const std::uint32_t cookie = world.get<Light>(spot).cookie;
  std::vector<Entity> behind;
  for (int i = 0; i < 5; ++i) {
    behind.push_back(
        lamp("behind " + std::to_string(i), LightKind::spot, dvec3(0.0, 0.0, 40.0 + i), dvec3(0.0, 0.0, 1.0)));
    world.get<Light>(behind.back()).cookie = cookie;
    EXPECT_EQ(drawn().rgba, one.rgba) << i << " lights that reach nothing in view";
    EXPECT_EQ(drawn("shadows.mode", "off").rgba, one.rgba) << i;
    set("shadows.mode", "monolithic");
  }
  // Six lights with a sixth of its brightness each, with the same position and direction.
  for (const Entity entity : behind) world.get<WorldTransform>(entity) = world.get<WorldTransform>(spot);
  for (const Entity entity : behind) world.get<Light>(entity).intensity = world.get<Light>(spot).intensity / 6.0f;
  world.get<Light>(spot).intensity /= 6.0f;
  for (const char* mode : {"monolithic", "off"}) {
    const LinearPicture six = drawn("shadows.mode", mode);
    ASSERT_EQ(six.rgba.size(), one.rgba.size());
    for (std::size_t i = 0; i < one.rgba.size(); ++i)
      ASSERT_NEAR(six.rgba[i], one.rgba[i], 2e-3f * (1.0f + one.rgba[i])) << mode << " component " << i;
  }
}

TEST_F(CookiePictures, a_file_that_cannot_be_read_is_told_and_white) {
  const LinearPicture with = drawn();
  world.get<Light>(spot).cookie = world.resource<SceneStrings>().intern("absent.png");
  const LinearPicture white = drawn();
  world.get<Light>(spot).cookie = 0;
  EXPECT_EQ(white.rgba, drawn().rgba);
  EXPECT_NE(white.rgba, with.rgba);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("absent.png"));
}

}  // namespace
}  // namespace gloam
