// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/view.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/text/plain_text.h"
#include "engine/render/camera/framing.h"
#include "engine/scene/posing/camera_poses.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

/// Mirrors directions at a plane through the origin.
dmat4 reflection(const dvec3& normal) { return dmat4(glm::dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal)); }

dvec3 reflected(const dvec3& position, const MirrorPlane& mirror) {
  return position - 2.0 * (glm::dot(mirror.normal, position) - mirror.offset) * mirror.normal;
}

/// The pose of a camera with this world matrix, or its last one if the matrix has none.
std::optional<dmat4> camera_pose(const World& world, Entity camera, const dmat4& matrix) {
  if (std::optional<dmat4> pose = rigid_pose(matrix)) return pose;
  const auto* poses = world.try_resource<CameraPoses>();
  const dmat4* last = poses != nullptr ? poses->find(camera) : nullptr;
  return last != nullptr ? std::optional(*last) : std::nullopt;
}

bool is_positive(float value) { return value > 0.0f && std::isfinite(value); }

/// Whether the matrix only turns and moves, up to rounding.
bool is_rigid(const dmat4& m) {
  constexpr double kRounding = 1e-3;
  const glm::dmat3 turn(m);
  const glm::dmat3 square = glm::transpose(turn) * turn - glm::dmat3(1.0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(square[column][row]) < kRounding)) return false;  // also for NaN
  const dvec3 position(m[3]);
  return glm::determinant(turn) > 0.0 && std::isfinite(position.x) && std::isfinite(position.y) &&
         std::isfinite(position.z);
}

}  // namespace

CompanionViews::CompanionViews(ViewId main) : main_(main) {}

std::vector<ViewId> CompanionViews::ids_of(ViewId main) {
  std::vector<ViewId> ids;
  for (std::uint32_t n = 0; main.value < kMostMainIds && n < kMost; ++n)
    ids.push_back(ViewId{kFirstId + main.value * kMost + n});
  return ids;
}

ViewId CompanionViews::add(ViewSettings settings) {
  GLOAM_ASSERT(all_.size() < kMost, "a view has at most CompanionViews::kMost companions");
  GLOAM_ASSERT(main_.value < kMostMainIds, "the id of a view with companions is below CompanionViews::kMostMainIds");
  settings.id = ids_of(main_)[all_.size()];
  settings.follow_camera = false;
  all_.push_back(std::move(settings));
  return all_.back().id;
}

void check_settings(const ViewSettings& settings) {
  const std::string view = "view " + std::to_string(settings.id.value);
  GLOAM_ASSERT(settings.width > 0 && settings.height > 0, view + " is " + std::to_string(settings.width) + "x" +
                                                              std::to_string(settings.height) +
                                                              " pixels: a view has at least one pixel");
  GLOAM_ASSERT(is_rigid(settings.world_from_camera),
               view + ": ViewSettings::world_from_camera is no finite matrix of a rotation and a translation");
  const Camera& camera = settings.camera;
  if (camera.orthographic) {
    GLOAM_ASSERT(is_positive(camera.half_height_m), view + ": Camera::half_height_m is not positive and finite");
    GLOAM_ASSERT(!settings.exact_width || is_positive(camera.half_width_m),
                 view + ": Camera::half_width_m is not positive and finite");
    GLOAM_ASSERT(std::isfinite(camera.near_m), view + ": Camera::near_m is not finite");
  } else {
    GLOAM_ASSERT(camera.fov_y > 0.0f && camera.fov_y < kPi, view + ": Camera::fov_y is not in (0, pi) radians");
    GLOAM_ASSERT(is_positive(camera.near_m), view + ": Camera::near_m is not positive and finite");
  }
  GLOAM_ASSERT(settings.aspect >= 0.0f && std::isfinite(settings.aspect),
               view + ": ViewSettings::aspect is not at least 0 and finite");
  GLOAM_ASSERT(!settings.mirror || std::abs(glm::length(settings.mirror->normal) - 1.0) < 1e-6,
               view + ": the normal of a mirror has unit length");
  GLOAM_ASSERT(is_positive(settings.heat_range), view + ": ViewSettings::heat_range is not positive and finite");
  GLOAM_ASSERT(!settings.lens || settings.lens->focus_m > 0.0, view + ": LensPoint::focus_m is not above 0");
}

std::string camera_fault(const World& world, Entity camera) {
  if (!world.alive(camera)) return text_of(camera) + " is not alive";
  if (!world.has<Camera>(camera)) return text_of(camera) + " has no Camera";
  if (!world.has<WorldTransform>(camera)) return text_of(camera) + " has no WorldTransform";
  return {};
}

