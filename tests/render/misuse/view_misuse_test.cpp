// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Views and targets as a careless host requests them: each kind of misuse, and the sentence that names it.
#include <limits>

#include "tests/render/misuse/careless_host.h"

#include "engine/render/readback/geometry_picture.h"

namespace gloam {
namespace {

using test::CarelessHost;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using enum gpu::ImageUsage;

class ViewMisuse : public ::testing::Test {
 protected:
  void expect_assert(const ViewRequest& view, std::string_view sentence) {
    EXPECT_ASSERT((void)stage_.render(view), std::string(sentence));
    ASSERT_TRUE(stage_.render(CarelessHost::request()).ok()) << "the next frame is right";
  }
  /// Expects that nothing of the view can be read, with a usage error that names it.
  void expect_no_view(ViewId view) {
    const auto refused = [&](const auto& result, const char* call) {
      ASSERT_FALSE(result.ok()) << call;
      EXPECT_EQ(result.error().kind, ErrorKind::usage) << call;
      EXPECT_EQ(result.error().message.find("view " + std::to_string(view.value) + ":"), 0u) << result.error().message;
    };
    Renderer& renderer = *stage_.renderer;
    refused(renderer.read_picture(view), "read_picture");
    refused(renderer.read_linear(view), "read_linear");
    refused(renderer.read_image(stage_.world, view, "depth"), "read_image");
    refused(renderer.read_geometry(stage_.world, view), "read_geometry");
    refused(renderer.pick(stage_.world, view, 0, 0), "pick");
    refused(renderer.pick_position(stage_.world, view, 0, 0), "pick_position");
  }

