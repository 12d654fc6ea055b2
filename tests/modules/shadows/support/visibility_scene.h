// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <optional>

#include "engine/jobs/executor.h"
#include "engine/math/packing.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/reference/adapter.h"
#include "tests/support/render_scene.h"

/// A floor that a camera looks at, for tests of traced visibility.
namespace gloam::test {

/// The geometry buffer of an infinite plane, of which the camera sees the side that faces it.
[[nodiscard]] inline GeometryPicture plane_picture(const RenderView& view, const dvec3& through, const dvec3& normal,
                                                   bool subsurface = false) {
  GeometryPicture picture;
  picture.view = view;
  const std::size_t pixels = std::size_t{view.width} * view.height;
  const bool turned = glm::dot(normal, view.position - through) < 0.0;
  const std::uint32_t packed = pack_normal_snorm16(vec3(turned ? -normal : normal));
  picture.depth.assign(pixels, 0.0f);
  picture.base_color.assign(pixels, subsurface ? 0xFF808080u : 0x00808080u);
  picture.normals.assign(pixels, uvec2(packed));
  picture.material.assign(pixels, 0);
  const dmat4 relative_from_clip = glm::inverse(dmat4(view.clip_from_relative));
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const dvec4 far =
          relative_from_clip * dvec4(2.0 * (x + 0.5) / view.width - 1.0, 1.0 - 2.0 * (y + 0.5) / view.height, 0.5, 1.0);
      const dvec3 ray = dvec3(far) / far.w;
      const double along = glm::dot(through - view.position, normal) / glm::dot(ray, normal);
      if (!(along > 0.0) || along > 1e6) continue;
      const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(ray * along, 1.0);
      picture.depth[std::size_t{y} * view.width + x] = static_cast<float>(clip.z / clip.w);
    }
  return picture;
}

/// A world, a view of the plane y = 0 (shifted by `place`), and the objects that tracing needs.
class VisibilityScene {
 public:
  explicit VisibilityScene(const dvec3& place = dvec3(0.0)) : place_(place) {
    prepare_scene_world(world);
    world.register_component<Light>();
    world.register_component<ShadowCaster>();
    look_from({0.0, 3.0, 0.001});
  }

  void look_from(const dvec3& eye, bool subsurface = false) {
    view = make_view(look_at(place_ + eye, place_, 48, 32), 0);
    geometry = plane_picture(view, place_, dvec3(0.0, 1.0, 0.0), subsurface);
  }
  Entity light(const Light& light, const dvec3& at, const dvec3& direction = dvec3(0.0, -1.0, 0.001)) {
    dmat4 matrix(1.0);
    matrix[2] = dvec4(-glm::normalize(direction), 0.0);
    matrix[3] = dvec4(place_ + at, 1.0);
    return world.create(WorldTransform{matrix}, light);
  }
  /// Adds a horizontal quad between two corners in the plane y = height.
  void sheet(double height, const dvec3& from, const dvec3& to) {
    const dvec3 half = (to - from) * 0.5, middle = (to + from) * 0.5;
    dmat4 matrix(1.0);
    matrix[0] = dvec4(half.x, 0.0, 0.0, 0.0);
    matrix[1] = dvec4(0.0, 0.0, half.z, 0.0);
    matrix[2] = dvec4(0.0, 1.0, 0.0, 0.0);
    matrix[3] = dvec4(place_ + dvec3(middle.x, height, middle.z), 1.0);
    maker.draw(maker.mesh(quad(1.0f)), matrix);
  }
  void build() { tracer = std::move(make_scene_tracer(world, *executor, view.position)).value(); }
  [[nodiscard]] TracedVisibility trace(std::uint32_t samples = 256) {
    if (!tracer) build();
    return trace_visibility(input(samples));
  }
  [[nodiscard]] VisibilityInput input(std::uint32_t samples) {
    return {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .samples = samples};
  }
  /// The surface point under a pixel, relative to `place`.
  [[nodiscard]] dvec3 point(std::uint32_t x, std::uint32_t y) const {
    return geometry.position(x, y) + (view.position - place_);
  }

  World world;
  SceneMaker maker{world};
  RenderView view;
  GeometryPicture geometry;
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer;

 private:
  dvec3 place_;
};

}  // namespace gloam::test
