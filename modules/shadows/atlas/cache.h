// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/draws/casters.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/face_regions.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Identifies the inputs of a face's map by hashes: faces with equal content have equal maps.
struct FaceContent {
  std::uint64_t hash = 0;     ///< of the face, of all casters that it may see, and of `salt`
  std::uint64_t pose = 0;     ///< of the face and of `salt` only
  bool moving = false;        ///< it may see an unsteady caster: parts of its map are redrawn every frame
  std::uint32_t casters = 0;  ///< number of casters that it may see
  bool operator==(const FaceContent&) const = default;
};

/// A part of a face in the view's image of backgrounds: the depth of its resting casters.
struct FaceBackground {
  TexelRect texels;
  std::uint64_t hash = 0;  ///< of the resting casters that this part may see
};

/// The content of each face, in order. salt: hash of everything else that maps depend on (knobs, version of the
/// meshes). withheld: casters that are left out for a light's faces. The result does not depend on the number of
/// threads.
[[nodiscard]] std::vector<FaceContent> face_contents(std::span<const ShadowFace> faces,
                                                     std::span<const CasterState> casters, std::uint64_t salt,
                                                     JobExecutor& executor, const WithheldCasters& withheld = {});

/// Keeps track of the maps that an atlas holds, with the content that each was drawn from.
class ShadowCache {
 public:
  /// Whether the atlas holds this face's map at face.square, drawn from this content. False when content.moving.
  [[nodiscard]] bool has_map(const ShadowFace& face, const FaceContent& content) const;
  /// Whether the atlas holds this face's map at face.square with the casters of frame `frame` (numbered by
  /// CasterHistory) and with the same pose and salt. In frame + 1 this map is then outdated only inside the boxes of
  /// CasterHistory::changed(light). False for frame 0.
  [[nodiscard]] bool has_map_of_frame(const ShadowFace& face, const FaceContent& content, std::uint64_t frame) const;
  /// Records that the face's map was drawn at face.square with the casters of that frame. Maps that overlap the square
  /// are forgotten.
  void set_drawn(const ShadowFace& face, const FaceContent& content, std::uint64_t frame = 0);
  /// Records that the face's map is right for that frame as well, and its content. late: boxes inside which it is out
  /// of date and waits for its turn. Without effect if the map has been forgotten.
  void keep(const FaceKey& face, const FaceContent& content, std::uint64_t frame, std::vector<CasterBox> late = {});
  /// Number of the drawing that made the face's map as it is, in the whole atlas or in a part; 0: there is none.
  [[nodiscard]] std::uint64_t version(const FaceKey& face) const;
  /// Boxes inside which the face's map has waited for its turn since it was drawn.
  [[nodiscard]] std::span<const CasterBox> late(const ShadowFace& face) const;
  /// The face's backgrounds; empty when the atlas does not hold its map.
  [[nodiscard]] std::span<const FaceBackground> backgrounds(const ShadowFace& face) const;
  /// Replaces the face's backgrounds. The atlas must hold the face's map.
  void set_backgrounds(const ShadowFace& face, std::vector<FaceBackground> backgrounds);
  /// Whether the planes of the face's map (shaders/shadows/maps/planes_shared.h) are those of the map. False after
  /// set_drawn().
  [[nodiscard]] bool has_planes(const ShadowFace& face) const;
  /// Records that the planes of the face's map were made. Without effect if the map has been forgotten.
  void set_planes(const FaceKey& face);
  /// Records that no map has planes.
  void forget_planes();
  void clear() {
    maps_.clear();
    places_.clear();
  }
  [[nodiscard]] std::size_t size() const { return maps_.size(); }

 private:
  struct Map {
    AtlasSquare square;
    FaceContent content;
    std::uint64_t frame = 0;  ///< the newest frame whose casters the map shows
    std::vector<FaceBackground> backgrounds;
    std::vector<CasterBox> late = {};
    bool has_planes = false;
    std::uint64_t version = 0;
  };
  void forget_overlapping(const AtlasSquare& square);

  std::unordered_map<FaceKey, Map, FaceKeyHash> maps_;
  /// The map in each place. Squares are ordered by the index of their first texel in Morton order (Z order), in which
  /// each square is one contiguous range: this index is the key, and the value holds the range's end.
  struct Stretch {
    std::uint64_t end = 0;
    FaceKey key;
  };
  std::map<std::uint64_t, Stretch> places_;
  std::uint64_t drawings_ = 0;  ///< calls of set_drawn() so far
};

}  // namespace gloam
