// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/renderer.h"
#include "modules/fog/components.h"
#include "modules/module_list/module_list.h"
#include "tests/modules/fog/support/fog_oracle.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"
#include "tests/support/stage_test.h"

namespace gloam::test {

/// A renderer of all modules, and a world of glowing quads without other light. The camera is at the origin and looks
/// along −Z.
class FogStage {
 public:
  FogStage() {
    RendererOptions made;
    made.device = device();
    made.executor = executor_.get();
    made.log = &gpu_log();
    made.modules = make_all_modules();
    renderer = value_of(Renderer::create(std::move(made)));
    renderer->prepare_world(world);
    sky(vec3(0.0f));
    view.width = 96;
    view.height = 64;
    view.camera.fov_y = 0.6f;
  }

  void sky(vec3 light) {
    auto& environment = world.resource<SceneEnvironment>();
    environment.sky_zenith = environment.sky_horizon = environment.sky_ground = light;
  }
  /// A glowing square that faces +Z. alpha: below 1 it is blended.
  void glow(const dvec3& at, float half, vec3 light, float alpha = 1.0f) {
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, alpha), .metallic = 0.0f, .roughness = 1.0f};
    material.emissive = light;
    if (alpha < 1.0f) material.alpha_mode = AlphaMode::blend;
    scene.draw(scene.mesh(quad(half, scene.material(material))), glm::translate(dmat4(1.0), at));
  }
  /// Quads at many depths before a sky.
  void fill() {
    sky(vec3(0.3f, 0.5f, 0.9f));
    glow({-0.4, 0.1, -1.2}, 0.08f, vec3(3.0f, 1.0f, 0.2f));
    glow({0.1, 0.2, -3.0}, 0.25f, vec3(1.0f));
    for (int i = 0; i < 5; ++i) glow({-1.5 + 0.7 * i, -0.6 + 0.3 * i, -9.0}, 0.15f, vec3(20.0f, 5.0f, 40.0f));
    glow({0.0, -2.0, -12.0}, 2.0f, vec3(0.05f, 0.1f, 0.2f));
    glow({3.0, 3.0, -60.0}, 9.0f, vec3(0.0f));
  }
  void put(const Fog& values) {
    take_fog();
    fog_ = world.create(values);
  }
  void take_fog() {
    if (world.alive(fog_)) world.destroy(fog_);
  }
  void set(std::string_view knob, std::string_view value) {
    ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob << "=" << value;
  }
  [[nodiscard]] LinearPicture draw() {
    const ViewRequest request{view, {}};
    const Status drawn = renderer->render(world, std::span(&request, 1));
    EXPECT_TRUE(drawn.ok()) << (drawn.ok() ? "" : drawn.error().message);
    return value_of(renderer->read_linear(view.id));
  }
  /// The frame's light without fog.
  [[nodiscard]] LightMap draw_clear() {
    take_fog();
    const LinearPicture clear = draw();
    return light_map(clear.rgba, clear.width, clear.height);
  }
  /// Lengths of the last frame's rays from the camera (orthographic: from its plane) to the surfaces; infinite for sky.
  [[nodiscard]] std::vector<double> distances() {
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, view.id));
    std::vector<double> lengths(geometry.depth.size(), std::numeric_limits<double>::infinity());
    const dvec3 ahead = -dvec3(view.world_from_camera[2]);
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const std::size_t i = std::size_t{y} * view.width + x;
        if (geometry.is_sky(i)) continue;
        const dvec3 position = geometry.position(x, y);
        lengths[i] = view.camera.orthographic ? glm::dot(position, ahead) : glm::length(position);
      }
    return lengths;
  }
  [[nodiscard]] JobExecutor& executor() { return *executor_; }

  /// The tests' device, or null.
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device();
    return made.get();
  }

  World world;
  SceneMaker scene{world};
  std::unique_ptr<Renderer> renderer;
  ViewSettings view;

 private:
  std::unique_ptr<JobExecutor> executor_ = make_pool_executor(2);
  Entity fog_ = kNoEntity;
};

using FogStageTest = StageTest<FogStage>;

/// Half floats have steps of 2⁻¹¹ of their value. The drawn light has gone through four: reduced, blurred twice,
/// blended. A fifth is for the device's exponential function.
inline constexpr double kDrawnSteps = 5.0 / 2048.0;

/// Expects the drawn picture to be this one, within the steps of half floats and, if given, the slack of each pixel.
inline void expect_picture(const LinearPicture& drawn, const std::vector<dvec3>& expected,
                           const std::vector<dvec3>& slack = {}) {
  ASSERT_EQ(drawn.rgba.size(), 4 * expected.size());
  double worst = 0.0;  // error over what is allowed
  std::size_t at = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = static_cast<double>(drawn.rgba[4 * i + static_cast<std::size_t>(c)]);
      const double allowed = kDrawnSteps * (1e-3 + expected[i][c]) + (slack.empty() ? 0.0 : slack[i][c]);
      const double error = std::abs(value - expected[i][c]) / allowed;
      if (!(error <= worst)) {
        worst = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
        at = 3 * i + static_cast<std::size_t>(c);
      }
    }
  EXPECT_LE(worst, 1.0) << "pixel " << at / 3 % drawn.width << ", " << at / 3 / drawn.width << ": drawn "
                        << drawn.rgba[at / 3 * 4 + at % 3] << ", expected "
                        << expected[at / 3][static_cast<int>(at % 3)];
}

/// The mean error of the drawn picture, over the mean of the expected one.
[[nodiscard]] inline double mean_error(const LinearPicture& drawn, const std::vector<dvec3>& expected) {
  double error = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = static_cast<double>(drawn.rgba[4 * i + static_cast<std::size_t>(c)]);
      error += std::abs(value - expected[i][c]);
      sum += expected[i][c];
    }
  return error / sum;
}

}  // namespace gloam::test
