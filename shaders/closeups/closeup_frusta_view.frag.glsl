// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/closeups/closeup_views_api.glsl"

// Visualizer of close-up pairs: frusta as lines over the picture, umbra ranges tinted and framed, one colour per pair.

layout(set = 0, binding = 3, scalar) readonly buffer Lines { CloseupLine lines[]; };

const float kTint = 0.16;    // opacity of the tiles of a single pair; less for several, which would hide the picture
const float kFrame = 0.7;    // opacity of the outermost pixels of the tiles' rectangle
const float kHidden = 0.25;  // opacity of lines behind surfaces

// Blends a colour over a premultiplied one.
vec4 over(vec4 below, vec3 color, float opacity) { return below * (1.0 - opacity) + vec4(color, 1.0) * opacity; }

bool in_frame(ShownCloseup closeup, uvec2 pixel) {
  uvec2 low = closeup.first_tile * uint(GLOAM_SHADOW_TILE),
        high = min(closeup.end_tile * uint(GLOAM_SHADOW_TILE), view.size) - 1u;
  return any(equal(pixel, low)) || any(equal(pixel, high));
}

float line_opacity(CloseupLine line, vec2 at, float depth) {
  vec2 along = line.to - line.from, from = at - line.from;
  float share = clamp(dot(from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  float opacity = clamp(GLOAM_CLOSEUP_LINE_REACH - length(from - share * along), 0.0, 1.0);
  bool hidden = depth > 0.0 && mix(line.from_depth, line.to_depth, share) < depth;
  return hidden ? opacity * kHidden : opacity;
}

// Where lines of one pair meet, the greatest opacity counts.
float lines_opacity(ShownCloseup closeup, vec2 at, float depth) {
  if (any(lessThan(at, closeup.lines_low)) || any(greaterThan(at, closeup.lines_high))) return 0.0;
  float opacity = 0.0;
  for (uint i = 0u; i < closeup.line_count; ++i)
    opacity = max(opacity, line_opacity(lines[closeup.first_line + i], at, depth));
  return opacity;
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  vec4 color = vec4(0.0);
  float tint = kTint * 2.0 / float(closeup_count + 1u);
  for (uint i = 0u; i < closeup_count; ++i)
    if (in_tiles(closeups[i], pixel))
      color = over(color, closeups[i].color, in_frame(closeups[i], pixel) ? kFrame : tint);
  float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  for (uint i = 0u; i < closeup_count; ++i)
    color = over(color, closeups[i].color, lines_opacity(closeups[i], vec2(pixel) + 0.5, depth));
  show(color.rgb / max(color.a, 1e-6), color.a);
}
