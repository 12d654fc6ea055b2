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

/// The layers of a view: light behind the focus, before it, and not before it.
struct DofLayers {
  ImageRef far;   ///< rgba16f: light, and the circle of confusion as a share of dof.radius; 0: not blurred
  ImageRef near;  ///< rgba16f: light multiplied by its share in alpha
  /// As `near`, of all light that is not in it. Blurred like `near`, it stands for what objects before the focus hide.
  ImageRef beyond;
};

/// Constants and images that the passes of a view read.
struct DofInputs {
  DofKnobs knobs;
  Bokeh bokeh = Bokeh::round;
  shaders::DofConstants constants{};
  gpu::Binding::BufferRange block;  ///< the constants
  ImageRef depth;

  [[nodiscard]] std::uint32_t scale() const { return knobs.scale(); }
};

/// Tiles in which something is blurred.
struct DofTiles {
  ImageRef reach;     ///< reach.comp
  BufferRef lists;    ///< DofList, GLOAM_DOF_LISTS of them
  BufferRef entries;  ///< list.comp
  BufferRef flags;    ///< list.comp
};

/// A view's depth of field, for counters and visualizers. On the board after PassPhase::post.
struct DofFrame {
  DofInputs inputs;
  DofTiles tiles;
};

}  // namespace gloam
