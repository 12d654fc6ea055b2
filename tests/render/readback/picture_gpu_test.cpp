// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/math/srgb.h"
#include "engine/render/readback/capture.h"
#include "tests/render/draws/drawn_scene.h"

// Whole pictures: which changes must leave them equal, and which must not.

namespace gloam {
namespace {

using test::Rgba;
using test::Stage;
using test::texel_of;

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

class Pictures : public test::DrawingTest {
 protected:
  /// The small scene with its lights, seen from one side. Everything is moved by `offset`.
  static void fill(Stage& stage, const dvec3& offset = dvec3(0.0)) {
    test::fill_small_scene(stage.world);
    test::add_lights(stage.world);
    stage.world.view<WorldTransform>().each(
        [&](WorldTransform& transform) { transform.matrix[3] += dvec4(offset, 0.0); });
    stage.world.resource<SceneEnvironment>().exposure_ev100 = 3.0f;
    stage.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 96, 54);
    stage.settings.world_from_camera[3] += dvec4(offset, 0.0);
  }
  /// Turns shadows off. Cascades snap to a grid in the world and faces keep their earlier size, so that shadowed
  /// pictures may differ by texels.
  static void without_shadows(Stage& stage) { ASSERT_TRUE(stage.renderer->knobs().set("shadows.mode", "off").ok()); }
};

std::size_t distinct_colours(const Picture& picture) {
  std::vector<std::uint32_t> colours;
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    colours.push_back(picture.rgba[i] | static_cast<std::uint32_t>(picture.rgba[i + 1]) << 8 |
                      static_cast<std::uint32_t>(picture.rgba[i + 2]) << 16);
  std::ranges::sort(colours);
  return static_cast<std::size_t>(std::unique(colours.begin(), colours.end()) - colours.begin());
}

TEST_F(Pictures, an_empty_world_is_black_sky) {
  const Picture picture = stage->drawn();
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) ASSERT_EQ(texel_of(picture, x, y), (Rgba{0, 0, 0, 255}));
  EXPECT_TRUE(stage->pick(3, 4).sky);
}

TEST_F(Pictures, the_same_scene_gives_the_same_picture) {
  fill(*stage);
  const Picture first = stage->drawn();
  EXPECT_GT(distinct_colours(first), 100u) << "the scene shows nothing to compare";
  EXPECT_EQ(stage->drawn().rgba, first.rgba) << "the next frame";
  Stage again;
  fill(again);
  EXPECT_EQ(again.drawn().rgba, first.rgba) << "another renderer";
}

TEST_F(Pictures, far_from_the_origin_nothing_changes_by_a_bit) {
  fill(*stage);
  without_shadows(*stage);
  stage->render();
  const LinearPicture home = stage->linear();
  const Picture home_picture = stage->picture();
  // Powers of two above 10,000 km keep all positions of the scene exact in double.
  for (const dvec3& offset : {dvec3(0x1p24, 0.0, 0.0), dvec3(-0x1p25, 0x1p24, 0x1p26)}) {
    Stage far;
    fill(far, offset);
    without_shadows(far);
    far.render();
    EXPECT_EQ(far.linear().rgba, home.rgba);
    EXPECT_EQ(far.picture().rgba, home_picture.rgba);
  }
}

TEST_F(Pictures, two_views_show_what_each_would_show_alone) {
  fill(*stage);
  ViewRequest front = stage->request(0);
  ViewRequest side = stage->request(5);
  side.settings = test::look_at(dvec3(-9.0, 2.0, 1.0), dvec3(0.0), 61, 47);
  side.settings.id = ViewId{5};
  stage->render({front});
  const Picture front_alone = stage->picture(0);
  stage->render({side});
  const Picture side_alone = stage->picture(5);
  stage->render({front, side});
  EXPECT_EQ(stage->picture(0).rgba, front_alone.rgba);
  EXPECT_EQ(stage->picture(5).rgba, side_alone.rgba);
  stage->render({side, front});
  EXPECT_EQ(stage->picture(0).rgba, front_alone.rgba);
  EXPECT_EQ(stage->picture(5).rgba, side_alone.rgba);
}

TEST_F(Pictures, two_metered_views_of_one_frame_have_exposures_of_their_own) {
  fill(*stage);
  stage->world.resource<SceneEnvironment>().has_exposure = false;
  ViewRequest front = stage->request(0);
  ViewRequest close = stage->request(5);
  close.settings = test::look_at(dvec3(1.0, 2.0, 4.0), dvec3(0.5, 0.0, 0.0), 61, 47);
  close.settings.id = ViewId{5};
  stage->render({front, close});
  const std::vector<std::uint8_t> together[] = {stage->picture(0).rgba, stage->picture(5).rgba};
  Stage alone;
  fill(alone);
  alone.world.resource<SceneEnvironment>().has_exposure = false;
  alone.render({front});
  alone.render({close});
  EXPECT_EQ(alone.picture(0).rgba, together[0]);
  EXPECT_EQ(alone.picture(5).rgba, together[1]);
}

TEST_F(Pictures, sizes_of_one_pixel_and_odd_ones_draw) {
  fill(*stage);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 9u}, {17u, 1u}, {33u, 31u}, {96u, 54u}, {8u, 8u}}) {
    stage->settings.width = width;
    stage->settings.height = height;
    const Picture picture = stage->drawn();
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
    EXPECT_EQ(picture.rgba.size(), std::size_t{4} * width * height);
  }
}

