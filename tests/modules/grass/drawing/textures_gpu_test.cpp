// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Blades with an image: where its rows show, what alpha cuts out, its colour from far, several images in a world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/srgb.h"
#include "modules/grass/drawing/textures.h"
#include "tests/modules/grass/support/grass_stage.h"
#include "tests/support/gltf_files.h"

namespace gloam::test {
namespace {

using Pixel = std::function<std::vector<std::uint8_t>(double u, double v)>;  // v: 0 root … 1 tip

class GrassTextures : public GrassTest {
 protected:
  /// A surface whose blades are wide and have this image.
  [[nodiscard]] GrassSurface with_image(GrassStage& stage, const std::string& name, int width, int height,
                                        const Pixel& pixel, float width_m = 0.03f) const {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (const std::uint8_t channel : pixel((x + 0.5) / width, 1.0 - (y + 0.5) / height)) rgba.push_back(channel);
    GrassSurface values;
    values.width_m = width_m;
    values.max_distance_m = 200.0f;
    values.texture = stage.world.resource<SceneStrings>().intern(
        folder.write(name, encode_png(width, height, static_cast<int>(rgba.size()) / (width * height), rgba)));
    return values;
  }
  /// A view from the side. Blades are as wide as pixels at about 430 times their width.
  [[nodiscard]] static ViewSettings side(double distance_m, std::uint32_t width = 160, std::uint32_t height = 64) {
    ViewSettings view = look_at({0.0, 0.3, distance_m}, {0.0, 0.15, 0.0}, width, height);
    view.camera.fov_y = 2.0f * std::atan(0.42f * static_cast<float>(height) / 360.0f);
    return view;
  }
  /// Base colours of the pixels that show blades, by place of the pixel.
  [[nodiscard]] static std::vector<std::pair<std::size_t, vec3>> blade_colors(GrassStage& stage,
                                                                              const ViewSettings& view) {
    stage.draw(without_grass(view));
    const GeometryPicture ground = stage.geometry();
    stage.draw(view);
    const GeometryPicture all = stage.geometry();
    std::vector<std::pair<std::size_t, vec3>> colors;
    for (std::size_t i = 0; i < all.depth.size(); ++i)
      if (all.depth[i] != ground.depth[i]) colors.emplace_back(i, all.texel(i).base_color);
    return colors;
  }
  /// A stage whose blades stand still and are all drawn.
  static void rest(GrassStage& stage) {
    stage.set("grass.lod_pixels", "0");
    stage.set("grass.segments", "full");
  }

