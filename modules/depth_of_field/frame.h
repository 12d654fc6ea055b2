// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/render/frame_builder.h"
#include "modules/depth_of_field/components.h"
#include "modules/depth_of_field/knobs.h"
#include "modules/depth_of_field/lens/lens.h"
#include "shaders/depth_of_field/depth_of_field_shared.h"

namespace gloam {

/// The layers of a view. Each image holds all levels (DofConstants::corner).
struct DofLayers {
  ImageRef far;   ///< rgba16f: prefilter.comp; gathered: light multiplied by its weight between texels in alpha
  ImageRef near;  ///< rgba16f: prefilter.comp; gathered: light multiplied by its share in alpha
};

/// Threads of a workgroup over listed tiles.
[[nodiscard]] constexpr std::int32_t dof_threads(bool threads_in_turn) {
  return threads_in_turn ? GLOAM_DOF_THREADS_IN_TURN : GLOAM_DOF_THREADS;
}
/// The value of the specialisation constant kHexagonal.
[[nodiscard]] constexpr std::uint32_t dof_hexagonal(Bokeh bokeh) { return bokeh == Bokeh::hexagonal ? 1u : 0u; }

/// Constants and images that the passes of a view read.
struct DofInputs {
  DofKnobs knobs;
  Bokeh bokeh = Bokeh::round;
  bool threads_in_turn = false;  ///< of the device
  uvec2 layers_size{1};          ///< of the images of all levels
  shaders::DofConstants constants{};
  gpu::Binding::BufferRange block;  ///< the constants
  ImageRef depth;
};

/// Tiles in which something is blurred.
struct DofTiles {
  BufferRef bounds;   ///< DofTileBounds of each tile
  BufferRef picture;  ///< DofPictureBounds
  BufferRef reach;    ///< DofTileReach of each tile
  BufferRef lists;    ///< DofList, GLOAM_DOF_LISTS of them
  BufferRef entries;  ///< list.comp
};

/// Pixels that are drawn as discs.
struct DofSprites {
  BufferRef tiles;     ///< DofTileSprites of each tile
  BufferRef sprites;   ///< DofSprite, GLOAM_DOF_TILE_SPRITES for each tile
  BufferRef reaching;  ///< sprites/reach.comp
};

/// A view's depth of field, for counters and visualizers. On the board after PassPhase::post.
struct DofFrame {
  DofInputs inputs;
  DofTiles tiles;
};

}  // namespace gloam
