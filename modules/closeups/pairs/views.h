// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/closeups/umbra/tile_range.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Knob values for the systems; a view resource.
struct CloseupSettings {
  bool enabled = true;            ///< shadows.mode = deferred and closeups.max_pairs > 0
  std::uint32_t max_pairs = 8;    ///< closeups.max_pairs
  std::uint32_t map_size = 2048;  ///< side of the close-up map in texels, a power of two
  std::uint32_t batch = 1;        ///< pairs that share the close-up map at a time: 1, 2 or 4
  float texels_per_pixel = 1.0f;  ///< texels per pixel side, where the close-up map is large enough
};

/// A close-up pair in one view.
struct CloseupView {
  Entity pair;  ///< entity with the CloseupPair
  Entity subject;
  Entity light;
  std::uint32_t subject_index = 0;  ///< index in CloseupSubjects::subjects
  bool directional = false;
  std::uint32_t light_index = 0;  ///< index among the view's local or directional lights
  /// Kind spot or directional; index 0. square.size is a power of two; square.origin is not set yet. The border texels
  /// are empty, unless the face follows a spot's cone and the subject extends beyond it.
  ShadowFace face;
  float tan_inner = 0.0f;           ///< perspective: greatest tangent inside the rim
  float emitter_diameter_m = 0.0f;  ///< local light: ≥ 0
  float penumbra_m_per_m = 0.0f;    ///< directional light: width of the penumbra per metre between blocker and receiver
  dvec3 light_position = dvec3(0.0);  ///< local light: world position
  TileRange tiles;  ///< umbra range: holds every pixel for which the subject may hide part of the light
  float priority = 1.0f;
  float coverage = 0.0f;  ///< share of the view's tiles that are in `tiles`
};

/// The close-up pairs of a view; a view resource written by the systems umbra_projection and closeup_views. Pairs in
/// drawing order: higher priority first, then greater coverage, then by entities.
struct CloseupViews {
  std::vector<CloseupView> pairs;
  std::uint32_t in_view = 0;  ///< pairs whose umbra range is not empty, including skipped ones
  std::uint32_t skipped = 0;  ///< pairs of in_view that are not in `pairs`: beyond closeups.max_pairs, or no face can
                              ///< hold them. Their subjects are drawn into the light's standard maps
};

/// The close-up subjects of the world with their boxes in this frame; a resource written by system closeup_subjects.
struct CloseupSubjects {
  struct Subject {
    Entity entity;
    float priority = 1.0f;
    std::uint32_t lights = 0;     ///< CloseupSubject::lights
    std::vector<Entity> casters;  ///< entities of its subtree with a MeshInstance, ascending by index; each belongs to
                                  ///< the innermost subject only
    dvec3 low = dvec3(0.0);       ///< world box of all casters, as posed; low > high: unknown
    dvec3 high = dvec3(-1.0);
    [[nodiscard]] bool known() const { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
  };
  std::vector<Subject> subjects;  ///< ascending by entity index
};

}  // namespace gloam
