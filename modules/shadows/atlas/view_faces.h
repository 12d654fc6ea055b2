// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"
#include "modules/shadows/atlas/placement.h"
#include "modules/shadows/atlas/shared_places.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// The face size requested for a local light in the last frame. Kept so that a size near a limit does not change every
/// frame.
struct WantedSize {
  Entity light;
  std::uint32_t size = 0;  ///< texels
};

/// All shadow views of a view: the faces of its lights; a view resource, written by system shadow_views. A face keeps
/// its square while its size stays the same.
struct ViewFaces {
  /// Placed faces, grouped by light, in the order of the view's local lights, then of its directional lights.
  std::vector<ShadowFace> faces;
  std::vector<shaders::ShadowRow> rows;  ///< by index of the view's local lights
  shaders::ShadowBlock block{};          ///< the system sets `directional`; the passes set the other members
  std::uint32_t faces_shrunk = 0;        ///< faces smaller than requested, because the atlas was full
  std::uint32_t faces_at_limit = 0;  ///< faces of local lights with fewer texels than their nearest surfaces ask for
  std::uint32_t faces_left_out = 0;  ///< faces without a place, even at the smallest size: their lights cast no shadow
  std::uint32_t faces_waiting = 0;   ///< faces that will get their size in a later frame (pace_sizes)
  bool filling = false;              ///< shadows were switched on: lights without squares wait for their turn
  std::uint32_t casting_lights = 0;  ///< lights that requested faces
  ShadowAtlas atlas;                 ///< places of the faces; kept from frame to frame
  AtlasSide side;                    ///< texels of the atlas' side; kept from frame to frame
  std::uint64_t shrinks = 0;         ///< calls of the module's free_idle_memory() that `side` has followed
  bool spare_for_overlays = false;   ///< the atlas keeps room for overlays
  /// Of the atlas: the view itself, the view that this one is a companion of, or a number that captures share.
  ViewId owner{0};
  std::shared_ptr<SharedPlaces> shared;   ///< null: no other view uses the atlas
  bool leads = false;                     ///< companions share the atlas; its size goes by the faces of this view
  float texels_per_pixel = 0.0f;          ///< density of local lights' maps; kept from frame to frame; 0: no frame yet
  std::vector<WantedSize> wanted;         ///< ordered by entity index; kept from frame to frame
  ShadowSettings settings;                ///< of the last frame
  std::uint64_t knobs_version = 0;        ///< KnobRegistry::version() of this frame
  std::uint64_t drawn_knobs_version = 0;  ///< the same of the last frame with shadows
  std::uint64_t frame = 0;                ///< RenderView::frame of the last frame with shadows
  std::uint32_t sharers = 0;              ///< views that shared the atlas in the last frame; 0: no frame yet
};

}  // namespace gloam
