// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "modules/module_list/module_list.h"
#include "tests/render/draws/small_scene.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// The device that all tests of this program share.
[[nodiscard]] inline gpu::Device* drawing_device() {
  static const std::unique_ptr<gpu::Device> made = make_test_device();
  return made.get();
}

/// Facts from Renderer::pick about a pixel.
struct Picked {
  bool sky = false;
  double depth_m = 0.0;
  dvec3 base_color = dvec3(0.0);
  bool subsurface = false;
  dvec3 normal = dvec3(0.0);
  dvec3 face_normal = dvec3(0.0);
  dvec3 roughness_metallic_occlusion = dvec3(0.0);
};

[[nodiscard]] inline Picked parse_picked(const std::vector<std::string>& lines) {
  Picked p;
  if (lines.size() > 1 && lines[1] == "sky") {
    p.sky = true;
    return p;
  }
  const auto line = [&](std::size_t i) { return i < lines.size() ? lines[i].c_str() : ""; };
  dvec3& c = p.base_color;
  dvec3& n = p.normal;
  dvec3& f = p.face_normal;
  dvec3& r = p.roughness_metallic_occlusion;
  EXPECT_EQ(std::sscanf(line(1), "view depth %lf m", &p.depth_m), 1) << line(1);
  EXPECT_EQ(std::sscanf(line(2), "base colour %lf %lf %lf", &c.x, &c.y, &c.z), 3) << line(2);
  p.subsurface = std::string_view(line(2)).find("subsurface") != std::string_view::npos;
  EXPECT_EQ(std::sscanf(line(3), "normal %lf %lf %lf, face normal %lf %lf %lf", &n.x, &n.y, &n.z, &f.x, &f.y, &f.z), 6)
      << line(3);
  EXPECT_EQ(std::sscanf(line(4), "roughness, metallic, occlusion %lf %lf %lf", &r.x, &r.y, &r.z), 3) << line(4);
  return p;
}

/// A renderer with all modules and optionally one more, and its own world.
struct Stage {
  explicit Stage(std::unique_ptr<Module> more = nullptr) {
    RendererOptions options;
    options.device = drawing_device();
    options.executor = executor.get();
    options.log = &gpu_log();
    options.modules = make_all_modules();
    if (more != nullptr) options.modules.push_back(std::move(more));
    renderer = value_of(Renderer::create(std::move(options)));
    renderer->prepare_world(world);
    world.resource<SceneEnvironment>().has_exposure = true;  // makes pictures of different scenes comparable
  }
  [[nodiscard]] ViewRequest request(std::uint32_t id = 0) const {
    ViewRequest made;
    made.settings = settings;
    made.settings.id = ViewId{id};
    return made;
  }
  void render() { render({request()}); }
  void render(const std::vector<ViewRequest>& requests) {
    const Status status = renderer->render(world, requests);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  [[nodiscard]] Picture picture(std::uint32_t id = 0) { return value_of(renderer->read_picture(ViewId{id})); }
  [[nodiscard]] LinearPicture linear(std::uint32_t id = 0) { return value_of(renderer->read_linear(ViewId{id})); }
  [[nodiscard]] Picture drawn() {
    render();
    return picture();
  }
  [[nodiscard]] Picked pick(std::uint32_t x, std::uint32_t y) {
    return parse_picked(value_of(renderer->pick(world, ViewId{0}, x, y)));
  }
  /// Draws a frame and picks its middle pixel.
  [[nodiscard]] Picked pick_middle() {
    render();
    return pick(settings.width / 2, settings.height / 2);
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
  SceneMaker scene{world};
  ViewSettings settings =
      look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 33, 33);  ///< the middle pixel's centre is straight ahead
};

/// Base of tests that draw. Each must end without validation messages.
class DrawingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(drawing_device());
    stage = std::make_unique<Stage>();
  }
  void TearDown() override {
    stage.reset();
    if (drawing_device() != nullptr) {
      EXPECT_EQ(drawing_device()->validation_messages(), 0u);
    }
  }
  std::unique_ptr<Stage> stage;
};

struct Rgba {
  int r, g, b, a;
  bool operator==(const Rgba&) const = default;
};

[[nodiscard]] inline Rgba texel_of(const Picture& picture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* t = picture.rgba.data() + 4 * (std::size_t{y} * picture.width + x);
  return {t[0], t[1], t[2], t[3]};
}

/// CPU twin of rasterisation with a depth test: the first triangle that the ray through a pixel hits. corners: three
/// per triangle, in world space.
struct RayHit {
  double depth_m = std::numeric_limits<double>::infinity();
  dvec3 normal = dvec3(0.0);  ///< unit normal of the triangle, towards the camera
};
[[nodiscard]] inline RayHit first_hit(std::span<const dvec3> corners, const ViewSettings& settings, double pixel_x,
                                      double pixel_y) {
  const double half = std::tan(0.5 * static_cast<double>(settings.camera.fov_y));
  const double x = (2.0 * pixel_x / settings.width - 1.0) * half * settings.width / settings.height;
  const double y = (1.0 - 2.0 * pixel_y / settings.height) * half;
  const dvec3 origin(settings.world_from_camera[3]);
  const dvec3 ray(settings.world_from_camera * dvec4(x, y, -1.0, 0.0));  // its parameter is the view depth
  RayHit hit;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const dvec3 edge1 = corners[t + 1] - corners[t], edge2 = corners[t + 2] - corners[t];
    const dvec3 across = glm::cross(ray, edge2);
    const double determinant = glm::dot(edge1, across);
    if (std::abs(determinant) < 1e-12) continue;
    const dvec3 from = origin - corners[t];
    const double u = glm::dot(from, across) / determinant;
    const dvec3 q = glm::cross(from, edge1);
    const double v = glm::dot(ray, q) / determinant;
    const double depth = glm::dot(edge2, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || depth <= 0.0 || depth >= hit.depth_m) continue;
    hit.depth_m = depth;
    hit.normal = glm::normalize(glm::cross(edge1, edge2));
    if (glm::dot(hit.normal, ray) > 0.0) hit.normal = -hit.normal;
  }
  return hit;
}

}  // namespace gloam::test
