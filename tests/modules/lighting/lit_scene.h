// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/srgb.h"
#include "engine/render/renderer.h"
#include "engine/scene/resources.h"
#include "modules/module_list/module_list.h"
#include "tests/modules/lighting/shading_oracle.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"
#include "tests/support/worse.h"

namespace gloam::test {

/// The device that all tests of this program share.
[[nodiscard]] inline gpu::Device* shared_device() {
  static const std::unique_ptr<gpu::Device> made = make_test_device();
  return made.get();
}

/// A renderer with all modules and one world built in code. Every test must end without validation messages.
class LitSceneTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(shared_device());
    GLOAM_REQUIRE_DEPTH_TESTS(shared_device());
    RendererOptions options;
    options.device = shared_device();
    options.executor = executor.get();
    options.log = &log;
    options.modules = make_modules();
    renderer = value_of(Renderer::create(std::move(options)));
    if (!with_shadows() && renderer->knobs().find("shadows.mode") != nullptr) {
      EXPECT_TRUE(renderer->knobs().set("shadows.mode", "off").ok());
    }
    renderer->prepare_world(world);
    settings.width = 61;
    settings.height = 43;
  }
  /// Shadows have separate suites; in other tests they would only cost time.
  [[nodiscard]] virtual bool with_shadows() const { return false; }
  /// The modules of the renderer.
  [[nodiscard]] virtual ModuleList make_modules() { return make_all_modules(); }
  void TearDown() override {
    renderer.reset();
    if (shared_device() != nullptr) {
      EXPECT_EQ(shared_device()->validation_messages(), 0u);
    }
  }

  Entity light(const Light& what, const dvec3& position, const dvec3& direction = dvec3(0.0, 0.0, -1.0)) {
    dmat4 matrix(1.0);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), z));
    matrix[0] = dvec4(x, 0.0);
    matrix[1] = dvec4(glm::cross(z, x), 0.0);
    matrix[2] = dvec4(z, 0.0);
    matrix[3] = dvec4(position, 1.0);
    oracle_lights.push_back({what, position, -z});
    return world.create(what, WorldTransform{matrix});
  }

  /// Draws the view once and waits.
  void draw() { draw(world, settings); }
  void draw(World& what, const ViewSettings& view) {
    const ViewRequest request{view, {}};
    const Status drawn = renderer->render(what, std::span(&request, 1));
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    ASSERT_TRUE(renderer->wait().ok());
  }
  [[nodiscard]] LinearPicture linear(std::uint32_t view = 0) { return value_of(renderer->read_linear(ViewId{view})); }
  [[nodiscard]] Picture picture(std::uint32_t view = 0) { return value_of(renderer->read_picture(ViewId{view})); }

  /// A material whose values an 8-bit geometry buffer stores exactly.
  [[nodiscard]] static Material exact_material(std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t roughness,
                                               std::uint8_t metallic) {
    const auto channel = [](std::uint8_t c) { return static_cast<float>(srgb_to_linear(c / 255.0)); };
    Material material;
    material.base_color = vec4(channel(r), channel(g), channel(b), 1.0f);
    material.roughness = static_cast<float>(roughness) / 255.0f;
    material.metallic = static_cast<float>(metallic) / 255.0f;
    return material;
  }

  /// Origin and unit direction of the ray through a pixel's centre.
  struct Ray {
    dvec3 origin;
    dvec3 direction;
  };
  [[nodiscard]] Ray ray(std::uint32_t x, std::uint32_t y) const {
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const double u = (2.0 * (x + 0.5) / settings.width - 1.0) * aspect;
    const double v = 1.0 - 2.0 * (y + 0.5) / settings.height;
    const dmat4& m = settings.world_from_camera;
    if (settings.camera.orthographic) {
      const double half = static_cast<double>(settings.camera.half_height_m);
      return {dvec3(m * dvec4(u * half, v * half, 0.0, 1.0)), -dvec3(m[2])};
    }
    const double slope = std::tan(0.5 * static_cast<double>(settings.camera.fov_y));
    return {dvec3(m[3]), glm::normalize(dvec3(m * dvec4(u * slope, v * slope, -1.0, 0.0)))};
  }

  /// The point where a ray meets the plane z = `at`, as a surface of this material.
  [[nodiscard]] static OracleSurface plane_surface(const Ray& r, double at, const Material& material) {
    OracleSurface s;
    s.position = r.origin + r.direction * ((at - r.origin.z) / r.direction.z);
    s.to_eye = -r.direction;
    s.base_color = dvec3(material.base_color);
    s.metallic = static_cast<double>(material.metallic);
    s.roughness = static_cast<double>(material.roughness);
    return s;
  }

  [[nodiscard]] static dvec3 pixel(const LinearPicture& p, std::uint32_t x, std::uint32_t y) {
    const float* at = &p.rgba[(std::size_t{y} * p.width + x) * 4];
    return {at[0], at[1], at[2]};
  }
  /// Relative difference of the worst channel; infinite where there is a NaN. Values below a thousandth of the
  /// brightest channel count as that much.
  [[nodiscard]] static double relative_error(const dvec3& actual, const dvec3& expected, double brightest) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c)
      worst = worse(worst, std::abs(actual[c] - expected[c]) / std::max(expected[c], 1e-3 * brightest));
    return worst;
  }

  [[nodiscard]] SceneEnvironment& environment() { return world.resource<SceneEnvironment>(); }
  [[nodiscard]] ModuleState module_state(std::string_view name) const {
    for (const ModuleState& state : renderer->report().modules)
      if (state.name == name) return state;
    ADD_FAILURE() << "no module " << name;
    return {};
  }

  std::vector<std::string> warnings;
  FunctionLog log{[this](LogLevel level, std::string_view line) {
    if (level >= LogLevel::warning) warnings.emplace_back(line);
  }};
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
  SceneMaker scene{world};
  ViewSettings settings = look_at(dvec3(0.4, 0.3, 3.0), dvec3(0.0, 0.0, 0.0), 61, 43);
  std::vector<OracleLight> oracle_lights;
};

}  // namespace gloam::test
