// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/modules/grass/support/stems.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

/// The module's visualizers, picks and counters.
class GrassViews : public GrassTest {
 protected:
  /// A view along a strip of grass, with all draw classes.
  static void strip(GrassStage& stage) {
    GrassSurface values;
    values.width_m = 0.02f;
    for (int i = 0; i < 6; ++i) stage.lawn(0.6f, 120, dvec3(0.0, 0.0, -1.2 * (1 << i)), values);
  }
  [[nodiscard]] static ViewSettings along() { return look_at({0.0, 0.3, -0.5}, {0.0, 0.1, -3.0}, 96, 64); }
  /// Blades whose stem is near the point.
  [[nodiscard]] static std::vector<Stem> near(const std::vector<Stem>& stems, const dvec3& point, double slack_m) {
    std::vector<Stem> found;
    for (const Stem& stem : stems)
      if (stem.distance_to(point) < 0.5 * stem.width_m + slack_m) found.push_back(stem);
    return found;
  }
};

TEST_F(GrassViews, grass_lod_shows_the_class_of_each_blade) {
  GrassStage stage;
  strip(stage);
  ViewSettings view = along();  // large enough for 15 segments
  view.width = 288;
  view.height = 192;
  const GrassPicture picture = grass_picture(stage, view);
  const GrassCopy copy = stage.copy();
  const std::vector<Stem> stems = stems_of(stage.field(), copy, picture.with.view.position);
  const std::vector<vec4> values = stage.shown(view, "grass_lod");
  ASSERT_EQ(values.size(), picture.with.depth.size());
  std::size_t of_class[5] = {}, wrong = 0;
  double nearest[5] = {1e9, 1e9, 1e9, 1e9, 1e9}, farthest[5] = {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double shown = static_cast<double>(values[i].x);
    if (!picture.is_grass(i)) {
      EXPECT_EQ(shown, 0.0) << "pixel " << i << " shows no blade";
      continue;
    }
    const auto detail = static_cast<std::size_t>(shown);
    ASSERT_TRUE(shown == static_cast<double>(detail) && detail >= 1 && detail <= 4) << shown;
    ++of_class[detail];
    const dvec3 point = picture.world(i);
    const double distance_m = glm::length(point - picture.with.view.position);
    nearest[detail] = std::min(nearest[detail], distance_m);
    farthest[detail] = std::max(farthest[detail], distance_m);
    bool right = false;
    for (const Stem& stem : near(stems, point, 0.01 + distance_m * static_cast<double>(copy.lod.pixel_m))) {
      const double key = stem.distance_m / static_cast<double>(copy.lod.range_m) * 255.0;
      for (const double shift : {-0.1, 0.1}) {
        std::size_t wanted = 1;
        while (wanted < 4 && std::floor(key + shift) > copy.lod.class_keys[static_cast<int>(wanted) - 1]) ++wanted;
        right = right || wanted == detail;
      }
    }
    wrong += right ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0u);
  for (std::size_t detail = 1; detail <= 3; ++detail) {
    EXPECT_GT(of_class[detail], 5u) << "class " << detail;
    EXPECT_GT(of_class[detail + 1], 5u) << "class " << detail + 1;
    EXPECT_GT(nearest[detail + 1], farthest[detail] - 0.8) << "near blades have more segments";
  }
}

TEST_F(GrassViews, full_segments_show_one_class) {
  GrassStage stage;
  strip(stage);
  stage.set("grass.segments", "full");
  for (const vec4& value : stage.shown(along(), "grass_lod")) EXPECT_LE(value.x, 1.0f);
}

TEST_F(GrassViews, grass_lod_of_a_scene_without_grass_is_the_picture) {
  GrassStage stage;
  stage.scene.draw(stage.scene.mesh(quad(0.6f)), GrassStage::lying(dvec3(0.0)));
  stage.draw(front());
  const std::vector<std::uint8_t> plain = value_of(stage.renderer->read_picture(ViewId{0})).rgba;
  ViewSettings view = front();
  view.visualizer = "grass_lod";
  stage.draw(view);
  EXPECT_EQ(value_of(stage.renderer->read_picture(ViewId{0})).rgba, plain);
}

TEST_F(GrassViews, a_picked_pixel_names_its_blade_and_master) {
  GrassStage stage;
  GrassSurface values;
  values.width_m = 0.03f;
  stage.lawn(0.6f, 60, dvec3(0.0), values);
  stage.set("grass.lod_pixels", "0");
  stage.set("grass.segments", "full");
  const GrassPicture picture = grass_picture(stage, front());
  const std::vector<Stem> stems = stems_of(stage.field(), stage.copy(), picture.with.view.position);
  int shown = 0, beside = 0;
  std::vector<std::size_t> pixels;
  for (const bool grass : {true, false}) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < picture.with.depth.size(); ++i)
      if (picture.is_grass(i) == grass) all.push_back(i);
    const auto count = static_cast<std::size_t>(scaled(30));
    for (std::size_t n = 0; n < count; ++n) pixels.push_back(all[(2 * n + 1) * all.size() / (2 * count)]);
  }
  for (const std::size_t i : pixels) {
    const auto x = static_cast<std::uint32_t>(i % 96), y = static_cast<std::uint32_t>(i / 96);
    std::vector<std::string> lines = value_of(stage.renderer->pick(stage.world, ViewId{0}, x, y));
    std::erase_if(lines, [](const std::string& line) { return line.rfind("grass:", 0) != 0; });
    const dvec3 point = picture.with.is_sky(i) ? dvec3(1e9) : picture.world(i);
    if (!picture.is_grass(i)) {
      if (!near(stems, point, 0.05).empty()) continue;  // ground beside a root
      ++beside;
      EXPECT_THAT(lines, testing::IsEmpty()) << x << ", " << y;
      continue;
    }
    ++shown;
    ASSERT_EQ(lines.size(), 2u) << x << ", " << y;
    unsigned slot = 0, patch = 0, master = 0;
    ASSERT_EQ(std::sscanf(lines[0].c_str(), "grass: blade %u (patch %u)", &slot, &patch), 2) << lines[0];
    EXPECT_EQ(patch, slot / GLOAM_GRASS_PATCH_BLADES);
    const std::vector<Stem> possible = near(stems, point, 0.004);
    EXPECT_TRUE(std::ranges::any_of(possible, [&](const Stem& stem) { return stem.slot == slot; })) << lines[0];
    const GrassBlade& blade = stage.field().blades[slot];
    if (blade.master == slot) {
      EXPECT_THAT(lines[1], testing::HasSubstr("a master"));
    } else {
      ASSERT_EQ(std::sscanf(lines[1].c_str(), "grass: copies master %u", &master), 1) << lines[1];
      EXPECT_EQ(master, blade.master);
    }
  }
  EXPECT_GT(shown, 1);
  EXPECT_GT(beside, 1);
}

}  // namespace
}  // namespace gloam::test
