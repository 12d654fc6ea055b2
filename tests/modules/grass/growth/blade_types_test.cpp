// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/blade_types.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

std::string fault_of(std::string_view text) {
  const auto types = parse_blade_types(text, "lawn.blades");
  if (types) return "(no fault)";
  EXPECT_EQ(types.error().kind, ErrorKind::input);
  EXPECT_EQ(types.error().message.find('\n'), std::string::npos);
  return types.error().message;
}

BladeType stem_of(std::vector<vec2> points) {
  BladeType type;
  type.points = std::move(points);
  return type;
}

void expect_good_stem(const shaders::GrassTypeRow& row, const std::string& name) {
  EXPECT_EQ(row.stem[0], vec2(0.0f)) << name;
  for (std::size_t i = 0; i < GLOAM_GRASS_KNOTS; ++i) {
    EXPECT_TRUE(std::isfinite(row.stem[i].x)) << name << " " << i;
    EXPECT_GE(row.stem[i].y, 0.0f) << name << " " << i;
    if (i == 0) continue;
    EXPECT_NEAR(glm::length(row.stem[i] - row.stem[i - 1]), 1.0f / 15.0f, 2e-6f) << name << " " << i;
  }
}

TEST(BladeTypes, there_are_five_built_in_types_with_unequal_shares_and_different_stems) {
  const std::vector<BladeType> types = builtin_blade_types();
  ASSERT_EQ(types.size(), 5u);
  for (std::size_t i = 0; i < types.size(); ++i) {
    const shaders::GrassTypeRow row = blade_type_row(types[i]);
    expect_good_stem(row, types[i].name);
    EXPECT_EQ(row.stiffness, types[i].stiffness);
    EXPECT_EQ(row.taper, types[i].taper);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(types[i].share, types[j].share);
      EXPECT_GT(glm::length(row.stem[15] - blade_type_row(types[j]).stem[15]), 0.05f);
    }
  }
}

TEST(BladeTypes, a_straight_stem_has_equidistant_knots_whatever_its_size) {
  for (const float size : {0.001f, 1.0f, 100.0f}) {
    const shaders::GrassTypeRow row = blade_type_row(stem_of({{0, 0}, {0, 0.25f * size}, {0, size}}));
    for (std::size_t i = 0; i < GLOAM_GRASS_KNOTS; ++i) {
      EXPECT_NEAR(row.stem[i].y, static_cast<float>(i) / 15.0f, 1e-6f);
      EXPECT_EQ(row.stem[i].x, 0.0f);
    }
  }
}

TEST(BladeTypes, stems_that_turn_back_curl_or_touch_the_ground_stay_equidistant_and_above_it) {
  expect_good_stem(blade_type_row(stem_of({{0, 0}, {0, 1}})), "line");
  expect_good_stem(blade_type_row(stem_of({{0, 0}, {1, 0}})), "lying");
  expect_good_stem(blade_type_row(stem_of({{0, 0}, {0, 1}, {0, 1}, {0, 0.1f}})), "turning back");
  expect_good_stem(blade_type_row(stem_of({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0.2f, 0}, {0.2f, 0.7f}})), "curl");
  expect_good_stem(blade_type_row(stem_of({{0, 0}, {0, 0}, {0, 0}, {0, 0.001f}})), "tiny");
}

TEST(BladeTypes, stems_have_any_number_of_equidistant_knots_and_a_length_of_1) {
  for (const BladeType& type : builtin_blade_types())
    for (const std::size_t count : {2u, 8u, 16u, 24u, 512u}) {
      const std::vector<glm::dvec2> knots = stem_knots(type, count);
      ASSERT_EQ(knots.size(), count);
      EXPECT_EQ(knots.front(), glm::dvec2(0.0));
      for (std::size_t i = 1; i < count; ++i)
        ASSERT_NEAR(glm::length(knots[i] - knots[i - 1]), 1.0 / static_cast<double>(count - 1), 1e-6) << type.name;
    }
}

TEST(BladeTypes, a_point_given_twice_is_a_kink) {
  const auto sharpest = [](const shaders::GrassTypeRow& row) {
    float least = 1.0f;
    for (std::size_t i = 1; i < 15; ++i)
      least = std::min(least, 225.0f * glm::dot(row.stem[i] - row.stem[i - 1], row.stem[i + 1] - row.stem[i]));
    return least;
  };
  EXPECT_LT(sharpest(blade_type_row(stem_of({{0, 0}, {0, 1}, {0, 1}, {1, 1}}))), 0.75f);
  EXPECT_GT(sharpest(blade_type_row(stem_of({{0, 0}, {0, 1}, {1, 1}}))), 0.9f);
}

