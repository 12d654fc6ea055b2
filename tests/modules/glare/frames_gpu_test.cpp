// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/render/renderer.h"
#include "modules/glare/components.h"
#include "modules/glare/reference/glare_reference.h"
#include "modules/glare/reference/spread_light.h"
#include "modules/lighting/outputs.h"
#include "modules/module_list/module_list.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"
#include "tests/support/stage_test.h"

namespace gloam::test {
namespace {

/// A renderer of all modules, and lamps before a dim sky.
class GlareStage {
 public:
  GlareStage() {
    RendererOptions made;
    made.device = device();
    made.executor = executor.get();
    made.log = &gpu_log();
    made.modules = make_all_modules();
    renderer = value_of(Renderer::create(std::move(made)));
    renderer->prepare_world(world);
    auto& environment = world.resource<SceneEnvironment>();
    environment.sky_zenith = environment.sky_horizon = environment.sky_ground = vec3(0.02f, 0.03f, 0.05f);
    lamp({-0.9, 0.3, -4.0}, 0.06f, vec3(900.0f, 500.0f, 100.0f));
    lamp({0.8, -0.2, -4.0}, 0.2f, vec3(3.0f, 9.0f, 20.0f));
    lamp({0.1, 0.6, -6.0}, 0.03f, vec3(20000.0f));
    view.width = 320;
    view.height = 180;
    view.camera.fov_y = 0.6f;
    set("lighting.dither", "off");
  }
  void lamp(const dvec3& at, float half, vec3 light) {
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
    material.emissive = light;
    scene.draw(scene.mesh(quad(half, scene.material(material))), glm::translate(dmat4(1.0), at));
  }
  void set(const char* knob, const char* value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()); }
  void glare(float share) { world.set_resource(DefaultGlare{share}); }
  /// Draws a frame. Its light before the glare, in the world's ShownLight after it.
  LinearPicture draw() {
    const ViewRequest request{view, {}};
    const Status drawn = renderer->render(world, std::span(&request, 1));
    EXPECT_TRUE(drawn.ok()) << (drawn.ok() ? "" : drawn.error().message);
    return value_of(renderer->read_linear(view.id));
  }
  Picture picture() { return value_of(renderer->read_picture(view.id)); }
  [[nodiscard]] std::vector<std::string> passes() const {
    std::vector<std::string> names;
    for (const PassTime& pass : renderer->report().passes)
      if (pass.module == "glare") names.push_back(pass.name);
    return names;
  }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device();
    return made.get();
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  World world;
  SceneMaker scene{world};
  std::unique_ptr<Renderer> renderer;
  ViewSettings view;
};

class GlareFrames : public StageTest<GlareStage> {
 protected:
  static void expect_sum(const LinearPicture& shown, const LinearPicture& light, double share) {
    std::vector<vec4> texels(light.rgba.size() / 4);
    for (std::size_t i = 0; i < texels.size(); ++i)
      texels[i] = {light.rgba[4 * i], light.rgba[4 * i + 1], light.rgba[4 * i + 2], 1.0f};
    const std::vector<dvec3> spread = spread_light(texels, {light.width, light.height}, *make_serial_executor(), 1e30);
    double apart = 0.0, glow = 0.0;
    for (std::size_t i = 0; i < texels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double scattered = share * spread[i][c];
        const double expected = (1.0 - share) * static_cast<double>(texels[i][c]) + scattered;
        const double error = std::abs(static_cast<double>(shown.rgba[4 * i + static_cast<std::size_t>(c)]) - expected);
        // The sharp light is rounded to half floats.
        ASSERT_LE(error, 0.4 * scattered + 1e-3 * expected) << i << ": " << expected;
        apart += std::max(error - 1e-3 * expected, 0.0);
        glow += scattered;
      }
    EXPECT_LT(apart, 0.05 * glow);
  }
};

TEST_F(GlareFrames, without_glare_are_those_without_the_module) {
  GlareStage stage;
  stage.view.without = {"glare"};
  const LinearPicture light = stage.draw();
  const Picture picture = stage.picture();
  stage.view.without = {};
  for (const float share : {0.0f, -1.0f}) {
    stage.glare(share);
    EXPECT_EQ(stage.draw().rgba, light.rgba);
    EXPECT_EQ(stage.picture().rgba, picture.rgba);
    EXPECT_THAT(stage.passes(), testing::IsEmpty());
  }
  stage.glare(0.1f);
  static_cast<void>(stage.draw());
  EXPECT_NE(stage.picture().rgba, picture.rgba);
  EXPECT_THAT(stage.passes(), testing::Not(testing::IsEmpty()));
  stage.set("glare.lines", "off");
  EXPECT_EQ(stage.draw().rgba, light.rgba);
  EXPECT_EQ(stage.picture().rgba, picture.rgba);
  EXPECT_THAT(stage.passes(), testing::IsEmpty());
}

TEST_F(GlareFrames, keep_the_light_that_comes_to_the_lens) {
  GlareStage stage;
  const LinearPicture light = stage.draw();
  stage.glare(0.2f);
  EXPECT_EQ(stage.draw().rgba, light.rgba);
}

TEST_F(GlareFrames, show_the_sum_of_sharp_and_spread_light) {
  GlareStage stage;
  const LinearPicture light = stage.draw();
  stage.world.set_resource(ShownLight{});
  EXPECT_EQ(stage.draw().rgba, light.rgba);
  for (const float share : {0.001f, 0.02f, 0.2f}) {
    stage.glare(share);
    expect_sum(stage.draw(), light, static_cast<double>(share));
  }
  stage.glare(5.0f);
  expect_sum(stage.draw(), light, 0.2);
}

// The curve is a clamp; exposure is set, or metered from the light that is shown.
TEST_F(GlareFrames, have_pictures_of_the_light_that_is_shown) {
  GlareStage stage;
  stage.set("lighting.tone_map", "linear");
  stage.glare(0.1f);
  stage.world.set_resource(ShownLight{});
  auto& environment = stage.world.resource<SceneEnvironment>();
  environment.has_exposure = true;
  environment.exposure_ev100 = 1.0f;
  const LinearPicture shown = stage.draw();
  const Picture picture = stage.picture();
  int partly = 0;
  for (std::size_t i = 0; i < shown.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const double exposed = static_cast<double>(shown.rgba[i]) / 2.4;
    const double expected = 255.0 * linear_to_srgb(std::clamp(exposed, 0.0, 1.0));
    ASSERT_NEAR(picture.rgba[i], expected, 1.0) << i;
    partly += exposed > 0.05 && exposed < 0.95 ? 1 : 0;
  }
  EXPECT_GT(partly, 100);
}

// A lamp before a black background is exposed as without glare, although its glow lights the background.
// Hard case: glare.exposure
TEST_F(GlareFrames, without_a_set_exposure_are_exposed_as_without_glare) {
  GlareStage stage;
  auto& environment = stage.world.resource<SceneEnvironment>();
  environment.sky_zenith = environment.sky_horizon = environment.sky_ground = vec3(0.0f);
  stage.set("lighting.tone_map", "linear");
  const auto mean_exposed = [&](float share) {
    stage.glare(share);
    stage.view.camera_entity = stage.world.create();  // a camera is metered in its first frame
    stage.view.follow_camera = false;
    const LinearPicture light = stage.draw();
    const Picture picture = stage.picture();
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 2; i < light.rgba.size(); i += 4) {
      const double shown = srgb_to_linear(picture.rgba[i] / 255.0);
      if (!(light.rgba[i] > 1.0f) || shown > 0.99) continue;
      sum += shown / static_cast<double>(light.rgba[i]);
      ++count;
    }
    EXPECT_GT(count, 50);
    return sum / count;
  };
  const double without = mean_exposed(0.0f);
  EXPECT_NEAR(mean_exposed(0.02f) / without, 1.0, 0.05);
}

