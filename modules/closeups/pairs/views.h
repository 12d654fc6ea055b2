// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// A rectangle of a view's shadow tiles, from `begin` to before `end`.
struct TileRange {
  uvec2 begin = uvec2(0);
  uvec2 end = uvec2(0);
  [[nodiscard]] bool empty() const { return begin.x >= end.x || begin.y >= end.y; }
  [[nodiscard]] std::uint64_t tiles() const { return empty() ? 0 : std::uint64_t{end.x - begin.x} * (end.y - begin.y); }
  bool operator==(const TileRange&) const = default;
};

/// What systems need to know of knobs; a view resource.
struct CloseupSettings {
  bool enabled = true;            ///< shadows are deferred, and casters are drawn into maps
  std::uint32_t max_pairs = 8;    ///< closeups.max_pairs
  std::uint32_t map_size = 2048;  ///< texels of the side of the map that all pairs share, a power of two
  std::uint32_t batch = 1;        ///< pairs that share it at a time: 1, 2, 4
  float texels_per_pixel = 1.0f;  ///< texels to a pixel's side, where the map has room
};

/// A pair as one view shows it.
struct CloseupView {
  Entity pair;  ///< the entity with the CloseupPair
  Entity subject;
  Entity light;
  std::uint32_t subject_index = 0;  ///< in CloseupSubjects::subjects
  bool directional = false;
  std::uint32_t light_index = 0;  ///< in the view's local, or directional, lights
  /// Kind spot, or directional; index 0. The square has a size, a power of two, and no place yet. Its border texels
  /// hold nothing, unless it is a spot's own cone, which the subject reaches out of.
  ShadowFace face;
  float tan_inner = 0.0f;             ///< perspective: without the rim that only kernels look at
  float width_m = 0.0f;               ///< of a local light's emitter
  float penumbra_m_per_m = 0.0f;      ///< of a directional light
  dvec3 light_position = dvec3(0.0);  ///< world; of a local light
  TileRange tiles;                    ///< holds every pixel that the subject may keep any of the light from
  float priority = 1.0f;
  float coverage = 0.0f;  ///< share of the view's tiles in `tiles`
};

/// Made by the systems closeup_views and umbra_projection; a view resource. Pairs in the order they are drawn: higher
/// priority first, then greater coverage, then by entities.
struct CloseupViews {
  std::vector<CloseupView> pairs;
  std::uint32_t in_view = 0;  ///< pairs that touch the view, with those that are skipped
  std::uint32_t skipped = 0;  ///< of those, for which closeups.max_pairs has no room, or no map can hold: their
                              ///< subjects are drawn into the light's standard map
};

/// Subjects of the world with where they are in this frame; a resource, made by system closeup_subjects.
struct CloseupSubjects {
  struct Subject {
    Entity entity;
    float priority = 1.0f;
    std::uint32_t lights = 0;     ///< CloseupSubject::lights
    std::vector<Entity> casters;  ///< entities of its subtree with a MeshInstance, ascending by index; of nested
                                  ///< subjects the innermost has them
    dvec3 low = dvec3(0.0);       ///< world box of all of them, as posed
    dvec3 high = dvec3(-1.0);
    [[nodiscard]] bool known() const { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
  };
  std::vector<Subject> subjects;  ///< ascending by index of the entity
};

}  // namespace gloam
