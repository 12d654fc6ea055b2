// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/render/view.h"
#include "modules/c_interface/handles.h"

using gloam::c_interface::guarded_with;
using gloam::c_interface::usage_error;
using gloam::c_interface::WorldObject;

namespace gloam::c_interface {
namespace {

constexpr std::uint32_t kMostViews = 1024;

bool is_rigid_pose(const dmat4& m) {
  const glm::dmat3 axes(m);
  const glm::dmat3 product = glm::transpose(axes) * axes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) > 1e-5) return false;
  return glm::determinant(axes) > 0.0;
}

Result<ViewRequest> request_of(WorldObject& of, const gloam_view* given) {
  gloam_view view;
  GLOAM_TRY(read_struct(given, gloam_view(GLOAM_VIEW_INIT), "gloam_view", view));
  if (view.id >= CompanionViews::kMostMainIds)
    return usage_error("gloam_view::id is " + std::to_string(view.id) + "; it is below " +
                       std::to_string(CompanionViews::kMostMainIds));
  if (view.width == 0 || view.height == 0 || view.width > kMostViewPixels || view.height > kMostViewPixels)
    return usage_error("gloam_view is " + std::to_string(view.width) + "x" + std::to_string(view.height) +
                       " pixels; a side has 1 to " + std::to_string(kMostViewPixels));
  ViewRequest request;
  ViewSettings& settings = request.settings;
  if (view.camera != 0) {
    const auto camera = entity_of(of.world, view.camera);
    if (!camera) return camera.error();
    const std::string fault = camera_fault(of.world, *camera);
    if (!fault.empty()) return usage_error("gloam_view::camera: " + fault);
    settings = settings_for_camera(of.world, *camera, view.width, view.height);
  } else {
    const auto pose = matrix_of(view.matrix, "gloam_view::matrix");
    if (!pose) return pose.error();
    if (!is_rigid_pose(*pose)) return usage_error("gloam_view::matrix is no rotation and translation");
    if (!(view.fov_y > 0.0f && view.fov_y < 3.1415f)) return usage_error("gloam_view::fov_y is not between 0 and pi");
    if (!(view.near_m > 0.0f && std::isfinite(view.near_m))) return usage_error("gloam_view::near_m is not above 0");
    settings.world_from_camera = *pose;
    settings.camera.fov_y = view.fov_y;
    settings.camera.near_m = view.near_m;
  }
  settings.id = ViewId{view.id};
  settings.width = view.width;
  settings.height = view.height;
  if (view.visualizer != nullptr) settings.visualizer = view.visualizer;
  GLOAM_TRY(of.engine->renderer->check_visualizer(of.world, settings.visualizer));
  GLOAM_TRY(use_host_images(*of.engine, view, request));
  return request;
}

Status render(WorldObject& of, const gloam_view* views, std::uint32_t count) {
  if (count == 0 || count > kMostViews)
    return usage_error("gloam_render: count is " + std::to_string(count) + "; it is 1 to " +
                       std::to_string(kMostViews));
  if (views == nullptr) return usage_error("gloam_render: views is null");
  std::vector<ViewRequest> requests;
  // Structures of an older header are smaller: the next one begins after the size of the first.
  const auto* at = reinterpret_cast<const unsigned char*>(views);
  for (std::uint32_t i = 0; i < count; ++i) {
    auto request = request_of(of, reinterpret_cast<const gloam_view*>(at + i * views->size));
    if (!request) return request.error();
    for (const ViewRequest& other : requests)
      if (other.settings.id == request->settings.id)
        return usage_error("gloam_render: two views have the id " + std::to_string(other.settings.id.value));
    requests.push_back(std::move(*request));
  }
  return of.engine->renderer->render(of.world, requests);
}

}  // namespace
}  // namespace gloam::c_interface

extern "C" {

gloam_result gloam_render(gloam_world* world, const gloam_view* views, uint32_t count) {
  return guarded_with(world, "gloam_render",
                      [&](WorldObject& of) { return gloam::c_interface::render(of, views, count); });
}

gloam_result gloam_read_picture(gloam_world* world, uint32_t view, uint8_t* rgba, size_t bytes, uint32_t* width,
                                uint32_t* height) {
  return guarded_with(world, "gloam_read_picture", [&](WorldObject& of) -> gloam::Status {
    if (rgba == nullptr) return usage_error("gloam_read_picture: rgba is null");
    const auto picture = of.engine->renderer->read_picture(gloam::ViewId{view});
    if (!picture) return picture.error();
    if (width != nullptr) *width = picture->width;
    if (height != nullptr) *height = picture->height;
    if (bytes < picture->rgba.size())
      return usage_error("gloam_read_picture: the picture takes " + std::to_string(picture->rgba.size()) +
                         " bytes, there is room for " + std::to_string(bytes));
    std::copy(picture->rgba.begin(), picture->rgba.end(), rgba);
    return {};
  });
}

gloam_result gloam_release_view(gloam_world* world, uint32_t view) {
  return guarded_with(world, "gloam_release_view", [&](WorldObject& of) -> gloam::Status {
    of.engine->renderer->release_view(of.world, gloam::ViewId{view});
    return {};
  });
}

}  // extern "C"