/// ReferenceInput::redraw for the stage's view without a visualizer.
std::function<Result<FramePictures>(const std::function<void(World&)>&, const std::function<void(World&)>&)> redraw_of(
    GlareStage& stage) {
  return [&stage](const auto& change, const auto& restore) -> Result<FramePictures> {
    change(stage.world);
    const LinearPicture light = stage.draw();
    FramePictures drawn{light, stage.picture()};
    restore(stage.world);
    return drawn;
  };
}

ReferenceInput input_of(GlareStage& stage, const FramePictures& frame) {
  return {.world = stage.world,
          .view = stage.world.view_resource<RenderView>(stage.view.id),
          .knobs = stage.renderer->knobs(),
          .frame = frame,
          .samples = 1,
          .executor = *stage.executor,
          .redraw = redraw_of(stage)};
}

// The sum of sharp and spread light is exact to the steps of half floats.
TEST_F(GlareFrames, of_the_view_glare_reference_show_the_convolution) {
  GlareStage stage;
  stage.set("lighting.tone_map", "linear");
  stage.glare(0.1f);
  auto& environment = stage.world.resource<SceneEnvironment>();
  environment.has_exposure = true;
  environment.exposure_ev100 = 1.0f;
  const LinearPicture light = stage.draw();
  const Picture drawn = stage.picture();
  std::vector<vec4> texels(light.rgba.size() / 4);
  for (std::size_t i = 0; i < texels.size(); ++i)
    texels[i] = {light.rgba[4 * i], light.rgba[4 * i + 1], light.rgba[4 * i + 2], 1.0f};
  const std::vector<dvec3> spread = spread_light(texels, {light.width, light.height}, *stage.executor, 1e30);
  for (const VisualizerInfo& view : stage.renderer->visualizers()) {
    if (view.name != "glare_reference") continue;
    ASSERT_TRUE(view.trace(stage.world, input_of(stage, {})).ok());
  }
  stage.view.visualizer = "glare_reference";
  EXPECT_EQ(stage.draw().rgba, light.rgba) << "the light that comes to the lens is the same";
  const Picture shown = stage.picture();
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double sum = 0.9 * static_cast<double>(texels[i][c]) + 0.1 * spread[i][c];
      const double expected = 255.0 * linear_to_srgb(std::clamp(sum / 2.4, 0.0, 1.0));
      ASSERT_NEAR(shown.rgba[4 * i + static_cast<std::size_t>(c)], expected, 1.0) << i;
    }
  EXPECT_NE(shown.rgba, drawn.rgba) << "the passes approximate the convolution";
}

