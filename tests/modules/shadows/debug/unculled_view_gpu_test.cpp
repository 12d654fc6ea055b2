// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/unculled_view.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "modules/lights/lists/uploads.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"
#include "tests/modules/shadows/support/final_lists/scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A texel of image "shadow_unculled".
struct Compared {
  float unculled = 0.0f;
  float drawn = 0.0f;
  float difference = 0.0f;
  float one = 0.0f;
};

class UnculledView : public test::FinalListScene {
 protected:
  [[nodiscard]] std::vector<Compared> compared(const std::string& light, const std::string& view = "shadow_unculled") {
    settings.visualizer = view + ":" + light;
    draw();
    settings.visualizer = "none";
    const ImageBytes image = test::value_of(renderer->read_image(world, settings.id, "shadow_unculled"));
    std::vector<Compared> texels(image.bytes.size() / sizeof(Compared));
    std::memcpy(texels.data(), image.bytes.data(), image.bytes.size());
    return texels;
  }
  /// Draws the view and expects that nothing differs.
  void expect_equal(const std::string& light, const std::string& what) {
    int partly = 0, unlit = 0;
    float worst = 0.0f;
    for (const Compared& c : compared(light)) {
      worst = std::max(worst, c.difference);
      EXPECT_FALSE(std::isnan(c.unculled) || std::isnan(c.drawn));
      partly += c.unculled > 0.0f && c.unculled < 1.0f ? 1 : 0;
      unlit += c.unculled == 0.0f ? 1 : 0;
    }
    EXPECT_LE(worst, kRounding) << light << ' ' << what;
    EXPECT_GT(partly + unlit, 20) << light << ' ' << what << ": there is a shadow";
  }
  /// Takes a local light out of the CPU's masks of a tile group (64×64 pixels), which are kept as long as lights and
  /// camera rest.
  void break_masks(const std::string& name, uvec2 group) {
    const std::span<const Entity> lights = local_lights(world.view_resource<VisibleLights>(settings.id));
    const auto light = static_cast<std::uint32_t>(std::ranges::find(lights, named(name)) - lights.begin());
    ASSERT_LT(light, lights.size());
    auto& masks = world.view_resource<TileLightMasks>(settings.id);
    std::uint32_t listed = 0;
    for (std::uint32_t y = 2 * group.y; y < std::min(2 * group.y + 2, masks.tiles.y); ++y)
      for (std::uint32_t x = 2 * group.x; x < std::min(2 * group.x + 2, masks.tiles.x); ++x) {
        std::uint32_t& word = masks.words.at((y * masks.tiles.x + x) * GLOAM_MASK_WORDS + 1 + light / 32);
        listed += word >> light % 32 & 1u;
        word &= ~(1u << light % 32);
      }
    ASSERT_GT(listed, 0u) << "a tile lists the light";
    world.view_resource<TileMaskHash>(settings.id) = {};  // so that the masks are uploaded again
  }
  static constexpr float kRounding = 1e-6f;  ///< of a division by 255
};

TEST_F(UnculledView, equals_what_is_drawn_with_every_filter) {
  for (const char* filter : {"hard", "pcf", "pcss", "chs"}) {
    set("shadows.filter", filter);
    for (const char* light : {"lamp", "near", "sun"}) expect_equal(light, filter);
  }
  set("shadows.visibility_bits", "4");
  expect_equal("lamp", "4 bits");
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(UnculledView, differs_little_without_early_outs) {
  set("shadows.filter", "chs");
  for (const char* light : {"lamp", "near", "sun"}) {
    double sum = 0.0;
    const std::vector<Compared> texels = compared(light, "shadow_filtered");
    for (const Compared& c : texels) sum += static_cast<double>(c.difference);
    EXPECT_LE(sum / static_cast<double>(texels.size()), 0.01) << light;
    RecordProperty(light, std::to_string(sum / static_cast<double>(texels.size())));
  }
}

TEST_F(UnculledView, shows_the_tiles_whose_lists_miss_the_light) {
  for (int frame = 0; frame < 3; ++frame) draw();
  const uvec2 broken(0, 0);
  ASSERT_NO_FATAL_FAILURE(break_masks("lamp", broken));
  int missed = 0, lit = 0, elsewhere = 0, pale = 0;
  const std::vector<Compared> texels = compared("lamp");
  const Picture p = picture();
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const Compared& c = texels[std::size_t{y} * settings.width + x];
      const bool inside = uvec2(x, y) / 64u == broken;
      if (inside && c.unculled > 0.0f) {
        ++missed;
        lit += c.drawn > 0.0f ? 1 : 0;
        const std::uint8_t* rgba = &p.rgba[4 * (std::size_t{y} * settings.width + x)];
        pale += rgba[0] > 2 * rgba[1] && rgba[0] > 2 * rgba[2] ? 0 : 1;
      }
      if (!inside) elsewhere += c.difference > kRounding ? 1 : 0;
    }
  EXPECT_GT(missed, 300);
  EXPECT_EQ(lit, 0);
  EXPECT_EQ(pale, 0) << "red where the drawn visibility is darker";
  EXPECT_EQ(elsewhere, 0);
}

TEST_F(UnculledView, says_why_there_is_nothing_to_compare) {
  set("lights.culling", "brute");
  settings.visualizer = "shadow_unculled:lamp";
  draw();
  EXPECT_THAT(warnings,
              ElementsAre("view shadow_unculled:lamp shows the picture as it is: there are no final lists with "
                          "lights.culling=brute"));
  set("lights.culling", "tiled");
  set("shadows.mode", "monolithic");
  EXPECT_THAT(renderer->check_visualizer(world, "shadow_unculled:lamp").error().message,
              HasSubstr("needs shadows.mode=deferred"));
}

}  // namespace
}  // namespace gloam
