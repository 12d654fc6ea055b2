// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"

namespace gloam {

/// Format of the displayed linear light that antialiasing reads; alpha is the brightness to the eye, 0…1.
inline constexpr gpu::Format kShownFormat = gpu::Format::rgba16_float;

/// Whether the picture of this view is antialiased: lighting.antialiasing is on, and neither a reference is drawn nor a
/// visualizer, except those with VisualizerIsPicture.
[[nodiscard]] bool antialiases(const FrameBuilder& frame);

struct AntialiasingWeights {
  /// A word for each pixel, row by row: the shares that its upper, lower, left and right neighbours cover, 8 bits each.
  /// Undefined for pixels without a bit in masks; they have no share.
  BufferRef weights;
  BufferRef masks;  ///< a bit for each pixel, (width + 31) / 32 words for a row
  /// Rectangles of pixels that hold all pixels with a share, as blend.vert.glsl reads them, and the draw of them.
  BufferRef rectangles;
  BufferRef command;
};
/// shown: of kShownFormat and the view's size.
[[nodiscard]] AntialiasingWeights add_antialiasing_weights(FrameBuilder& frame, ImageRef shown);

/// Antialiases the picture in TargetOutput: draws the pixels again that their neighbours cover a share of. shown: the
/// displayed light of the picture. dither: rounds it to 8 bits by the pattern of lighting.dither.
void add_antialiasing_passes(FrameBuilder& frame, ImageRef shown, bool dither);

}  // namespace gloam