// The reference's own exposure must not count against a knob.
// Hard case: glare.reference_exposure
TEST_F(GlareFrames, of_the_reference_are_exposed_as_the_frame) {
  GlareStage stage;
  auto& environment = stage.world.resource<SceneEnvironment>();
  environment.sky_zenith = environment.sky_horizon = environment.sky_ground = vec3(0.0f);
  stage.set("lighting.exposure", "metered");
  stage.glare(0.02f);
  LinearPicture light = stage.draw();
  const FramePictures frame{light, stage.picture()};
  const FramePictures reference = value_of(glare_reference().draw(input_of(stage, frame)));
  // The pixels of the larger lamp, where the glow is small beside the light.
  int lamp = 0;
  for (std::size_t i = 1; i < light.rgba.size(); i += 4) {
    if (light.rgba[i] < 8.0f || light.rgba[i] > 10.0f) continue;
    ASSERT_NEAR(reference.picture.rgba[i], frame.picture.rgba[i], 2.0) << i;
    ++lamp;
  }
  EXPECT_GT(lamp, 50);
}

// Hard case: glare.orthographic
TEST_F(GlareFrames, of_orthographic_cameras_have_the_same_glare) {
  GlareStage stage;
  stage.view.camera.orthographic = true;
  stage.view.camera.half_width_m = 2.0f;
  stage.view.camera.half_height_m = 1.125f;
  const LinearPicture light = stage.draw();
  stage.world.set_resource(ShownLight{});
  stage.glare(0.1f);
  expect_sum(stage.draw(), light, 0.1);
}

TEST_F(GlareFrames, of_several_views_have_each_camera_s_own) {
  GlareStage stage;
  const LinearPicture light = stage.draw();
  stage.glare(0.02f);
  stage.world.set_resource(ShownLight{});
  std::vector<ViewRequest> requests;
  for (std::uint32_t i = 0; i < 3; ++i) {
    ViewSettings settings = stage.view;
    settings.id = ViewId{i};
    settings.follow_camera = false;
    if (i > 0) settings.camera_entity = stage.world.create(Glare{i == 1 ? 0.0f : 0.2f});
    requests.push_back({settings, {}});
  }
  ASSERT_TRUE(stage.renderer->render(stage.world, requests).ok());
  expect_sum(value_of(stage.renderer->read_linear(ViewId{0})), light, 0.02);
  EXPECT_EQ(value_of(stage.renderer->read_linear(ViewId{1})).rgba, light.rgba);
  expect_sum(value_of(stage.renderer->read_linear(ViewId{2})), light, 0.2);
}

TEST_F(GlareFrames, of_captures_have_none) {
  GlareStage stage;
  stage.view.purpose = ViewPurpose::capture;
  stage.glare(0.2f);
  static_cast<void>(stage.draw());
  EXPECT_THAT(stage.passes(), testing::IsEmpty());
}

TEST_F(GlareFrames, free_all_memory_when_the_glare_is_gone) {
  GlareStage stage;
  stage.glare(0.1f);
  static_cast<void>(stage.draw());
  EXPECT_THAT(stage.passes(), testing::Not(testing::IsEmpty()));
  stage.glare(0.0f);
  for (int i = 0; i < 130; ++i) static_cast<void>(stage.draw());
  for (const ModuleState& module : stage.renderer->report().modules) {
    if (module.name != "glare") continue;
    EXPECT_EQ(module.gpu_bytes, 0u);
    EXPECT_EQ(module.pipelines, 0u);
    EXPECT_FALSE(module.demanded);
  }
}

// A light of 1e9 cd/m² in one pixel.
// Hard case: glare.not_finite
TEST_F(GlareFrames, with_a_lamp_of_1e9_are_finite) {
  GlareStage stage;
  stage.lamp({0.3, 0.1, -5.0}, 0.03f, vec3(1e9f));
  stage.glare(0.2f);
  stage.world.set_resource(ShownLight{});
  float most = 0.0f;
  for (const float value : stage.draw().rgba) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
    most = std::max(most, value);
  }
  EXPECT_GT(most, 1e5f);
}

}  // namespace
}  // namespace gloam::test
