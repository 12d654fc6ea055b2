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

/// What a face's map is made from.
struct FaceContent {
  std::uint64_t hash = 0;  ///< of the face, of what it may see and of `salt`
  std::uint64_t pose = 0;  ///< of the face and of `salt` alone
  bool moving = false;     ///< it may see something that is unsteady: its map is never good for another frame
  std::uint32_t casters = 0;
  bool operator==(const FaceContent&) const = default;
};

/// A part of a face that the view's image of backgrounds holds: the map as casters that rest make it.
struct FaceBackground {
  TexelRect texels;
  std::uint64_t hash = 0;  ///< of these casters
};

/// One a face. `salt`: whatever else maps depend on (knobs, version of the meshes). `withheld`: casters that are not
/// there for a light's faces. The result does not depend on the number of threads.
[[nodiscard]] std::vector<FaceContent> face_contents(std::span<const ShadowFace> faces,
                                                     std::span<const CasterState> casters, std::uint64_t salt,
                                                     JobExecutor& executor, const WithheldCasters& withheld = {});

/// Which maps an atlas holds.
class ShadowCache {
 public:
  /// Whether the atlas holds this face's map, drawn from this content, where the face says.
  [[nodiscard]] bool holds(const ShadowFace& face, const FaceContent& content) const;
  /// Whether the atlas holds this face's map as it was to be in that frame of the CasterHistory: it differs from what
  /// it is to be in the next by nothing but what changed(light) says.
  [[nodiscard]] bool held(const ShadowFace& face, const FaceContent& content, std::uint64_t frame) const;
  /// The face's map has been drawn where the face says, with the casters of that frame; what lay there is gone.
  void set_drawn(const ShadowFace& face, const FaceContent& content, std::uint64_t frame = 0);
  /// The face's map, which is there, is as it would be drawn in that frame.
  void keep(const ShadowFace& face, const FaceContent& content, std::uint64_t frame);
  /// What the image of backgrounds holds of a face's map, which the atlas holds.
  [[nodiscard]] std::span<const FaceBackground> backgrounds(const ShadowFace& face) const;
  void set_backgrounds(const ShadowFace& face, std::vector<FaceBackground> backgrounds);
  void clear() {
    maps_.clear();
    places_.clear();
  }
  [[nodiscard]] std::size_t size() const { return maps_.size(); }

 private:
  struct Map {
    AtlasSquare square;
    FaceContent content;
    std::uint64_t frame = 0;  ///< the newest whose casters it shows
    std::vector<FaceBackground> backgrounds;
  };
  void forget_overlapping(const AtlasSquare& square);

  std::unordered_map<FaceKey, Map, FaceKeyHash> maps_;
  /// Who lies where, by the place of a square's first texel on the curve that fills the atlas square by square
  /// (Morton's): each square is one stretch of it.
  struct Stretch {
    std::uint64_t end = 0;
    FaceKey key;
  };
  std::map<std::uint64_t, Stretch> places_;
};

}  // namespace gloam
