// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "engine/ecs/entity.h"
#include "engine/ecs/world.h"
#include "engine/math/frustum.h"
#include "engine/math/types.h"
#include "engine/scene/components.h"

namespace gloam {

/// What a caller asks to see.
struct ViewSettings {
  ViewId id{0};
  std::uint32_t width = 1280;  ///< pixels, > 0
  std::uint32_t height = 720;
  /// The camera that is looked through: its effects (focus, exposure) are the view's. kNoEntity: one without an entity.
  Entity camera_entity = kNoEntity;
  /// Whether pose and lens are camera_entity's, taken when the frame's systems have moved it; else the two below.
  bool follow_camera = true;
  dmat4 world_from_camera = dmat4(1.0);  ///< rigid; the camera looks along −Z
  Camera camera;
  std::string visualizer = "none";  ///< a name of Renderer::visualizers()
};

/// One view of one frame as systems and passes see it. A view resource. Positions on the GPU are relative to
/// `position`.
struct RenderView {
  ViewId id{0};
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint64_t frame = 0;              ///< of its world, counted from 0
  Entity camera_entity = kNoEntity;     ///< the camera whose effects it has, if any
  dvec3 position = dvec3(0.0);          ///< of the camera, world
  mat4 view_from_relative = mat4(1.0);  ///< rotation only
  mat4 clip_from_view = mat4(1.0);      ///< reversed Z
  mat4 clip_from_relative = mat4(1.0);
  Camera camera;
  float near_m = 0.1f;
  Frustum frustum;  ///< in camera-relative space

  /// Camera-relative float position of a world position.
  [[nodiscard]] vec3 relative(const dvec3& world) const { return vec3(world - position); }
  /// Metres in front of the camera of what has this depth (reversed Z); not for the sky's 0.
  [[nodiscard]] float view_depth(float depth) const {
    const mat4& m = clip_from_view;
    return (m[3][2] - depth * m[3][3]) / (m[2][2] - depth * m[2][3]);
  }
};

/// Takes pose and lens of settings.camera_entity from the world as it is now, if it is to be followed and alive.
void follow_camera(const World& world, ViewSettings& settings);

[[nodiscard]] RenderView make_view(const ViewSettings& settings, std::uint64_t frame);

/// Settings for a camera entity (its Camera and WorldTransform), or for one fitted to the bounds of everything drawn
/// when `camera` is kNoEntity.
[[nodiscard]] ViewSettings settings_for_camera(const World& world, Entity camera, std::uint32_t width,
                                               std::uint32_t height);

}  // namespace gloam
