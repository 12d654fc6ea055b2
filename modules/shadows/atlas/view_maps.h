// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "modules/shadows/atlas/cache.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/placement.h"

namespace gloam {

/// Counters of a view's passes in the newest frame.
struct ShadowCounts {
  std::uint32_t drawn = 0;    ///< faces that were drawn
  std::uint32_t cached = 0;   ///< faces whose map was in the atlas already
  std::uint32_t skipped = 0;  ///< faces without casters, which were only cleared
  std::uint64_t texels = 0;   ///< texels drawn in all faces and backgrounds
};

/// An image that is kept between frames.
struct KeptImage {
  gpu::ImageHandle image;
  bool filled = false;  ///< a frame that writes it has been recorded
  ImageRef imported;    ///< first version in the frame that imported it last
};

/// The image in this frame, imported by the frame's first call; later calls return the newest version.
[[nodiscard]] ImageRef import_kept(FrameGraph& graph, const char* name, KeptImage& image);

/// State that one view of one world, or its captures together, keep between frames: images, and the data about their
/// content.
struct ViewShadows {
  KeptImage atlas;
  KeptImage pyramid;
  KeptImage planes;  ///< created on first use; filled: up to date with the atlas for all faces
  /// Depth of resting casters, in parts of faces where others move: an array of one layer, laid out as mip 0 of the
  /// atlas. Created on first use.
  KeptImage backgrounds;
  std::uint32_t atlas_size = 0;
  bool d16 = false;
  ShadowCache cache;
  CasterHistory history;  ///< its frames are the frames of this view
  ShadowCounts counts;
  std::vector<FaceKey> drawn;     ///< faces drawn in the newest frame, by all views that share the images
  std::uint32_t planned_in = 0;   ///< FrameGraph::frame of the newest frame that planned maps
  std::set<std::uint32_t> users;  ///< numbers of the views that share the images
  std::uint64_t last_frame = 0;   ///< Device::frame_number of its last use
};

}  // namespace gloam
