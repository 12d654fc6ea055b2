// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/jobs/executor.h"
#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "modules/lights/components.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/shadows/components.h"
#include "tests/modules/lighting/shading_oracle.h"
#include "tests/modules/shadows/support/visibility_scene.h"
#include "tests/support/render_scene.h"

/// A floor in whose reflection a camera sees a scene, for tests of traced reflections.
namespace gloam::test {

/// A world, and a view of the plane y = 0. The plane is in the geometry buffer only.
class ReflectionScene {
 public:
  ReflectionScene() {
    prepare_scene_world(world);
    world.register_component<Light>();
    world.register_component<ShadowCaster>();
    look_from({0.0, 1.5, 2.5});
    floor_material(0, 255, 255);
  }
  void look_from(const dvec3& eye) {
    view = make_view(look_at(eye, dvec3(0.0), 40, 24), 0);
    geometry = plane_picture(view, dvec3(0.0), dvec3(0.0, 1.0, 0.0));
  }
  /// Bytes of the geometry buffer.
  void floor_material(std::uint32_t roughness, std::uint32_t metallic, std::uint32_t reflectivity,
                      std::uint32_t occlusion = 255) {
    for (std::uint32_t& texel : geometry.material)
      texel = roughness | metallic << 8 | occlusion << 16 | reflectivity << 24;
  }
  /// A square around `at` whose front has this normal.
  Entity square(double half, const dvec3& at, const dvec3& normal, const Material& material) {
    dmat4 matrix(1.0);
    const dvec3 x = glm::normalize(glm::cross(std::abs(normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), normal));
    matrix[0] = dvec4(x, 0.0);
    matrix[1] = dvec4(glm::cross(normal, x), 0.0);
    matrix[2] = dvec4(normal, 0.0);
    matrix[3] = dvec4(at, 1.0);
    return maker.draw(maker.mesh(quad(static_cast<float>(half), maker.material(material))), matrix);
  }
  Entity light(const Light& what, const dvec3& at, const dvec3& direction = dvec3(0.0, -1.0, 0.0)) {
    dmat4 matrix(1.0);
    matrix[2] = dvec4(-glm::normalize(direction), 0.0);
    matrix[3] = dvec4(at, 1.0);
    lights.push_back({what, at, glm::normalize(direction)});
    return world.create(what, WorldTransform{matrix});
  }
  [[nodiscard]] TracedReflections trace(const ReflectionTracing& settings = {}) {
    tracer = std::move(make_scene_tracer(world, *executor, view.position)).value();
    return trace_radiance(input(settings));
  }
  [[nodiscard]] RadianceInput input(const ReflectionTracing& settings) {
    return {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .settings = settings};
  }
  [[nodiscard]] SceneEnvironment& sky() { return world.resource<SceneEnvironment>(); }

  /// The mirrored ray of a floor pixel, exact.
  struct Mirrored {
    dvec3 origin = dvec3(0.0);
    dvec3 direction = dvec3(0.0);
    /// The point on the plane dot(normal, p) = offset; none if the ray goes away from it.
    [[nodiscard]] std::optional<dvec3> at(const dvec3& normal, double offset) const {
      const double along = (offset - glm::dot(normal, origin)) / glm::dot(normal, direction);
      if (!(along > 0.0)) return std::nullopt;
      return origin + along * direction;
    }
  };
  [[nodiscard]] Mirrored mirrored(std::uint32_t x, std::uint32_t y) const {
    const dvec3 relative = geometry.position(x, y);
    return {relative + view.position, glm::normalize(relative * dvec3(1.0, -1.0, 1.0))};
  }
  /// Calls check(x, y, radiance) for each floor pixel.
  template <class Check>
  void each_floor_pixel(const TracedReflections& traced, const Check& check) const {
    for (std::uint32_t y = 0; y < traced.height; ++y)
      for (std::uint32_t x = 0; x < traced.width; ++x) {
        const std::size_t pixel = std::size_t{y} * traced.width + x;
        const float* const texel = &traced.radiance[4 * pixel];
        if (!geometry.is_sky(pixel)) check(x, y, dvec3(texel[0], texel[1], texel[2]));
      }
  }

  World world;
  SceneMaker maker{world};
  RenderView view;
  GeometryPicture geometry;
  std::vector<OracleLight> lights;
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer;
};

/// A material that shines, with the surroundings of the sky on it.
[[nodiscard]] inline Material glowing(const vec3& emissive) {
  Material material;
  material.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.metallic = 0.0f;
  material.emissive = emissive;
  material.reflectivity = 0.0f;
  return material;
}

/// The surface of a material at a point that a ray meets.
[[nodiscard]] inline OracleSurface surface_of(const Material& material, const dvec3& position, const dvec3& normal,
                                              const dvec3& ray_direction) {
  return {.position = position,
          .normal = normal,
          .to_eye = -ray_direction,
          .base_color = dvec3(material.base_color),
          .metallic = static_cast<double>(material.metallic),
          .roughness = static_cast<double>(material.roughness)};
}

/// A material without emission. Its surroundings are those of the sky.
[[nodiscard]] inline Material painted(const vec3& color, float roughness = 0.6f, float metallic = 0.0f) {
  Material material;
  material.base_color = vec4(color, 1.0f);
  material.roughness = roughness;
  material.metallic = metallic;
  material.reflectivity = 0.0f;
  return material;
}

}  // namespace gloam::test
