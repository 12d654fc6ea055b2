// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_DRAWING_PIXEL_WIDTH_GLSL
#define GLOAM_SHADERS_GRASS_DRAWING_PIXEL_WIDTH_GLSL

// Blades that are narrower than a pixel, by distance, taper or because they are seen edge-on, would be drawn as dashes.
// They are drawn as lines one pixel wide, each up to where its width falls below a threshold of its own, so all blades
// together cover as much as they should and each is one line. Thresholds are spread evenly over blades and do not
// change over time.

const float kWidestCoverage = 4.0;  // so that interpolation between narrow and wide places stays near the true width

// A corner of a blade on the screen.
struct PixelCorner {
  vec4 position;   // clip space
  float coverage;  // width over the width that is drawn; above 1 if it is not widened
};

// middle, corner: clip positions of the stem and of the corner; ahead: of a point farther along the stem. size: of the
// picture, pixels.
PixelCorner pixel_corner(vec4 middle, vec4 corner, vec4 ahead, vec2 size) {
  PixelCorner c = PixelCorner(corner, kWidestCoverage);
  if (min(middle.w, min(corner.w, ahead.w)) <= 1e-6) return c;
  vec2 at = middle.xy / middle.w;
  vec2 along = (ahead.xy / ahead.w - at) * size;
  float len = length(along);
  vec2 across = len > 1e-6 ? vec2(-along.y, along.x) / len : vec2(1.0, 0.0);
  float half_width = dot((corner.xy / corner.w - at) * (0.5 * size), across);
  // A line is connected from row to row, or from column to column; a little wider, because it is bent at knots.
  float least = 0.53 * max(abs(across.x), abs(across.y));
  c.coverage = min(abs(half_width) / least, kWidestCoverage);
  vec2 offset = across * ((half_width < 0.0 ? -least : least) * 2.0 / size);
  if (c.coverage < 1.0) c.position = vec4(middle.xy + offset * middle.w, middle.zw);
  return c;
}

// Whether a pixel of a blade is not drawn. threshold: of the blade, 0…1.
bool is_left_out(float coverage, float threshold) { return coverage < threshold; }

// The same for a blade with an image, which shows where alpha is at least 0.5. Pixels about as wide as the blade have
// the mean alpha across it: there alpha is a part of the coverage, so thin shapes neither vanish nor fill out.
bool is_cut_out(float coverage, float alpha, float threshold) {
  float near = clamp((coverage - 1.0) / (kWidestCoverage - 1.0), 0.0, 1.0);
  return min(coverage, 1.0) * alpha < max(mix(threshold, 0.5, near), 1.0 / 255.0);
}

#endif
