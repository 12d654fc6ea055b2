// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/references.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "modules/accuracy/module.h"
#include "modules/depth_of_field/components.h"
#include "modules/fog/module.h"
#include "modules/lights/components.h"
#include "tests/modules/fog/support/fog_stage.h"

namespace gloam::test {
namespace {

class FogReferences : public FogStageTest {
 protected:
  /// Calls a reference with the stage's last frame.
  template <class Draw>
  static auto with_input(FogStage& stage, const Draw& draw) {
    const FramePictures frame = read(stage);
    const GeometryPicture geometry = value_of(stage.renderer->read_geometry(stage.world, stage.view.id));
    const auto tracer = value_of(make_scene_tracer(stage.world, stage.executor(), geometry.view.position));
    const auto redraw = [&stage](const auto& change, const auto& restore) -> Result<FramePictures> {
      change(stage.world);
      static_cast<void>(stage.draw());
      FramePictures drawn = read(stage);
      restore(stage.world);
      return drawn;
    };
    return draw({.world = stage.world,
                 .view = stage.world.view_resource<RenderView>(stage.view.id),
                 .knobs = stage.renderer->knobs(),
                 .frame = frame,
                 .samples = 64,
                 .executor = stage.executor(),
                 .tracer = tracer.get(),
                 .geometry = &geometry,
                 .redraw = redraw});
  }
  /// The stage's last frame, judged by the module's reference.
  static Result<FramePictures> judged(FogStage& stage) { return with_input(stage, draw_fog_reference); }
  static LinearPicture marched(FogStage& stage) { return value_of(with_input(stage, march_fog)); }
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

constexpr dvec3 kLamp(-0.2, 0.3, -3.0);

/// Whether the square around (0.4, 0, −4) with sides of 1 m hides the lamp from a point.
bool hides_lamp(const dvec3& point) {
  if (point.z >= -4.0) return false;
  const dvec3 at = glm::mix(kLamp, point, (-4.0 - kLamp.z) / (point.z - kLamp.z));
  return std::abs(at.x - 0.4) < 0.5 && std::abs(at.y) < 0.5;
}

/// Light of a point lamp of 30 cd with a range of 100 m that even fog scatters from a ray, by the midpoint rule.
double scattered_from(const dvec3& start, const dvec3& direction, double length, double density) {
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = length * (i + 0.5) / kSteps, d = glm::length(start + t * direction - kLamp);
    if (hides_lamp(start + t * direction)) continue;
    sum += 30.0 * (1.0 - std::pow(d / 100.0, 4.0)) / (d * d) * std::exp(-density * (t + d));
  }
  return 0.5 * density / (4.0 * 3.14159265358979323846) * sum * length / kSteps;
}

TEST_F(FogReferences, march_light_of_lamps_along_the_ray_of_each_pixel) {
  for (const bool orthographic : {false, true}) {
    FogStage stage;
    stage.view.camera.orthographic = orthographic;
    stage.view.camera.half_width_m = 3.0f;
    stage.view.camera.half_height_m = 2.0f;
    stage.glow({0.4, 0.0, -4.0}, 0.5f, vec3(0.1f));
    const Fog fog{.density = 0.05f, .sky_distance_m = 50.0f};
    stage.put(fog);
    stage.world.create(WorldTransform{glm::translate(dmat4(1.0), kLamp)},
                       Light{.kind = LightKind::point, .intensity = 30.0f, .range_m = 100.0f});
    static_cast<void>(stage.draw());
    const std::vector<double> distances = stage.distances();
    const LinearPicture without = value_of(judged(stage)).linear, with = marched(stage);
    double found = 0.0, exact = 0.0;
    for (std::uint32_t y = 0; y < with.height; ++y)
      for (std::uint32_t x = 0; x < with.width; ++x) {
        const std::size_t i = std::size_t{y} * with.width + x;
        const double right = (2.0 * (x + 0.5) / with.width - 1.0), up = 1.0 - 2.0 * (y + 0.5) / with.height;
        const double slope = std::tan(0.3);
        const dvec3 start = orthographic ? dvec3(3.0 * right, 2.0 * up, 0.0) : dvec3(0.0);
        const dvec3 ray = orthographic
                              ? dvec3(0.0, 0.0, -1.0)
                              : glm::normalize(dvec3(right * slope * with.width / with.height, up * slope, -1.0));
        const double expected = scattered_from(start, ray, std::min(distances[i], 50.0), 0.05);
        const double added = static_cast<double>(with.rgba[4 * i]) - static_cast<double>(without.rgba[4 * i]);
        ASSERT_NEAR(added, expected, 0.1 * expected + 2e-4) << x << ", " << y;
        found += added;
        exact += expected;
      }
    EXPECT_NEAR(found, exact, 5e-3 * exact);
  }
}

TEST_F(FogReferences, march_what_the_pairs_give_if_no_lamp_shines) {
  FogStage stage;
  stage.fill();
  stage.put({0.05f, vec3(0.2f, 0.1f, 0.4f)});
  static_cast<void>(stage.draw());
  const LinearPicture expected = value_of(judged(stage)).linear, found = marched(stage);
  for (std::size_t i = 0; i < found.rgba.size(); ++i)
    ASSERT_NEAR(found.rgba[i], expected.rgba[i], kDrawnSteps * (1e-3 + static_cast<double>(expected.rgba[i])));
}

TEST_F(FogReferences, march_the_frame_itself_without_fog) {
  FogStage stage;
  stage.fill();
  stage.world.create(WorldTransform{}, Light{.kind = LightKind::point, .intensity = 30.0f, .range_m = 100.0f});
  const LinearPicture clear = stage.draw();
  EXPECT_EQ(marched(stage).rgba, clear.rgba);
  stage.put({0.0f, vec3(1.0f)});
  static_cast<void>(stage.draw());
  EXPECT_EQ(marched(stage).rgba, clear.rgba);
}

// A head near the camera before a far bright wall, both lit: beside the head, the wall is at most brighter by the glow
// of the head's short way than it is without the head.
// Hard case: fog.marched_rim
TEST_F(FogReferences, march_no_rim_around_a_near_head_before_a_far_bright_wall) {
  FogStage stage;
  stage.glow({0.0, 0.0, -50.0}, 100.0f, vec3(4.0f));
  stage.world.create(WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 20.0, -45.0))},
                     Light{.kind = LightKind::point, .intensity = 500.0f, .range_m = 100.0f});
  stage.put({0.02f, vec3(0.0f)});
  static_cast<void>(stage.draw());
  const LinearPicture alone = marched(stage);
  stage.glow({0.0, 0.0, -0.5}, 0.06f, vec3(0.2f));
  static_cast<void>(stage.draw());
  const std::vector<double> distances = stage.distances();
  const LinearPicture found = marched(stage);
  std::size_t wall = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] < 1.0) continue;
    ++wall;
    const double glow = 0.5 * 0.2 * (1.0 - std::exp(-0.02 * 0.51));
    const auto before = static_cast<double>(alone.rgba[4 * i]);
    ASSERT_LT(static_cast<double>(found.rgba[4 * i]), before + glow + 1e-3 * before) << i;
  }
  EXPECT_GT(wall, distances.size() / 2);
  EXPECT_LT(wall, distances.size());
}

