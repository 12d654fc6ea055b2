// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/pick.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A wall 5 m away that fills the left half of a picture of 130×70 pixels. One lamp is just in front of it, one beside
/// it in the air.
class LightPickTest : public test::LitSceneTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    environment().has_exposure = true;
    scene.draw(scene.mesh(test::quad(3.0f)), glm::translate(dmat4(1.0), dvec3(-3.0, 0.0, -5.0)));
    Light lamp;
    lamp.range_m = 1.5f;
    world.resource<SceneNames>().add("light", "lamp", light(lamp, dvec3(-2.5, 0.5, -4.5)));
    world.resource<SceneNames>().add("light", "high", light(lamp, dvec3(-2.5, 0.5, -2.0)));
    Light sun;
    sun.kind = LightKind::directional;
    world.resource<SceneNames>().add("light", "sun", light(sun, dvec3(0.0)));
    settings = test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 130, 70);
  }
  [[nodiscard]] std::vector<std::string> pick(std::uint32_t x, std::uint32_t y) {
    draw();
    return test::value_of(renderer->pick(world, ViewId{0}, x, y));
  }
  /// The pixel that shows a point of the wall.
  [[nodiscard]] uvec2 pixel_of(const dvec3& point) const {
    const double half = std::tan(0.5 * static_cast<double>(settings.camera.fov_y));
    const double scale = 0.5 * settings.height / (half * -point.z);
    return uvec2(static_cast<std::uint32_t>(0.5 * settings.width + point.x * scale),
                 static_cast<std::uint32_t>(0.5 * settings.height - point.y * scale));
  }
};

TEST_F(LightPickTest, tells_the_tiles_bins_and_lists_of_a_pixel) {
  const uvec2 p = pixel_of(dvec3(-2.5, 0.5, -5.0));
  const std::vector<std::string> lines = pick(p.x, p.y);
  const auto text = [](std::uint32_t x, std::uint32_t y) { return std::to_string(x) + "," + std::to_string(y); };
  EXPECT_THAT(lines, Contains("shadow tile " + text(p.x / 8, p.y / 8) + " of tile group " + text(p.x / 64, p.y / 64) +
                              ", mask tile " + text(p.x / 32, p.y / 32)));
  EXPECT_THAT(lines, Contains("view depths of the tile 5.0000 to 5.0000 m"));
  EXPECT_THAT(lines, Contains(HasSubstr("of the pixel: standard [")));
  EXPECT_THAT(lines, Contains(HasSubstr("of the tile: standard [")));
  EXPECT_THAT(lines, Contains("mask tile: 2 lights: 0 high, 1 lamp"));
  EXPECT_THAT(lines, Contains("candidates (mask and zBins): 1 light: 1 lamp"));
  EXPECT_THAT(lines, Contains("approximate search, tile group: 1 light: 1 lamp"));
  EXPECT_THAT(lines, Contains("approximate search, tile: 1"));
  EXPECT_THAT(lines, Contains("accurate search: 1 light: 1 lamp"));
  EXPECT_THAT(lines, Contains(StartsWith("slot ")));
  EXPECT_THAT(lines, Contains("local lights in range of the pixel: 1 light: 1 lamp"));
  EXPECT_THAT(lines, Contains("directional lights: sun"));
}

/// The lamp is half a metre in front of the wall at (−2.5, 0.5); the sun shines onto the wall with 1 lx.
TEST_F(LightPickTest, tells_what_each_light_adds) {
  const uvec2 p = pixel_of(dvec3(-2.2, 0.5, -5.0));
  const std::vector<std::string> lines = pick(p.x, p.y);
  const auto position = test::value_of(renderer->pick_position(world, ViewId{0}, p.x, p.y));
  ASSERT_TRUE(position);
  EXPECT_NEAR(position->z, -5.0, 1e-3);
  EXPECT_NEAR(position->x, -2.2, 0.12) << "pixels are 0.1 m wide";
  // One candela per colour channel at the distance d, the cosine 0.5 / d, and the window of a range of 1.5 m.
  const double d = glm::distance(*position, dvec3(-2.5, 0.5, -4.5));
  const double window = 1.0 - std::pow(d / 1.5, 4.0);
  const double lux = 1.0 + window * 0.5 / (d * d * d);
  const auto line = std::find_if(lines.begin(), lines.end(),
                                 [](const std::string& l) { return l.starts_with("illuminance before shadows "); });
  ASSERT_NE(line, lines.end());
  EXPECT_NEAR(std::stod(line->substr(27)), lux, 0.01 * lux) << *line;
  EXPECT_THAT(*line, HasSubstr(": lamp "));
  EXPECT_THAT(*line, HasSubstr(", sun 1 lx ("));
  EXPECT_FALSE(test::value_of(renderer->pick_position(world, ViewId{0}, 129, 1))) << "the sky has no position";
  EXPECT_FALSE(renderer->pick_position(world, ViewId{0}, 130, 1).ok());
}

TEST_F(LightPickTest, tells_of_a_tile_without_lights) {
  const uvec2 p = pixel_of(dvec3(-0.6, -1.8, -5.0));
  const std::vector<std::string> lines = pick(p.x, p.y);
  EXPECT_THAT(lines, Contains("accurate search: 0 lights"));
  EXPECT_THAT(lines, Contains("local lights in range of the pixel: 0 lights"));
}

TEST_F(LightPickTest, tells_of_sky) {
  const std::vector<std::string> lines = pick(129, 1);
  EXPECT_THAT(lines, Contains("sky"));
  EXPECT_THAT(lines, Contains("the tile shows only sky"));
  EXPECT_THAT(lines, Contains(StartsWith("mask tile: ")));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("accurate search"))));
}

TEST_F(LightPickTest, names_the_fallback_of_a_tile_whose_list_found_no_room) {
  Light more;
  more.range_m = 1.5f;
  for (int i = 0; i < 8; ++i) light(more, dvec3(-2.5, 0.5, -4.5));
  ASSERT_TRUE(renderer->knobs().set("lights.fixed_slots", "3").ok());
  const uvec2 p = pixel_of(dvec3(-2.5, 0.5, -5.0));
  EXPECT_THAT(pick(p.x, p.y), Contains("accurate search: 9 lights; no slot was left: the tile uses its group's mask"));
}

TEST_F(LightPickTest, without_lists_says_so) {
  const uvec2 p = pixel_of(dvec3(-2.5, 0.5, -5.0));
  ASSERT_TRUE(renderer->knobs().set("lights.culling", "brute").ok());
  const std::vector<std::string> lines = pick(p.x, p.y);
  EXPECT_THAT(lines, Contains("no light lists: every pixel evaluates all 2 local lights"));
  EXPECT_THAT(lines, Contains("local lights in range of the pixel: 1 light: 1 lamp"));
}

}  // namespace
}  // namespace gloam
