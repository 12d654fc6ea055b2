// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/pick.h"

#include <gmock/gmock.h>

#include <optional>

#include "tests/modules/shadows/support/final_lists/scene.h"

namespace gloam {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ShadowPick : public test::FinalListScene {
 protected:
  /// The lines about final lists, which are the last lines of a pick.
  [[nodiscard]] std::vector<std::string> pick(uvec2 pixel) {
    draw();
    std::vector<std::string> lines = test::value_of(renderer->pick(world, ViewId{0}, pixel.x, pixel.y));
    const auto first =
        std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return l.starts_with("final list: "); });
    return {first, lines.end()};
  }
  /// The line of an entry; empty when there is none.
  [[nodiscard]] static std::string line_of(const std::vector<std::string>& lines, const std::string& name) {
    for (const std::string& line : lines)
      if (line.starts_with("  ") && line.find(" " + name + ":") != std::string::npos) return line;
    return {};
  }
  struct Wanted {
    bool listed = true;
    bool stored = true;
  };
  /// A pixel of a tile whose list holds the light as wanted. If the light must have a slot, it is partly visible at the
  /// pixel.
  [[nodiscard]] std::optional<uvec2> find_pixel(const std::string& name, Wanted wanted,
                                                const std::vector<float>& seen) {
    const test::ReadFinalLists read = lists();
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const auto entry = entry_of(read, tile_of(x, y), name);
        const float v = seen[std::size_t{y} * settings.width + x];
        if (entry.has_value() != wanted.listed || v < 0.0f || !read.complete(tile_of(x, y))) continue;
        if (!wanted.listed) return uvec2(x, y);
        if ((*entry >> 10 != GLOAM_ALL_LIT) == wanted.stored && (!wanted.stored || (v > 0.1f && v < 0.9f)))
          return uvec2(x, y);
      }
    return std::nullopt;
  }
  void expect_numbers_of_the_image(const std::string& name) {
    const std::vector<float> seen = visibility(name);
    const auto partly = find_pixel(name, {true, true}, seen);
    ASSERT_TRUE(partly) << name;
    const std::string line = line_of(pick(*partly), name);
    const std::size_t number = line.find(", visibility ");
    ASSERT_NE(number, std::string::npos) << line;
    EXPECT_THAT(line, HasSubstr(": slot "));
    EXPECT_NEAR(std::stod(line.substr(number + 13)), seen[std::size_t{partly->y} * settings.width + partly->x], 6e-5)
        << line;
  }
};

TEST_F(ShadowPick, tells_each_light_of_the_final_list_and_those_left_out) {
  for (const char* light : {"lamp", "near", "sun"}) expect_numbers_of_the_image(light);
  const std::vector<float> seen = visibility("lamp");
  const auto lit = find_pixel("lamp", {true, false}, seen), dark = find_pixel("lamp", {false, false}, seen);
  ASSERT_TRUE(lit && dark);
  EXPECT_THAT(line_of(pick(*lit), "lamp"), HasSubstr(" lamp: lit as a whole"));
  const std::vector<std::string> lines = pick(*dark);
  EXPECT_EQ(line_of(lines, "lamp"), "");
  const auto left_out = std::find_if(lines.begin(), lines.end(),
                                     [](const std::string& l) { return l.starts_with("left out, no pixel"); });
  ASSERT_NE(left_out, lines.end());
  EXPECT_THAT(*left_out, HasSubstr(" lamp"));
  EXPECT_THAT(line_of(pick(uvec2(44, 30)), "plain"), HasSubstr("plain: lit as a whole")) << "casts no shadow";
}

TEST_F(ShadowPick, tells_values_of_four_bits) {
  set("shadows.visibility_bits", "4");
  for (const char* light : {"lamp", "sun"}) expect_numbers_of_the_image(light);
}

TEST_F(ShadowPick, tells_of_sky_tiles_without_room_and_other_modes) {
  EXPECT_THAT(pick(uvec2(100, 2)), Contains("final list: none, the tile shows only sky"));
  const auto partly = find_pixel("lamp", {true, true}, visibility("lamp"));
  ASSERT_TRUE(partly);
  set("shadows.slot_limit", "0");
  EXPECT_THAT(pick(*partly), Contains("final list: none, a buffer was full: the tile is shaded from shadow maps"));
  set("shadows.mode", "monolithic");
  EXPECT_THAT(pick(*partly), IsEmpty());
}

}  // namespace
}  // namespace gloam
