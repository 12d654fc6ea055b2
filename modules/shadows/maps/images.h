// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/knobs.h"

namespace gloam {

/// The images of a view's maps. They are kept from frame to frame in place (History), ready for fragment shaders,
/// backgrounds for compute shaders. Captures of a world share theirs.
enum class MapImage : std::uint8_t {
  atlas,
  pyramid,
  planes,
  /// Depth of resting casters, in parts of faces where others move: an array of one layer, laid out as mip 0 of the
  /// atlas.
  backgrounds,
};

/// Bytes of the images of one view: all that knobs.atlas_size calls for, with the image of backgrounds if the view has
/// one.
[[nodiscard]] std::uint64_t map_image_bytes(const ShadowKnobs& knobs, bool backgrounds);

/// Identifies the images of this size and format in which views of a world take turns; never 0.
[[nodiscard]] std::uint64_t turn_instance(const ShadowKnobs& knobs);

/// The image in this frame; created on first use, anew if its size or format has changed. Null, and the frame is given
/// up, if it cannot be created. takes_turns: the image in which views of the world take turns
/// (ShadowStates::take_turn), in place of the view's own.
[[nodiscard]] HistoryImage use_map_image(FrameBuilder& frame, const ViewFaces& view_faces, const ShadowKnobs& knobs,
                                         bool takes_turns, MapImage image);

}  // namespace gloam
