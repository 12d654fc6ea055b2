// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"
#include "modules/shadows/shadow_atlas.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// One square of depth: what a light sees along one axis.
struct ShadowFace {
  Entity light;
  LightKind kind = LightKind::spot;  ///< directional: orthographic; point: one of a cube's, also of a spot that needs a cube
  std::uint32_t index = 0;  ///< cube face or cascade
  dvec3 origin = dvec3(0.0);  ///< world: the light; orthographic: centre of the near side of the box
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
  float tan_half = 1.0f;       ///< perspective, rim included; 0: orthographic
  float half_extent_m = 0.0f;  ///< orthographic, rim included
  float near_m = 0.05f;        ///< orthographic: 0
  float far_m = 0.0f;          ///< what is farther cannot be lit: range of the light, or depth of the box
  AtlasSquare square;          ///< where it lies in the atlas
  float importance = 0.0f;     ///< the least important ones halve first when the atlas is full
};

/// What a local light's faces wanted, so that sizes near a limit do not change every frame.
struct WantedSize {
  Entity light;
  std::uint32_t size = 0;  ///< texels
};

/// What a view's lights need for shadows; a view resource, made by system shadow_views. Squares of faces stay where they were while their
/// size does not change.
struct ShadowViews {
  /// Faces with a place: light by light, in the order of the view's local lights, then of the directional ones.
  std::vector<ShadowFace> faces;
  std::vector<shaders::ShadowRow> rows;        ///< by index of the view's local lights
  shaders::ShadowBlock block{};                ///< directional lights; the rest is filled by the passes
  std::uint32_t faces_shrunk = 0;              ///< faces smaller than they asked for because the atlas was full
  std::uint32_t faces_left_out = 0;            ///< faces without a place even at the smallest size: their lights cast no shadow
  std::uint32_t casting_lights = 0;            ///< lights that asked for faces
  ShadowAtlas atlas;                           ///< who lies where; kept from frame to frame
  float texels_per_pixel = 0.0f;               ///< of local lights, to a pixel's side; kept from frame to frame; 0: no frame yet
  std::vector<WantedSize> wanted;              ///< ordered by entity index; kept from frame to frame
};

/// What systems need to know of knobs; a view resource.
struct ShadowSettings {
  bool enabled = true;                ///< shadows.mode is not off
  std::uint32_t atlas_size = 4096;    ///< texels, a power of two
  std::uint32_t cascades = 4;         ///< of a directional light
  float kernel_rim = 0.125f;          ///< rim of a face for kernels, as a share of its half extent
  float texels_per_pixel = 3.0f;      ///< to a pixel's side, where the atlas has room
};

}  // namespace gloam