TEST(BladeTypes, a_file_with_comments_empty_lines_and_windows_line_ends_is_read) {
  const auto types = parse_blade_types(
      "# grass\r\n\r\nreed 2 1.5 0.5 0.25 0 0,0 0.5,1e0 # tall\r\n \t\nmoss 0.5 0.1 2 1 1 0,0 -1,2 3,4", "x");
  ASSERT_TRUE(types.ok()) << types.error().message;
  ASSERT_EQ(types->size(), 2u);
  const BladeType& reed = (*types)[0];
  EXPECT_EQ(reed.name, "reed");
  EXPECT_EQ(reed.share, 2.0f);
  EXPECT_EQ(reed.length_scale, 1.5f);
  EXPECT_EQ(reed.width_scale, 0.5f);
  EXPECT_EQ(reed.stiffness, 0.25f);
  EXPECT_EQ(reed.taper, 0.0f);
  EXPECT_EQ(reed.points, (std::vector<vec2>{{0, 0}, {0.5f, 1}}));
  EXPECT_EQ((*types)[1].points, (std::vector<vec2>{{0, 0}, {-1, 2}, {3, 4}}));
}

TEST(BladeTypes, each_fault_names_file_line_and_reason) {
  const std::string good = "a 1 1 1 0.5 0.1 0,0 0,1\n";
  EXPECT_EQ(fault_of(good), "(no fault)");
  EXPECT_EQ(fault_of(""), "lawn.blades: has no blade type");
  EXPECT_EQ(fault_of("# nothing\n"), "lawn.blades: has no blade type");
  EXPECT_EQ(fault_of("\n" + good + "b 0 1 1 0.5 0.1 0,0 0,1"),
            "lawn.blades line 3: share must be above 0 and at most 1e+06, is \"0\"");
  EXPECT_THAT(fault_of("b 1 -1 1 0.5 0.1 0,0 0,1"), HasSubstr("line 1: length must be above 0 and at most 10"));
  EXPECT_THAT(fault_of("b 1 1 11 0.5 0.1 0,0 0,1"), HasSubstr("width must be above 0 and at most 10, is \"11\""));
  EXPECT_THAT(fault_of("b 1 1 1 1.5 0.1 0,0 0,1"), HasSubstr("stiffness must be 0 to 1, is \"1.5\""));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 nan 0,0 0,1"), HasSubstr("taper must be 0 to 1, is \"nan\""));
  EXPECT_THAT(fault_of("b 1 1x 1 0.5 0.1 0,0 0,1"), HasSubstr("length must be"));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0"), HasSubstr("at least 2 points"));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0 01"), HasSubstr("must be forward,up, is \"01\""));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0 0,y"), HasSubstr("must be two numbers, is \"0,y\""));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0 0,-1"), HasSubstr("must not lie below 0, is \"0,-1\""));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0 0,1e5"), HasSubstr("must lie within 100, is \"0,1e5\""));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,1 0,2"), HasSubstr("the first point of the stem must be 0,0"));
  EXPECT_THAT(fault_of("b 1 1 1 0.5 0.1 0,0 0,0"), HasSubstr("the stem must be at least 0.001 long"));
  EXPECT_THAT(fault_of(good + good), HasSubstr("line 2: the type \"a\" is there twice"));
  std::string points = "b 1 1 1 0.5 0.1";
  for (int i = 0; i < 33; ++i) points += " 0," + std::to_string(i);
  EXPECT_THAT(fault_of(points), HasSubstr("a stem has at most 32 points, this one has 33"));
  std::string many;
  for (int i = 0; i < 17; ++i) many += "t" + std::to_string(i) + " 1 1 1 0.5 0.1 0,0 0,1\n";
  EXPECT_THAT(fault_of(many), HasSubstr("line 17: a file has at most 16 types"));
  EXPECT_THAT(fault_of(std::string_view("\0\xff 1", 4)), HasSubstr("line 1: a type needs"));
}

TEST(BladeTypes, files_are_read_and_unreadable_ones_are_an_error_with_the_path) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/lawn.blades";
  const auto absent = read_blade_types(path);
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().message, path + ": cannot be read");
  EXPECT_FALSE(read_blade_types(folder.path()).ok());
  std::ofstream(path) << builtin_blade_types_text();
  const auto types = read_blade_types(path);
  ASSERT_TRUE(types.ok()) << types.error().message;
  EXPECT_EQ(types->size(), 5u);
  std::ofstream(path) << std::string((1u << 20) + 1, '#');
  const auto large = read_blade_types(path);
  ASSERT_FALSE(large.ok());
  EXPECT_THAT(large.error().message, HasSubstr("longer than 1 MiB"));
}

}  // namespace
}  // namespace gloam