  TemporaryFolder folder;
};

TEST_F(GrassTextures, the_bottom_of_the_image_is_the_root_and_its_top_the_tip) {
  GrassStage stage;
  rest(stage);
  stage.lawn(1.5f, 400, dvec3(0.0), with_image(stage, "red_green.png", 32, 128, [](double, double v) {
               return std::vector<std::uint8_t>{static_cast<std::uint8_t>(255.0 * (1.0 - v)),
                                                static_cast<std::uint8_t>(255.0 * v), 0};
             }));
  // A pixel shows the colours of the rows that it covers, and of as many beside them.
  const auto green_share = [](double v) {
    const double green = srgb_to_linear(v), red = srgb_to_linear(1.0 - v);
    return green / (green + red);
  };
  for (const double distance_m : {3.0, 12.0, 25.0}) {  // at 25 m a blade is half a pixel wide and 5 pixels high
    SCOPED_TRACE(distance_m);
    const ViewSettings view = side(distance_m);
    const double rows = 1.5 * distance_m * (2.0 * 0.42 / 360.0) / 0.3;
    const std::vector<vec4> place = stage.shown(view, "grass_lod");
    std::size_t roots = 0, tips = 0;
    double worst_root = 0.0, worst_tip = 0.0;
    for (const auto& [i, color] : blade_colors(stage, view)) {
      if (place[i].x < 0.5f) continue;
      const double share = color.y / std::max(color.x + color.y, 1e-6f);
      if (place[i].y < 0.15f) worst_root = std::max(worst_root, share), ++roots;
      if (place[i].y > 0.85f) worst_tip = std::max(worst_tip, 1.0 - share), ++tips;
    }
    EXPECT_GT(roots, 8u);
    EXPECT_GT(tips, 8u);
    EXPECT_LT(worst_root, green_share(0.15 + rows)) << "green at a root";
    EXPECT_LT(worst_tip, green_share(0.15 + rows)) << "red at a tip";
  }
}

TEST_F(GrassTextures, u_runs_across_the_blade) {
  GrassStage stage;
  rest(stage);
  stage.lawn(0.4f, 60, dvec3(0.0),
             with_image(
                 stage, "left_right.png", 32, 32,
                 [](double u, double) {
                   return u < 0.5 ? std::vector<std::uint8_t>{255, 0, 0} : std::vector<std::uint8_t>{0, 0, 255};
                 },
                 0.08f));
  std::size_t red = 0, blue = 0, other = 0;
  for (const auto& [i, color] : blade_colors(stage, side(2.0))) {
    red += color.x > 0.9f ? 1 : 0;
    blue += color.z > 0.9f ? 1 : 0;
    other += color.x <= 0.9f && color.z <= 0.9f ? 1 : 0;
  }
  EXPECT_GT(red, 200u);
  EXPECT_NEAR(static_cast<double>(red) / static_cast<double>(blue), 1.0, 0.25);
  EXPECT_LT(other, red / 2) << "only where the two meet";
}

/// Pixels of blades of which alpha shows this share of the width, over those of whole blades.
TEST_F(GrassTextures, alpha_narrows_blades_near_and_far) {
  for (const double share : {0.0, 0.3, 0.5, 0.8}) {
    GrassStage whole, cut;
    for (GrassStage* stage : {&whole, &cut}) {
      rest(*stage);
      const double shown = stage == &whole ? 1.0 : share;
      stage->lawn(1.5f, 150, dvec3(0.0),
                  with_image(*stage, stage == &whole ? "whole.png" : "stripe.png", 64, 64, [&](double u, double) {
                    const bool inside = std::abs(u - 0.5) < 0.5 * shown;
                    return std::vector<std::uint8_t>{200, 200, 0, static_cast<std::uint8_t>(inside ? 255 : 0)};
                  }));
    }
    for (const double distance_m : {2.0, 6.0, 13.0, 30.0}) {
      double found = 0.0, wanted = 0.0;
      for (int shift = 0; shift < 4; ++shift) {
        ViewSettings view = side(distance_m, 240, 90);
        view.world_from_camera[3].x += 0.0037 * shift * distance_m;
        found += static_cast<double>(blade_colors(cut, view).size());
        wanted += static_cast<double>(blade_colors(whole, view).size());
      }
      std::printf("alpha shows %.1f at %.0f m: %.3f of %.0f pixels\n", share, distance_m, found / wanted, wanted);
      // Blades overlap, so a half of their width covers more than a half of the pixels.
      EXPECT_GE(found / wanted, 0.8 * share) << share << " at " << distance_m;
      EXPECT_LE(found / wanted, share + 0.15) << share << " at " << distance_m;
      if (share == 0.0) {
        EXPECT_EQ(found, 0.0);
      }
    }
  }
}

// Hard case: grass.texture_mips
TEST_F(GrassTextures, blades_have_the_mean_colour_of_the_image_from_far) {
  std::mt19937 random(7);
  dvec3 mean(0.0);
  const Pixel noise = [&](double, double) {
    std::vector<std::uint8_t> pixel;
    for (int c = 0; c < 3; ++c) pixel.push_back(random() % 2 == 0 ? 250 : static_cast<std::uint8_t>(random() % 60));
    for (int c = 0; c < 3; ++c) mean[c] += srgb_to_linear(pixel[static_cast<std::size_t>(c)] / 255.0) / (64.0 * 256.0);
    return pixel;
  };
  GrassStage stage;
  rest(stage);
  stage.lawn(2.0f, 600, dvec3(0.0), with_image(stage, "noise.png", 64, 256, noise));
  for (const double distance_m : {6.0, 15.0, 38.0}) {
    dvec3 found(0.0);
    const auto colors = blade_colors(stage, side(distance_m));
    for (const auto& [i, color] : colors) found += dvec3(color) / static_cast<double>(colors.size());
    ASSERT_GT(colors.size(), 100u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / mean[c], 1.0, 0.03) << distance_m << " m, channel " << c;
  }
}

TEST_F(GrassTextures, surfaces_have_their_own_images_and_others_the_procedural_colours) {
  const Pixel sheet = [](double u, double) {
    return u < 0.5 ? std::vector<std::uint8_t>{0, 0, 255} : std::vector<std::uint8_t>{255, 0, 255};
  };
  const dvec3 left(-1.2, 0.0, 0.0), right(1.2, 0.0, 0.0), middle(0.0);
  GrassStage stage, plain;
  for (GrassStage* one : {&stage, &plain}) {
    rest(*one);
    GrassSurface values;
    values.width_m = 0.03f;
    one->lawn(0.4f, 100, middle, values);
  }
  stage.lawn(0.4f, 100, left, with_image(stage, "red.png", 1, 1, [](double, double) {
               return std::vector<std::uint8_t>{255, 0, 0};
             }));
  stage.lawn(0.4f, 100, right, with_image(stage, "sheet.png", 32, 16, sheet));
  const auto at = [](const dvec3& place) {
    ViewSettings view = side(2.5, 120, 64);
    view.world_from_camera[3].x += place.x;
    view.camera.fov_y *= 0.9f;
    return view;
  };
  const auto reds = blade_colors(stage, at(left));
  EXPECT_GT(reds.size(), 200u);
  for (const auto& [i, color] : reds) ASSERT_EQ(color, vec3(1.0f, 0.0f, 0.0f));
  std::size_t blue = 0, purple = 0;
  for (const auto& [i, color] : blade_colors(stage, at(right))) {
    ASSERT_EQ(vec2(color.y, color.z), vec2(0.0f, 1.0f));
    ASSERT_TRUE(color.x == 0.0f || color.x == 1.0f) << "a blade has one layer of the image";
    (color.x > 0.5f ? purple : blue) += 1;
  }
  EXPECT_GT(blue, 100u);
  EXPECT_GT(purple, 100u);
  EXPECT_EQ(blade_colors(stage, at(middle)), blade_colors(plain, at(middle)));
}

TEST_F(GrassTextures, frames_with_motion_and_mirrored_views_show_the_same_colours) {
  const auto leaf = [](double u, double v) {
    return std::vector<std::uint8_t>{static_cast<std::uint8_t>(255.0 * v), 90, static_cast<std::uint8_t>(255.0 * u),
                                     static_cast<std::uint8_t>(std::abs(u - 0.5) < 0.3 ? 255 : 0)};
  };
  GrassStage still, moving({.motion = true});
  for (GrassStage* stage : {&still, &moving}) {
    rest(*stage);
    stage->lawn(0.5f, 200, dvec3(0.0), with_image(*stage, "leaf.png", 32, 64, leaf));
  }
  EXPECT_EQ(blade_colors(still, side(4.0)), blade_colors(moving, side(4.0)));
  ViewSettings mirrored = side(4.0);
  mirrored.mirror = MirrorPlane{dvec3(0.0, 0.0, 1.0), 0.0};
  EXPECT_GT(blade_colors(still, mirrored).size(), 100u);
  EXPECT_EQ(blade_colors(still, mirrored), blade_colors(moving, mirrored));
}

TEST_F(GrassTextures, the_array_is_counted_as_memory_of_grass) {
  const auto bytes = [](GrassStage& stage) {
    stage.draw(front(), 3);
    stage.renderer->free_idle_memory();
    std::uint64_t found = 0;
    for (const gpu::ModuleMemory& memory : shared_device()->memory())
      if (memory.module == "grass") found = memory.bytes;
    return found;
  };
  GrassStage stage;
  const Entity lawn = stage.lawn(0.5f, 200);
  const std::uint64_t before = bytes(stage);
  const GrassSurface image = with_image(stage, "large.png", 128, 1024, [](double, double) {
    return std::vector<std::uint8_t>{1, 2, 3};
  });
  stage.world.get<GrassSurface>(lawn).texture = image.texture;
  const std::uint64_t with_array = bytes(stage);
  EXPECT_GE(with_array, before + 128 * 1024 * 4 * 4 / 3);
}

TEST_F(GrassTextures, an_image_of_a_surface_of_the_host_shows_in_the_next_frame_and_goes_again) {
  GrassStage stage;
  rest(stage);
  const Entity lawn = stage.lawn(0.4f, 100);
  const auto before = blade_colors(stage, side(3.0));
  const GrassSurface red = with_image(stage, "red.png", 4, 4, [](double, double) {
    return std::vector<std::uint8_t>{255, 0, 0};
  });
  stage.world.get<GrassSurface>(lawn).texture = red.texture;
  const auto shown = blade_colors(stage, side(3.0));
  ASSERT_EQ(shown.size(), before.size()) << "the same blades, not planted anew";
  for (const auto& [i, color] : shown) ASSERT_EQ(color, vec3(1.0f, 0.0f, 0.0f));
  stage.world.get<GrassSurface>(lawn).texture = 0;
  EXPECT_EQ(blade_colors(stage, side(3.0)), before);
  stage.world.get<GrassSurface>(lawn).texture = stage.world.resource<SceneStrings>().intern(folder.path() + "/absent");
  EXPECT_EQ(blade_colors(stage, side(3.0)), before) << "procedural colours for an absent file";
}

}  // namespace
}  // namespace gloam::test