  CarelessHost stage_;
};

TEST_F(ViewMisuse, a_dead_camera_is_logged_once) {
  const Entity camera = stage_.world.create(WorldTransform{}, Camera{});
  stage_.world.destroy(camera);
  ViewRequest view = CarelessHost::request(3);
  view.settings.camera_entity = camera;
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(stage_.render(view).ok());
  EXPECT_THAT(stage_.lines, Contains(HasSubstr("view 3 does not follow its camera, because " + text_of(camera))));
  EXPECT_THAT(stage_.lines, Contains(HasSubstr("is not alive")));
  EXPECT_THAT(stage_.lines, SizeIs(1));
}

TEST_F(ViewMisuse, a_camera_without_a_camera_component_or_transform_is_logged) {
  ViewRequest view = CarelessHost::request();
  view.settings.camera_entity = stage_.world.create(WorldTransform{});
  ASSERT_TRUE(stage_.render(view).ok());
  EXPECT_THAT(stage_.lines, Contains(HasSubstr("has no Camera")));
  view.settings.camera_entity = stage_.world.create(LocalTransform{}, Camera{});
  ASSERT_TRUE(stage_.render(view).ok());
  EXPECT_THAT(stage_.lines, Contains(HasSubstr("has no WorldTransform")));
}

TEST_F(ViewMisuse, settings_for_an_entity_that_is_no_camera) {
  const Entity entity = stage_.world.create(WorldTransform{});
  EXPECT_ASSERT((void)settings_for_camera(stage_.world, entity, 64, 40), "has no Camera");
  stage_.world.destroy(entity);
  EXPECT_ASSERT((void)settings_for_camera(stage_.world, entity, 64, 40), "is not alive");
}

TEST_F(ViewMisuse, a_camera_matrix_that_is_not_rigid) {
  ViewRequest view = CarelessHost::request(2);
  view.settings.world_from_camera[3].x = std::numeric_limits<double>::quiet_NaN();
  expect_assert(view, "view 2: ViewSettings::world_from_camera");
  view = CarelessHost::request(2);
  view.settings.world_from_camera[0] *= 2.0;
  expect_assert(view, "view 2: ViewSettings::world_from_camera");
}

TEST_F(ViewMisuse, a_lens_that_no_camera_has) {
  ViewRequest view = CarelessHost::request(2);
  view.settings.camera.fov_y = 0.0f;
  expect_assert(view, "view 2: Camera::fov_y");
  view = CarelessHost::request(2);
  view.settings.camera.near_m = -1.0f;
  expect_assert(view, "view 2: Camera::near_m");
  view = CarelessHost::request(2);
  view.settings.camera.orthographic = true;
  view.settings.camera.half_height_m = std::numeric_limits<float>::quiet_NaN();
  expect_assert(view, "view 2: Camera::half_height_m");
}

TEST_F(ViewMisuse, a_view_without_pixels) { expect_assert(CarelessHost::request(4, 64, 0), "view 4 is 64x0 pixels"); }

TEST_F(ViewMisuse, one_view_twice_in_a_frame) {
  const std::vector<ViewRequest> twice = {CarelessHost::request(5), CarelessHost::request(6), CarelessHost::request(5)};
  EXPECT_ASSERT((void)stage_.renderer->render(stage_.world, twice), "view 5 is requested twice in one frame");
}

TEST_F(ViewMisuse, an_id_that_belongs_to_companions) {
  expect_assert(CarelessHost::request(CompanionViews::kFirstId), "ids from CompanionViews::kFirstId");
}

TEST_F(ViewMisuse, an_unknown_visualizer_is_an_error_that_lists_the_known_ones) {
  ViewRequest view = CarelessHost::request(1);
  view.settings.visualizer = "normals";
  EXPECT_THAT(stage_.error_of(view), HasSubstr("unknown view normals; did you mean normal?"));
}

TEST_F(ViewMisuse, an_unknown_knob_or_value_is_an_error_that_names_it) {
  ViewRequest view = CarelessHost::request(1);
  view.settings.knobs = {{"shadow.mode", "deferred"}};
  EXPECT_THAT(stage_.error_of(view), HasSubstr("unknown knob shadow.mode; did you mean shadows.mode?"));
  view.settings.knobs = {{"shadows.mode", "best"}};
  EXPECT_THAT(stage_.error_of(view), HasSubstr("knob shadows.mode must be one of"));
}

TEST_F(ViewMisuse, a_mirror_whose_normal_is_no_unit_vector) {
  ViewRequest view = CarelessHost::request(1);
  view.settings.mirror = MirrorPlane{.normal = dvec3(0.0, 2.0, 0.0)};
  expect_assert(view, "the normal of a mirror has unit length");
}

TEST_F(ViewMisuse, a_target_of_another_size) {
  ViewRequest view = CarelessHost::request(3, 65, 40);
  view.target.image = stage_.image(color_target);
  expect_assert(view, "view 3 is 65x40 pixels, its target image \"host\" 64x40");
}

TEST_F(ViewMisuse, a_target_of_another_format) {
  ViewRequest view = CarelessHost::request(3);
  view.target.image = stage_.image(color_target, gpu::Format::rgba16_float);
  expect_assert(view, "view 3: a target image is rgba8 or bgra8, UNORM or sRGB, and \"host\" is rgba16_float");
}

TEST_F(ViewMisuse, a_target_whose_usage_does_not_allow_what_is_asked) {
  ViewRequest view = CarelessHost::request(3);
  view.target.image = stage_.image(sampled);
  expect_assert(view, "view 3: the target image \"host\" was made without ImageUsage::color_target");
  view.target.image = stage_.image(color_target);
  view.target.after = gpu::Access::fragment_read;
  expect_assert(view, "the usage of image \"host\" does not allow fragment_read");
  view.target.after = gpu::Access::host_read;
  expect_assert(view, "images have no access host_read");
}

TEST_F(ViewMisuse, a_target_that_was_destroyed) {
  ViewRequest view = CarelessHost::request(3);
  view.target.image = stage_.image(color_target);
  stage_.device->destroy(view.target.image);
  expect_assert(view, "image is not alive");
}

TEST_F(ViewMisuse, a_light_target_beyond_its_image) {
  LightTarget light;
  light.image = stage_.image(color_target | sampled, gpu::Format::rgba16_float);
  ViewRequest view = CarelessHost::request(3);
  light.layer = 1;
  view.target.light = light;
  expect_assert(view, "view 3: LightTarget names mip 0 of layer 1, and its image \"host\" has 1 mips and 1 layers");
  light.layer = 0;
  light.mip = 1;
  view.target.light = light;
  expect_assert(view, "view 3: LightTarget names mip 1 of layer 0");
  light.mip = 0;
  light.image = {};
  view.target.light = light;
  expect_assert(view, "view 3: LightTarget has no image");
  light.image = stage_.image(sampled, gpu::Format::rgba16_float);
  view.target.light = light;
  expect_assert(view, "was made without ImageUsage::color_target");
}

TEST_F(ViewMisuse, a_light_target_beside_a_picture) {
  ViewRequest view = CarelessHost::request(3);
  view.target.image = stage_.image(color_target);
  view.target.light = LightTarget{.image = stage_.image(color_target | sampled, gpu::Format::rgba16_float)};
  expect_assert(view, "view 3: a view has a picture or a LightTarget, not both");
}

TEST_F(ViewMisuse, reading_an_unknown_view) {
  ASSERT_TRUE(stage_.render(CarelessHost::request(1)).ok());
  expect_no_view(ViewId{9});
}

TEST_F(ViewMisuse, reading_a_released_view) {
  const ViewRequest views[] = {CarelessHost::request(1), CarelessHost::request(2)};
  ASSERT_TRUE(stage_.renderer->render(stage_.world, views).ok());
  ASSERT_TRUE(stage_.renderer->read_picture(ViewId{1}).ok());
  stage_.renderer->release_view(ViewId{1});
  expect_no_view(ViewId{1});
  EXPECT_TRUE(stage_.renderer->read_picture(ViewId{2}).ok());
  stage_.renderer->release_world(stage_.world);
  expect_no_view(ViewId{2});
}

TEST_F(ViewMisuse, reading_with_another_world_than_drew_the_view) {
  ASSERT_TRUE(stage_.render(CarelessHost::request(1)).ok());
  World other;
  stage_.renderer->prepare_world(other);
  EXPECT_ASSERT((void)stage_.renderer->read_image(other, ViewId{1}, "depth"), "view 1 was drawn of another world");
}

TEST_F(ViewMisuse, releasing_an_unknown_view_does_nothing) {
  stage_.renderer->release_view(ViewId{77});
  stage_.renderer->release_view(stage_.world, ViewId{77});
  EXPECT_THAT(stage_.lines, IsEmpty());
}

TEST_F(ViewMisuse, a_pixel_or_an_image_that_does_not_exist_is_an_error) {
  ASSERT_TRUE(stage_.render(CarelessHost::request(1)).ok());
  const auto message = [](const auto& result) { return result.ok() ? std::string() : result.error().message; };
  EXPECT_THAT(message(stage_.renderer->pick(stage_.world, ViewId{1}, 64, 0)), HasSubstr("outside the picture"));
  EXPECT_THAT(message(stage_.renderer->pick_position(stage_.world, ViewId{1}, 0, 40)),
              HasSubstr("outside the picture"));
  EXPECT_THAT(message(stage_.renderer->read_image(stage_.world, ViewId{1}, "depths")), HasSubstr("depths"));
}

/// Images of a host's geometry, 64x40 pixels.
HostGeometryDesc geometry_of(CarelessHost& stage) {
  HostGeometryDesc desc;
  desc.depth = stage.image(sampled, gpu::Format::r32_float);
  desc.normals = stage.image(sampled, gpu::Format::rgba16_float);
  desc.base_color = stage.image(sampled);
  desc.material = stage.image(sampled, gpu::Format::rgba8_unorm);
  return desc;
}

TEST_F(ViewMisuse, host_geometry_that_is_missing_of_a_wrong_kind_or_wrongly_described_is_an_error) {
  using Break = void (*)(CarelessHost&, HostGeometryDesc&);
  const std::pair<Break, const char*> cases[] = {
      {[](auto&, auto& d) { d.depth = {}; }, "the image of depth is missing"},
      {[](auto&, auto& d) { d.material = {}; }, "the image of material is missing"},
      {[](auto& s, auto& d) { d.normals = s.image(sampled); }, "the image of normals"},
      {[](auto& s, auto& d) { d.base_color = s.image(color_target); },
       "the image of base colour was not made with ImageUsage::sampled"},
      {[](auto&, auto& d) { d.near_m = 0.0f; }, "near_m must be above 0"},
      {[](auto&, auto& d) { d.far_m = 0.05f; }, "far_m must be 0 (infinitely far) or above near_m"},
      {[](auto&, auto& d) { d.roughness = HostChannel::none; }, "roughness needs a channel"},
  };
  for (const auto& [broken, sentence] : cases) {
    HostGeometryDesc desc = geometry_of(stage_);
    broken(stage_, desc);
    const auto geometry = HostGeometry::create(*stage_.device, desc);
    ASSERT_FALSE(geometry.ok()) << sentence;
    EXPECT_THAT(geometry.error().message, HasSubstr(sentence));
  }
}

TEST_F(ViewMisuse, host_geometry_of_another_size_than_the_view_or_that_is_gone) {
  const HostGeometryDesc desc = geometry_of(stage_);
  ViewRequest view = CarelessHost::request(3, 65, 40);
  view.geometry = HostGeometry::create(*stage_.device, desc).value();
  expect_assert(view, "65x40");
  view = CarelessHost::request(3);
  view.geometry = HostGeometry::create(*stage_.device, desc).value();
  stage_.device->destroy(desc.normals);
  expect_assert(view, "image is not alive");
}

TEST_F(ViewMisuse, scales_of_no_sense) {
  ViewRequest view = CarelessHost::request(3);
  view.settings.heat_range = -1.0f;
  expect_assert(view, "view 3: ViewSettings::heat_range");
  view = CarelessHost::request(3);
  view.settings.aspect = std::numeric_limits<float>::quiet_NaN();
  expect_assert(view, "view 3: ViewSettings::aspect");
  view = CarelessHost::request(3);
  view.settings.lens = LensPoint{.focus_m = 0.0};
  expect_assert(view, "view 3: LensPoint::focus_m");
}

// Hard case: further.size_largest
TEST_F(ViewMisuse, a_view_that_is_too_large_is_an_error) {
  EXPECT_THAT(stage_.error_of(CarelessHost::request(3, 64, 1u << 20)),
              HasSubstr("view 3 is 64x1048576 pixels: a view has at most 16384 a side"));
  EXPECT_TRUE(stage_.render(CarelessHost::request()).ok());
}

TEST_F(ViewMisuse, a_renderer_called_by_its_own_frame) {
  ViewRequest view = CarelessHost::request(1);
  view.target.overlay = [&](FrameGraph&, ImageRef&) { return stage_.render(CarelessHost::request(2)); };
  expect_assert(view, "Renderer::render is called while a frame is being drawn");
  view.target.overlay = [&](FrameGraph&, ImageRef&) {
    stage_.renderer->release_view(ViewId{1});
    return Status();
  };
  expect_assert(view, "Renderer::release_view is called while a frame is being drawn");
}

}  // namespace
}  // namespace gloam