void follow_camera(const World& world, ViewSettings& settings) {
  if (!settings.follow_camera) return;
  const auto* lens = world.try_resource<LensPoint>();
  const bool from_point = lens != nullptr && lens->camera == settings.camera_entity;
  if (from_point) settings.lens = *lens;  // also for a camera without an entity
  const Camera* camera = world.try_get<Camera>(settings.camera_entity);
  const WorldTransform* transform = world.try_get<WorldTransform>(settings.camera_entity);
  if (camera == nullptr || transform == nullptr) return;
  settings.camera = *camera;
  if (const std::optional<dmat4> pose = camera_pose(world, settings.camera_entity, transform->matrix))
    settings.world_from_camera = *pose;
  if (!from_point) settings.lens.reset();
}

Status check_camera_pose(const World& world, const ViewSettings& settings) {
  if (!settings.follow_camera) return {};
  const WorldTransform* transform = world.try_get<WorldTransform>(settings.camera_entity);
  if (transform == nullptr || !world.has<Camera>(settings.camera_entity)) return {};
  if (camera_pose(world, settings.camera_entity, transform->matrix)) return {};
  const auto* names = world.try_resource<SceneNames>();
  const std::string name(names != nullptr ? names->name_of(settings.camera_entity) : std::string_view());
  return Error{ErrorKind::input, "camera " + (name.empty() ? text_of(settings.camera_entity) : in_quotes(name)) +
                                     " has no direction: its node or a parent has a scale of 0 or a singular matrix, "
                                     "and it had no other pose before"};
}

RenderView make_view(const ViewSettings& settings, std::uint64_t frame, std::uint64_t cut_frame) {
  check_settings(settings);
  RenderView view;
  view.id = view.main_view = settings.id;
  view.width = settings.width;
  view.height = settings.height;
  view.frame = frame;
  view.cut_frame = cut_frame;
  view.camera_entity = settings.camera_entity;
  view.position = dvec3(settings.world_from_camera[3]);
  view.camera = settings.camera;
  view.near_m = settings.camera.near_m;

  view.purpose = settings.purpose;
  view.static_only = settings.static_only;
  dmat4 rotation = settings.world_from_camera;
  rotation[3] = dvec4(0.0, 0.0, 0.0, 1.0);
  if (settings.mirror) {
    const MirrorPlane& mirror = *settings.mirror;
    view.position = reflected(view.position, mirror);
    rotation = reflection(mirror.normal) * rotation;
    view.mirrored = view.clipped = true;
    const double height = glm::dot(mirror.normal, view.position) - mirror.offset;
    view.clip_plane = vec4(vec3(mirror.normal), static_cast<float>(height - mirror.margin_m));
  }
  view.view_from_relative = mat4(glm::transpose(rotation));
  if (settings.lens) {
    const LensPoint& lens = *settings.lens;
    view.position += dvec3(rotation[0]) * lens.offset_m.x + dvec3(rotation[1]) * lens.offset_m.y;
  }
  const float aspect =
      settings.aspect > 0.0f ? settings.aspect : static_cast<float>(view.width) / static_cast<float>(view.height);
  if (settings.camera.orthographic) {
    const float far_m = settings.camera.far_m > view.near_m ? settings.camera.far_m : view.near_m + 1000.0f;
    const float half_width_m =
        settings.exact_width ? settings.camera.half_width_m : settings.camera.half_height_m * aspect;
    view.clip_from_view = reversed_orthographic(half_width_m, settings.camera.half_height_m, view.near_m, far_m);
  } else {
    view.clip_from_view = reversed_perspective(settings.camera.fov_y, aspect, view.near_m);
  }
  if (settings.lens)
    for (int axis = 0; axis < 2; ++axis)
      view.clip_from_view[2][axis] -=
          static_cast<float>(view.clip_from_view[axis][axis] * settings.lens->offset_m[axis] / settings.lens->focus_m);
  view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  view.frustum = frustum_from_clip(view.clip_from_relative);
  view.previous = view.view_camera();
  return view;
}

ViewSettings settings_for_camera(const World& world, Entity camera, std::uint32_t width, std::uint32_t height) {
  if (camera == kNoEntity) return framed_view(world, width, height);
  const std::string fault = camera_fault(world, camera);
  GLOAM_ASSERT(fault.empty(), "settings_for_camera: " + fault);
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera_entity = camera;
  follow_camera(world, settings);
  return settings;
}

}  // namespace gloam
