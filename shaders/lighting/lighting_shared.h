// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_LIGHTING_SHARED_H
#define GLOAM_SHADERS_LIGHTING_LIGHTING_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_ACCUMULATED_FRAMES 16  // that an accumulated picture is the mean of at rest, at most 63

GLOAM_SHARED_BEGIN

/// Sky and ground, which light a scene besides its lights. Colours in cd/m² · light_scale.
struct EnvironmentConstants {
  vec4 zenith;
  vec4 horizon;
  vec4 ground;
};

/// Place of ScatteredLight in a picture.
struct ScatteredConstants {
  vec2 uv_scale;  // from pixels to the image
  vec2 uv_offset;
  float share;
};

/// Constants of the pass from linear light to picture.
struct ToneMapConstants {
  ScatteredConstants scattered;
  uint curve;        // of tone_curve.glsl
  uint metered;      // 1: `exposure` multiplies the metered exposure
  float exposure;    // factor for the view's light
  uint encode_srgb;  // 1: the target's format does not encode sRGB, so the shader does
};

/// Constants for tabulating a tone curve.
struct ToneTableConstants {
  uint curve;
  uint size;  // texels of the table
};

/// Constants for metering a view.
struct MeterConstants {
  uvec2 size;           // pixels of the picture
  float inverse_scale;  // 1 / light_scale
  uint frame;           // RenderView::frame: a frame that is drawn again keeps its exposure
  uint begins;          // 1: there is no exposure yet
  float to_bright;      // share of the way to a lower exposure, in stops, that this frame goes
  float to_dark;        // to a higher one
};

/// A metered exposure, over frames.
struct MeteredExposure {
  float exposure;  // factor from cd/m² to units in which 1 is white before the tone curve
  uint frame;      // of the newest frame that metered
};

// The largest rectangle that antialiasing blends at once; both divide 16.
#define GLOAM_BLEND_COLUMNS 16
#define GLOAM_BLEND_ROWS 8

/// Constants for edges and weights of antialiasing, and for blending with them.
struct AntialiasingConstants {
  uvec2 size;        // pixels of the picture
  uint encode_srgb;  // 1: the target's format does not encode sRGB, so the shader does
};

/// Constants for accumulating a picture over frames.
struct TemporalConstants {
  uvec2 size;       // pixels of the picture
  uvec2 view_size;  // of the frame, at most `size`
  vec2 jitter;      // RenderView::jitter
  uint known;       // 0: there is no previous frame
};

GLOAM_SHARED_END

#endif
