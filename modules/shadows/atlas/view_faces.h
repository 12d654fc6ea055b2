// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"
#include "modules/shadows/atlas/placement.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// What a local light's faces wanted, so that sizes near a limit do not change every frame.
struct WantedSize {
  Entity light;
  std::uint32_t size = 0;  ///< texels
};

/// What a view's lights need for shadows; a view resource, made by system shadow_views. Squares of faces stay where
/// they were while their size does not change.
struct ShadowViews {
  /// Faces with a place: light by light, in the order of the view's local lights, then of the directional ones.
  std::vector<ShadowFace> faces;
  std::vector<shaders::ShadowRow> rows;  ///< by index of the view's local lights
  shaders::ShadowBlock block{};          ///< directional lights; the rest is filled by the passes
  std::uint32_t faces_shrunk = 0;        ///< faces smaller than they asked for because the atlas was full
  std::uint32_t faces_left_out = 0;  ///< faces without a place even at the smallest size: their lights cast no shadow
  std::uint32_t casting_lights = 0;  ///< lights that asked for faces
  ShadowAtlas atlas;                 ///< who lies where; kept from frame to frame
  float texels_per_pixel = 0.0f;     ///< of local lights, to a pixel's side; kept from frame to frame; 0: no frame yet
  std::vector<WantedSize> wanted;    ///< ordered by entity index; kept from frame to frame
};

}  // namespace gloam
