// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/references.h"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

#include "modules/depth_of_field/components.h"
#include "modules/fog/module.h"
#include "tests/modules/fog/support/fog_stage.h"

namespace gloam::test {
namespace {

class FogReferences : public FogStageTest {
 protected:
  /// The stage's last frame, judged by the module's reference.
  static Result<FramePictures> judged(FogStage& stage) {
    const FramePictures frame = read(stage);
    const GeometryPicture geometry = value_of(stage.renderer->read_geometry(stage.world, stage.view.id));
    const auto redraw = [&stage](const auto& change, const auto& restore) -> Result<FramePictures> {
      change(stage.world);
      static_cast<void>(stage.draw());
      FramePictures drawn = read(stage);
      restore(stage.world);
      return drawn;
    };
    return draw_fog_reference({.world = stage.world,
                               .view = stage.world.view_resource<RenderView>(stage.view.id),
                               .knobs = stage.renderer->knobs(),
                               .frame = frame,
                               .samples = 1,
                               .executor = stage.executor(),
                               .geometry = &geometry,
                               .redraw = redraw});
  }
  static FramePictures read(FogStage& stage) {
    return {value_of(stage.renderer->read_linear(stage.view.id)),
            value_of(stage.renderer->read_picture(stage.view.id))};
  }
  static std::vector<dvec3> light_of(const LinearPicture& picture) {
    return light_map(picture.rgba, picture.width, picture.height).texels;
  }
};

TEST_F(FogReferences, judge_every_knob_of_the_module) {
  const auto module = make_fog_module();
  KnobRegistry knobs;
  module->knobs(knobs);
  std::vector<std::string> judged, declared;
  for (const ReferenceInfo& reference : module->references()) judged.push_back(reference.knob);
  for (const Knob& knob : knobs.knobs()) declared.push_back(knob.name);
  EXPECT_THAT(judged, ::testing::UnorderedElementsAreArray(declared));
}

TEST_F(FogReferences, are_the_integral_along_each_ray) {
  FogStage stage;
  stage.fill();
  stage.view.width = 127;
  stage.view.height = 71;
  const Fog fog{0.05f, vec3(0.2f, 0.1f, 0.4f)};
  const LightMap clear = stage.draw_clear();
  const std::vector<double> distances = stage.distances();
  stage.put(fog);
  const LinearPicture drawn = stage.draw();
  const FramePictures reference = value_of(judged(stage));
  const std::vector<dvec3> exact = oracle_picture(clear, distances, fog);
  expect_picture(reference.linear, exact);
  EXPECT_GT(mean_error(drawn, exact), 3.0 * mean_error(reference.linear, exact)) << "the knobs' defaults have an error";
  EXPECT_FALSE(reference.picture.rgba.empty());
  EXPECT_TRUE(stage.draw().rgba == drawn.rgba) << "a reference leaves later frames alone";
}

// Depth of field blurs the light with fog: the reference has to go through it as the frame does.
TEST_F(FogReferences, are_seen_through_the_lens) {
  FogStage stage;
  stage.fill();
  stage.view.camera_entity = stage.world.create(WorldTransform{}, stage.view.camera, DepthOfField{3.0f, 1.0f});
  stage.put({0.05f, vec3(0.2f, 0.1f, 0.4f)});
  stage.set("fog.resolution", "full");
  stage.set("fog.radius", "6");
  const LinearPicture drawn = stage.draw();
  const FramePictures reference = value_of(judged(stage));
  EXPECT_LT(mean_error(drawn, light_of(reference.linear)), 2e-3);
  stage.set("fog.resolution", "quarter");
  stage.set("fog.radius", "0.5");
  EXPECT_GT(mean_error(stage.draw(), light_of(reference.linear)), 4e-3);
}

TEST_F(FogReferences, need_geometry_and_a_frame_that_can_be_drawn_again) {
  FogStage stage;
  stage.put({0.05f, vec3(1.0f)});
  static_cast<void>(stage.draw());
  const FramePictures frame = read(stage);
  const ReferenceInput input{.world = stage.world,
                             .view = stage.world.view_resource<RenderView>(stage.view.id),
                             .knobs = stage.renderer->knobs(),
                             .frame = frame,
                             .samples = 1,
                             .executor = stage.executor()};
  EXPECT_FALSE(draw_fog_reference(input).ok());
}

}  // namespace
}  // namespace gloam::test
