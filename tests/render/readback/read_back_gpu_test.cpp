// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/readback/geometry_picture.h"
#include "tests/render/draws/drawn_scene.h"

// Renderer::read_image, read_images and read_geometry.

namespace gloam {
namespace {

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

class ReadBack : public test::DrawingTest {};

TEST_F(ReadBack, the_geometry_buffer_is_what_pick_tells) {
  test::fill_small_scene(stage->world);
  test::add_lights(stage->world);
  stage->settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 48, 27);
  stage->render();
  const GeometryPicture picture = test::value_of(stage->renderer->read_geometry(stage->world, ViewId{0}));
  ASSERT_EQ(picture.depth.size(), 48u * 27u);
  EXPECT_EQ(picture.view.width, 48u);
  EXPECT_EQ(picture.view.position, dvec3(2.0, 3.0, 9.0));
  int surfaces = 0;
  for (const auto& [x, y] :
       {std::pair(0u, 0u), std::pair(24u, 13u), std::pair(10u, 20u), std::pair(30u, 18u), std::pair(47u, 26u)}) {
    const test::Picked picked = stage->pick(x, y);
    const std::size_t i = std::size_t{y} * 48 + x;
    ASSERT_EQ(picture.is_sky(i), picked.sky);
    if (picked.sky) continue;
    ++surfaces;
    const GeometryTexel texel = picture.texel(i);
    EXPECT_LT(glm::length(dvec3(texel.base_color) - picked.base_color), 1e-4);
    EXPECT_LT(glm::length(dvec3(texel.normal) - picked.normal), 2e-4);
    EXPECT_LT(glm::length(dvec3(texel.face_normal) - picked.face_normal), 2e-4);
    const double along = -glm::dot(dvec3(glm::transpose(picture.view.view_from_relative)[2]), picture.position(x, y));
    EXPECT_NEAR(along, picked.depth_m, 1e-4);
  }
  EXPECT_GE(surfaces, 2);
}

TEST_F(ReadBack, positions_lie_on_what_is_drawn_far_from_the_origin_too) {
  for (const double far : {0.0, 1e5}) {
    test::Stage own;
    const dvec3 offset(far, -far, far);
    const dmat4 tilt = glm::rotate(dmat4(1.0), -0.9, glm::normalize(dvec3(1.0, 0.2, 0.0)));
    own.scene.draw(own.scene.mesh(test::quad(6.0f)), glm::translate(dmat4(1.0), offset) * tilt);
    own.settings = test::look_at(offset + dvec3(0.3, 2.0, 7.0), offset, 64, 36);
    own.render();
    const GeometryPicture picture = test::value_of(own.renderer->read_geometry(own.world, ViewId{0}));
    const dvec3 normal(tilt[2]);
    int surfaces = 0;
    for (std::uint32_t y = 0; y < 36; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        if (picture.is_sky(std::size_t{y} * 64 + x)) continue;
        ++surfaces;
        const dvec3 world = picture.position(x, y) + picture.view.position;
        ASSERT_NEAR(glm::dot(world - offset, normal), 0.0, 1e-4) << "pixel " << x << "," << y;
      }
    }
    EXPECT_GT(surfaces, 500);
  }
}

TEST_F(ReadBack, an_image_has_its_size_its_format_and_its_texels) {
  Material material;
  material.base_color = vec4(1.0f, 0.0f, 1.0f, 1.0f);
  stage->scene.draw(stage->scene.mesh(test::quad(1.0f, stage->scene.material(material))), at(0, 0, -3));
  stage->render();
  const ImageBytes image = test::value_of(stage->renderer->read_image(stage->world, ViewId{0}, "base_color"));
  EXPECT_EQ(image.width, 33u);
  EXPECT_EQ(image.height, 33u);
  EXPECT_EQ(image.format, gpu::Format::rgba8_unorm);
  ASSERT_EQ(image.bytes.size(), 33u * 33u * 4u);
  std::array<std::uint8_t, 4> middle;
  std::memcpy(middle.data(), image.bytes.data() + 4 * (16 * 33 + 16), 4);
  EXPECT_EQ(middle, (std::array<std::uint8_t, 4>{255, 0, 255, 0}));
}

TEST_F(ReadBack, an_image_that_nobody_exposed_is_an_error_that_lists_the_others) {
  stage->render();
  const auto none = stage->renderer->read_image(stage->world, ViewId{0}, "no_such_image");
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::usage);
  for (const char* name : {"no_such_image", "base_color", "normals", "material", "depth"})
    EXPECT_NE(none.error().message.find(name), std::string::npos) << none.error().message;
  EXPECT_TRUE(stage->renderer->read_image(stage->world, ViewId{0}, "depth").ok()) << "and nothing is broken after";
}

TEST_F(ReadBack, reading_leaves_picture_and_views_as_they_were) {
  test::fill_small_scene(stage->world);
  test::add_lights(stage->world);
  stage->settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 48, 27);
  ViewRequest other = stage->request(1);
  other.settings.world_from_camera = test::look_at(dvec3(9.0, 3.0, 2.0), dvec3(0.0), 40, 20).world_from_camera;
  other.settings.width = 40;
  other.settings.height = 20;
  stage->render({stage->request(0), other});
  const Picture picture = stage->picture(0);
  EXPECT_EQ(test::value_of(stage->renderer->read_image(stage->world, ViewId{1}, "depth")).width, 40u);
  EXPECT_EQ(test::value_of(stage->renderer->read_image(stage->world, ViewId{0}, "depth")).width, 48u);
  EXPECT_EQ(stage->picture(0).rgba, picture.rgba);
}

/// Exposes an image and writes it again afterwards.
class ExposingModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "exposing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::lists) {
      image_ = fill(frame, create_view_image(frame, "filled", gpu::Format::r32_uint, 2), 7);
      frame.expose(image_);
      frame.expose(image_, "by_another_name");
    }
    if (phase == PassPhase::visualize) image_ = fill(frame, image_, 9);
  }

 private:
  static ImageRef fill(FrameBuilder& frame, ImageRef image, std::uint32_t value) {
    PassBuilder pass = frame.graph().add_pass("fill", "exposing");
    const ImageRef filled = pass.write(image, gpu::Access::transfer_write);
    pass.execute([filled, value](PassContext& context) {
      context.commands().clear_color_image(context.image(filled), {value, 0u, 0u, 0u});
    });
    return filled;
  }
  ImageRef image_;
};

TEST_F(ReadBack, the_newest_version_of_a_modules_image_is_read) {
  test::Stage own(std::make_unique<ExposingModule>());
  own.render();
  for (const char* name : {"filled", "by_another_name"}) {
    const ImageBytes image = test::value_of(own.renderer->read_image(own.world, ViewId{0}, name));
    EXPECT_EQ(image.width, 17u);
    EXPECT_EQ(image.format, gpu::Format::r32_uint);
    ASSERT_EQ(image.bytes.size(), 17u * 17u * 4u);
    std::uint32_t last = 0;
    std::memcpy(&last, image.bytes.data() + image.bytes.size() - 4, 4);
    EXPECT_EQ(last, 9u);
  }
}

}  // namespace
}  // namespace gloam