TEST_F(Pictures, a_view_resized_and_back_shows_the_same_again) {
  fill(*stage);
  without_shadows(*stage);
  const Picture before = stage->drawn();
  stage->settings.width = 50;
  const Picture narrow = stage->drawn();
  EXPECT_NE(narrow.rgba.size(), before.rgba.size());
  stage->settings.width = 96;
  EXPECT_EQ(stage->drawn().rgba, before.rgba);
}

TEST_F(Pictures, views_of_albedo_normal_and_depth_show_their_channel) {
  Material material;
  material.base_color = vec4(0.5f, 0.25f, 0.75f, 1.0f);
  stage->scene.draw(stage->scene.mesh(test::quad(1.0f, stage->scene.material(material))), at(0, 0, -5));
  const auto middle = [&](const char* visualizer) {
    stage->settings.visualizer = visualizer;
    const Picture picture = stage->drawn();
    EXPECT_EQ(texel_of(picture, 0, 0), (Rgba{0, 0, 0, 255})) << "sky is black in view " << visualizer;
    return texel_of(picture, 16, 16);
  };
  const auto expect_within = [](const Rgba& shown, const dvec3& encoded, double bound) {
    EXPECT_NEAR(shown.r, 255.0 * encoded.x, bound);
    EXPECT_NEAR(shown.g, 255.0 * encoded.y, bound);
    EXPECT_NEAR(shown.b, 255.0 * encoded.z, bound);
  };
  expect_within(middle("albedo"), {linear_to_srgb(0.5), linear_to_srgb(0.25), linear_to_srgb(0.75)}, 1.01);
  expect_within(middle("normal"), dvec3(0.5, 0.5, 1.0), 1.01);
  expect_within(middle("depth"), dvec3(linear_to_srgb(1.0 / 1.5)), 1.01);
}

TEST_F(Pictures, a_picture_that_does_not_encode_gets_encoded_colours) {
  fill(*stage);
  for (const char* visualizer : {"none", "albedo", "normal", "depth"}) {
    stage->settings.visualizer = visualizer;
    const Picture own = stage->drawn();
    gpu::ImageDesc desc{
        .name = "host picture", .module = "host", .format = gpu::Format::rgba8_unorm, .width = 96, .height = 54};
    desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
    const gpu::ImageHandle image = test::value_of(test::drawing_device()->create_image(desc));
    ViewRequest request = stage->request();
    request.target.image = image;
    request.target.after = gpu::Access::transfer_read;
    stage->render({request});
    ASSERT_TRUE(stage->renderer->wait().ok());
    const auto bytes = test::value_of(read_image_now(*test::drawing_device(), image));
    test::drawing_device()->destroy(image);
    ASSERT_EQ(bytes.size(), own.rgba.size());
    int worst = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<int>(bytes[i]) - own.rgba[i]));
    EXPECT_LE(worst, 2) << "view " << visualizer;
  }
}

TEST_F(Pictures, blended_surfaces_lie_over_the_opaque_ones) {
  Material wall;
  wall.base_color = vec4(0.8f, 0.8f, 0.8f, 1.0f);
  wall.metallic = 0.0f;
  wall.emissive = vec3(1.0f);
  Material glass;
  glass.base_color = vec4(0.0f, 0.0f, 0.0f, 0.25f);
  glass.emissive = vec3(0.0f, 4.0f, 0.0f);
  glass.metallic = 0.0f;
  glass.alpha_mode = AlphaMode::blend;
  stage->scene.draw(stage->scene.mesh(test::quad(3.0f, stage->scene.material(wall))), at(0, 0, -5));
  const Entity pane =
      stage->scene.draw(stage->scene.mesh(test::quad(1.0f, stage->scene.material(glass))), at(0, 0, -4));
  stage->render();
  const LinearPicture picture = stage->linear();
  const float* middle = picture.rgba.data() + 4 * (16 * 33 + 16);
  EXPECT_NEAR(middle[0], 0.75, 0.01);
  EXPECT_NEAR(middle[1], 0.75 + 0.25 * 4.0, 0.01);
  EXPECT_NEAR(stage->pick(16, 16).depth_m, 5.0, 1e-3) << "the geometry buffer holds what is opaque";
  stage->world.get<WorldTransform>(pane).matrix = at(0, 0, -6);
  stage->render();
  EXPECT_NEAR(stage->linear().rgba[4 * (16 * 33 + 16)], 1.0, 0.01) << "behind the wall it is hidden";
}

TEST_F(Pictures, assets_changed_between_frames_are_shown) {
  const std::uint32_t material = stage->scene.material(Material{});
  stage->scene.draw(stage->scene.mesh(test::quad(1.0f, material)), at(0, 0, -3));
  stage->settings.visualizer = "albedo";
  EXPECT_EQ(texel_of(stage->drawn(), 16, 16), (Rgba{255, 255, 255, 255}));
  stage->scene.assets().materials[material].base_color = vec4(1.0f, 0.0f, 0.0f, 1.0f);
  ++stage->scene.assets().version;
  EXPECT_EQ(texel_of(stage->drawn(), 16, 16), (Rgba{255, 0, 0, 255}));
}

}  // namespace
}  // namespace gloam