TEST_F(FogReferences, are_shown_by_the_view_fog_reference) {
  FogStage stage;
  stage.fill();
  stage.put({0.05f, vec3(0.2f, 0.1f, 0.4f)});
  stage.world.create(WorldTransform{glm::translate(dmat4(1.0), dvec3(-0.2, 0.3, -3.0))},
                     Light{.kind = LightKind::point, .intensity = 30.0f, .range_m = 100.0f});
  static_cast<void>(stage.draw());
  const LinearPicture expected = marched(stage);
  for (const VisualizerInfo& view : stage.renderer->visualizers()) {
    if (view.name != "fog_reference") continue;
    const Status traced =
        with_input(stage, [&](const ReferenceInput& input) { return view.trace(stage.world, input); });
    ASSERT_TRUE(traced.ok());
  }
  stage.view.visualizer = "fog_reference";
  const LinearPicture shown = stage.draw();
  for (std::size_t i = 0; i < shown.rgba.size(); ++i)
    ASSERT_NEAR(shown.rgba[i], expected.rgba[i], (1e-3 + static_cast<double>(expected.rgba[i])) / 2048.0) << i;
}

TEST_F(FogReferences, march_only_with_triangles) {
  FogStage stage;
  stage.put({0.05f, vec3(1.0f)});
  static_cast<void>(stage.draw());
  const auto failed = with_input(stage, [](ReferenceInput input) {
    input.tracer = nullptr;
    return march_fog(input);
  });
  EXPECT_FALSE(failed.ok());
}

}  // namespace
}  // namespace gloam::test
