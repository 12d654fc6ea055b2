// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "modules/shadows/atlas/cache.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/placement.h"

namespace gloam {

/// Counters of a view's passes in the newest frame.
struct ShadowCounts {
  std::uint32_t drawn = 0;      ///< faces that were drawn
  std::uint32_t cached = 0;     ///< faces whose map was in the atlas already
  std::uint32_t in_turn = 0;    ///< faces in which some casters wait for their turn (CasterSource::turns)
  std::uint32_t skipped = 0;    ///< faces without casters, which were only cleared
  std::uint64_t texels = 0;     ///< texels drawn in all faces and backgrounds
  std::uint64_t triangles = 0;  ///< triangles of meshes drawn there
};

/// State of the history images of maps (modules/shadows/maps/images.h) of one view of one world, or of all its captures
/// together.
struct ViewMapState {
  // After the last committed frame; changed only when a frame is committed:
  ShadowCache cache;
  std::uint64_t cached_images = 0;  ///< the images that `cache` describes: turn_instance(), or 0 for the view's own
  CasterHistory history;            ///< its frames are the frames of this view
  bool has_backgrounds = false;     ///< the image of backgrounds exists
  /// The view takes turns with others in one set of images (ShadowStates::choose_images).
  bool takes_turns = false;
  std::uint64_t image_bytes = 0;  ///< of the images that the view would have alone
  std::uint64_t number = 0;       ///< in the order in which views came

  /// The newest frame that planned maps. It may be given up.
  struct Frame {
    CasterHistory history;
    bool atlas_is_empty = false;  ///< the atlas has no contents: `cache` is out of date
    bool committed = true;
    std::uint32_t number = 0;     ///< FrameGraph::frame
    std::vector<FaceKey> drawn;   ///< faces drawn by all views that share the images
    std::vector<FaceKey> planes;  ///< faces whose planes these views have made, or found up to date
  };
  Frame frame;
  ShadowCounts counts;
  std::set<std::uint32_t> users;  ///< numbers of the views that share the images
  std::uint64_t last_frame = 0;   ///< Device::frame_number of its last use
};

}  // namespace gloam
