// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/types.h"
#include "modules/shadows/atlas/cache.h"
#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/placement.h"

namespace gloam {

/// What a view's passes did, for counters.
struct ShadowCounts {
  std::uint32_t drawn = 0;    ///< faces that were drawn
  std::uint32_t cached = 0;   ///< whose map was there already
  std::uint32_t skipped = 0;  ///< drawn without anything in them
  std::uint64_t texels = 0;   ///< that were drawn, of all faces
};

/// An image that lives on between frames.
struct KeptImage {
  gpu::ImageHandle image;
  bool filled = false;  ///< a frame has been recorded that wrote it
};

/// What one view of one world keeps on the GPU.
struct ViewShadows {
  KeptImage atlas;
  KeptImage pyramid;
  KeptImage planes;  ///< made when they are first wanted; filled: those of all faces are as the atlas is
  /// An array of one, laid out as the atlas' mip 0: depth of casters that rest, where others move. Made when it is
  /// first wanted.
  KeptImage backgrounds;
  std::uint32_t atlas_size = 0;
  bool d16 = false;
  ShadowCache cache;
  CasterHistory history;  ///< of this view's frames
  ShadowCounts counts;
  std::vector<FaceKey> drawn;    ///< in the newest frame
  std::uint64_t last_frame = 0;  ///< Device::frame_number of its last use
};

}  // namespace gloam
