// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/debug/unculled_pairs.h"

#include <algorithm>
#include <cstring>

#include "tests/modules/closeups/scene.h"

namespace gloam::test {
namespace {

/// A texel of image "shadow_unculled".
struct Compared {
  float unculled = 0.0f;
  float drawn = 0.0f;
  float difference = 0.0f;
  float one = 0.0f;
};

class UnculledPairsTest : public CloseupScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(CloseupScene::SetUp());
    if (IsSkipped()) return;
    settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 160, 96);
    put_room();
    put_far_boxes();
    figures_ = {put_figure(dvec3(-0.5, 0.0, 0.0)), put_figure(dvec3(0.5, 0.0, 0.3), 0.8, 1.1)};
    put_light(point(0.1f), dvec3(0.9, 2.4, 0.9), dvec3(0.0, -1.0, 0.0), 128);
    put_light(spot(45.0, 0.05f), dvec3(-0.5, 2.6, 1.0), dvec3(0.3, -1.0, -0.4), 128);
    put_light(sun(0.02f), dvec3(0.0), dvec3(0.4, -1.0, -0.3), 256);
  }
  [[nodiscard]] std::vector<Compared> compared(Entity light) {
    settings.visualizer = "shadow_unculled:" + names_.at(light);
    for (int frame = 0; frame < 2; ++frame) draw();
    settings.visualizer = "none";
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_unculled"));
    std::vector<Compared> texels(image.bytes.size() / sizeof(Compared));
    std::memcpy(texels.data(), image.bytes.data(), image.bytes.size());
    return texels;
  }
  /// Greatest difference between the visibility without culling and the drawn one.
  [[nodiscard]] float worst_difference(Entity light) {
    float worst = 0.0f;
    for (const Compared& c : compared(light)) worst = std::max(worst, c.difference);
    return worst;
  }
  std::vector<Figure> figures_;
};

TEST_F(UnculledPairsTest, equal_what_is_drawn) {
  for (const char* pairs : {"8", "0"}) {
    set("closeups.max_pairs", pairs);
    for (const Entity light : lamps) EXPECT_LE(worst_difference(light), 1.001f / 255.0f) << pairs << names_.at(light);
  }
  set("closeups.max_pairs", "8");
  set("closeups.batch", "4");
  for (const Entity light : lamps) EXPECT_LE(worst_difference(light), 1.001f / 255.0f) << names_.at(light);
}

TEST_F(UnculledPairsTest, hold_the_shadows_of_subjects) {
  for (const Entity light : lamps) {
    const std::vector<Compared> with = compared(light);
    for (const Figure& figure : figures_) world.get<CloseupSubject>(figure.root).enabled = false;
    const std::vector<Compared> plain = compared(light);
    for (const Figure& figure : figures_) hide(figure);
    const std::vector<Compared> empty = compared(light);
    for (const Figure& figure : figures_) show(figure);
    for (const Figure& figure : figures_) world.get<CloseupSubject>(figure.root).enabled = true;
    std::size_t shadowed = 0, missing = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const bool unlit = plain[i].unculled >= 0.0f && plain[i].unculled < 0.05f && empty[i].unculled > 0.95f;
      shadowed += unlit ? 1 : 0;
      missing += unlit && with[i].unculled > 0.5f ? 1 : 0;
    }
    EXPECT_GT(shadowed, 100u) << names_.at(light);
    EXPECT_LE(missing * 20, shadowed) << names_.at(light) << ": only silhouettes move";
  }
}

TEST_F(UnculledPairsTest, are_unculled_where_surfaces_that_blend_need_an_overlay) {
  put(pane_, at(0.0, 0.8, 1.0));
  for (const Entity light : lamps) EXPECT_LE(worst_difference(light), 1.001f / 255.0f) << names_.at(light);
}

}  // namespace
}  // namespace gloam::test
