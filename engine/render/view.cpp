// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/view.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"
#include "engine/scene/assets.h"

namespace gloam {
namespace {

/// Everything drawn, in the world's floats: only used to place a camera.
Aabb drawn_bounds(const World& world) {
  Aabb bounds;
  const SceneAssets* assets = world.try_resource<SceneAssets>();
  if (assets == nullptr) return bounds;
  world.view<const MeshInstance, const WorldTransform>().each([&](const MeshInstance& instance, const WorldTransform& transform) {
    if (instance.mesh >= assets->meshes.size()) return;
    const Aabb& box = assets->meshes[instance.mesh].bounds;
    if (!box.empty()) bounds.grow(transformed(box, mat4(transform.matrix)));
  });
  return bounds;
}

/// The rotation and translation of a matrix that may also scale.
dmat4 rigid(const dmat4& m) {
  dvec3 z = glm::normalize(dvec3(m[2]));
  const dvec3 x = glm::normalize(glm::cross(dvec3(m[1]), z));
  const dvec3 y = glm::cross(z, x);
  return dmat4(dvec4(x, 0.0), dvec4(y, 0.0), dvec4(z, 0.0), dvec4(dvec3(m[3]), 1.0));
}

}  // namespace

void follow_camera(const World& world, ViewSettings& settings) {
  const Camera* camera = world.try_get<Camera>(settings.camera_entity);
  const WorldTransform* transform = world.try_get<WorldTransform>(settings.camera_entity);
  if (camera == nullptr || transform == nullptr) return;
  settings.camera = *camera;
  settings.world_from_camera = rigid(transform->matrix);
}

RenderView make_view(const ViewSettings& settings, std::uint64_t frame) {
  GLOAM_ASSERT(settings.width > 0 && settings.height > 0, "a view has at least one pixel");
  RenderView view;
  view.id = settings.id;
  view.width = settings.width;
  view.height = settings.height;
  view.frame = frame;
  view.camera_entity = settings.camera_entity;
  view.position = dvec3(settings.world_from_camera[3]);
  view.camera = settings.camera;
  view.near_m = settings.camera.near_m;

  dmat4 rotation = settings.world_from_camera;
  rotation[3] = dvec4(0.0, 0.0, 0.0, 1.0);
  view.view_from_relative = mat4(glm::transpose(rotation));
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  if (settings.camera.orthographic) {
    const float far_m = settings.camera.far_m > view.near_m ? settings.camera.far_m : view.near_m + 1000.0f;
    view.clip_from_view =
        reversed_orthographic(settings.camera.half_height_m * aspect, settings.camera.half_height_m, view.near_m, far_m);
  } else {
    view.clip_from_view = reversed_perspective(settings.camera.fov_y, aspect, view.near_m);
  }
  view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  view.frustum = frustum_from_clip(view.clip_from_relative);
  return view;
}

ViewSettings settings_for_camera(const World& world, Entity camera, std::uint32_t width, std::uint32_t height) {
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  if (camera != kNoEntity) {
    settings.camera_entity = camera;
    follow_camera(world, settings);
    return settings;
  }
  const Aabb bounds = drawn_bounds(world);
  const dvec3 center = bounds.empty() ? dvec3(0.0) : dvec3(bounds.center());
  const double radius = bounds.empty() ? 1.0 : std::max(1e-3, glm::length(dvec3(bounds.half_extent())));
  const double distance = radius / std::sin(0.5 * static_cast<double>(settings.camera.fov_y));
  const dvec3 eye = center + glm::normalize(dvec3(0.6, 0.45, 1.0)) * distance;
  settings.camera.near_m = static_cast<float>(std::clamp(distance * 0.01, 1e-4, 0.1));
  settings.world_from_camera = glm::inverse(glm::lookAt(eye, center, dvec3(0.0, 1.0, 0.0)));
  return settings;
}

}  // namespace gloam
