// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/antialiasing/temporal_state.glsl"
#include "shaders/lighting/lighting_shared.h"

// Accumulates the displayed linear light of a view whose frames show different points of the pixels. A pixel takes its
// history from where its surface was in the previous frame, and limits it to the range of the colours around it now
// (Salvi 2016, "An Excursion in Temporal Supersampling"). Changes to that method:
// - Where nothing has moved for some frames, the history is limited only after several frames in a row in which it was
//   out of range: otherwise a wire that few frames show would flicker.
// - The history counts for as many frames as it has seen, so at rest it is their mean.
// - Light without motion (sprites) leaves little of the history.
// - The picture may be larger than the frame. A frame then shows a point of some of the picture's pixels only, and only
//   these pixels add it. Until a pixel has seen enough points, a filter over the points around it stands in for them.

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint kEnlarges = 0u;

layout(push_constant, scalar) uniform Push { TemporalConstants c; };
layout(set = 0, binding = 0) uniform sampler2D shown_image;  // alpha: share of light without motion
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D motion_image;
layout(set = 0, binding = 3) uniform sampler2D previous_image;  // alpha: packed PixelState
layout(set = 0, binding = 4) uniform sampler2D previous_motion;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D accumulated_image;
layout(set = 0, binding = 6, rg16f) uniform writeonly image2D kept_motion;

// What a point inside the pixel adds to PixelState::frames. More than 1, so that a filtered colour can count less.
const float kWhole = kEnlarges != 0u ? 4.0 : 1.0;
// Of the colours around a pixel, that the history may differ by. At rest it may differ by more in a larger picture: a
// frame has fewer points than that has pixels.
const float kDeviations = 1.0;
const float kDeviationsAtRest = kEnlarges != 0u ? 1.5 : 1.0;
const float kRounding = 0.0005;  // of displayed light, that the history may differ by as well
// That the mean is taken over, at rest and where the picture moves; at most 63.
const float kMostFrames = kEnlarges != 0u ? 63.0 : float(GLOAM_ACCUMULATED_FRAMES);
const float kMostFramesMoving = kEnlarges != 0u ? 8.0 : 6.0;  // each look-up between texels blurs
// Frames in a row out of range, at rest, until the history is limited.
const float kPatience = kEnlarges != 0u ? 7.0 : 4.0;
const float kStill = 0.02;       // pixels a frame: less motion counts as rest
const float kOtherMotion = 0.5;  // pixels: a greater change of motion shows another surface
// That a history of another motion counts for where the picture moves; 0 elsewhere. Frames hit and miss a wire before
// the sky in turn, and a wire without a history is a row of dashes.
const float kFramesOther = kEnlarges != 0u ? 2.0 : 1.0;
const float kFramesLimited = 4.0;  // that a history counts for which has been limited
const float kFramesLimitedAtRest = kEnlarges != 0u ? 16.0 : 4.0;
const float kTrusted = 16.0;      // of a larger picture: the history that points are added to as they are
const float kSpriteFrames = 1.0;  // frames that the history counts for under opaque sprites

vec3 finite(vec3 color) { return mix(vec3(0.0), color, lessThan(abs(color), vec3(65504.0))); }

// Brightness and two differences of colours, in which ranges of similar colours are small.
vec3 to_ycocg(vec3 rgb) {
  return vec3(dot(rgb, vec3(0.25, 0.5, 0.25)), 0.5 * (rgb.r - rgb.b), rgb.g - 0.5 * (rgb.r + rgb.b));
}
vec3 from_ycocg(vec3 y) {
  float rb = y.x - 0.5 * y.z;
  return vec3(rb + y.y, y.x + 0.5 * y.z, rb - y.y);
}

// The previous image at a place (texels, centres at halves), by the Catmull-Rom spline: it does not blur. Five fetches:
// the corners of the 4x4 texels have little weight.
vec3 sharp_previous(vec2 at) {
  vec2 size = vec2(c.size), center = floor(at - 0.5) + 0.5, f = at - center;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w12 = 1.0 - w0 - w3;
  vec2 middle = (center + (w12 - w1) / w12) / size, before = (center - 1.0) / size, after = (center + 2.0) / size;
  vec3 sum = textureLod(previous_image, middle, 0.0).rgb * (w12.x * w12.y);
  sum += textureLod(previous_image, vec2(before.x, middle.y), 0.0).rgb * (w0.x * w12.y);
  sum += textureLod(previous_image, vec2(after.x, middle.y), 0.0).rgb * (w3.x * w12.y);
  sum += textureLod(previous_image, vec2(middle.x, before.y), 0.0).rgb * (w12.x * w0.y);
  sum += textureLod(previous_image, vec2(middle.x, after.y), 0.0).rgb * (w12.x * w3.y);
  return max(sum / ((w12.x + w0.x + w3.x) * w12.y + w12.x * (w0.y + w3.y)), vec3(0.0));
}

struct Around {
  vec3 color;      // of the pixel
  vec3 filtered;   // what the points around the pixel make of it, if the picture is larger than the frame
  float weight;    // of that colour, as PixelState::frames counts
  float sprites;   // share of light without motion, greatest around
  vec3 mean;       // of 3x3 pixels, YCoCg
  vec3 deviation;  // YCoCg
  vec2 motion;     // of the nearest surface
};

// Lanczos' kernel with two lobes, as a polynomial (shaders/sandbox/upscale.frag.glsl).
float kernel(float x) {
  float x2 = min(x * x, 4.0), a = 0.4 * x2 - 1.0, b = 0.25 * x2 - 1.0;
  return (25.0 / 16.0 * a * a - 9.0 / 16.0) * (b * b);
}

// at: centre of the pixel, in pixels of the frame.
Around look_around(vec2 at) {
  Around a;
  vec3 sum = vec3(0.0), squares = vec3(0.0), low = vec3(65504.0), high = vec3(0.0);
  vec4 filtered = vec4(0.0);
  float nearest = -1.0;
  ivec2 center = ivec2(floor(kEnlarges != 0u ? at - c.jitter : at)), nearest_at = center;
  a.sprites = 0.0;
  int i = 0;
  do {
    ivec2 pixel = center + ivec2(i % 3 - 1, i / 3 - 1), inside = clamp(pixel, ivec2(0), ivec2(c.view_size) - 1);
    vec4 texel = texelFetch(shown_image, inside, 0);
    vec3 color = finite(texel.rgb), y = to_ycocg(color);
    float depth = texelFetch(depth_image, inside, 0).r;
    a.color = i == 4 ? color : a.color;
    a.sprites = max(a.sprites, texel.a);
    sum += y;
    squares += y * y;
    if (kEnlarges != 0u) {
      vec2 apart = vec2(pixel) + 0.5 + c.jitter - at;
      filtered += vec4(color, 1.0) * (kernel(apart.x) * kernel(apart.y));
      low = min(low, color);
      high = max(high, color);
    }
    nearest_at = depth > nearest ? inside : nearest_at;
    nearest = max(nearest, depth);
  } while (++i < 9);
  a.mean = sum / 9.0;
  a.deviation = sqrt(max(squares / 9.0 - a.mean * a.mean, vec3(0.0)));
  a.motion = texelFetch(motion_image, nearest_at, 0).xy;
  a.weight = 1.0;
  if (kEnlarges != 0u) {
    vec2 scale = vec2(c.size) / vec2(c.view_size);
    a.motion *= scale;
    vec2 apart = abs(vec2(center) + 0.5 + c.jitter - at) * scale;
    a.weight = max(apart.x, apart.y) <= 0.5 ? kWhole : 0.0;
    a.filtered = clamp(filtered.rgb / filtered.a, low, high);
    if (a.weight == 0.0) a.color = a.filtered;
  }
  return a;
}

// How many times farther from the mean the history is than it may be; at most 1: it is in range.
float excess(vec3 history, Around a, float deviations) {
  vec3 apart = abs(history - a.mean), allowed = deviations * a.deviation + kRounding;
  vec3 ratio = apart / allowed;
  return max(max(ratio.x, ratio.y), ratio.z);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(pixel), c.size))) return;
  Around a = look_around((vec2(pixel) + 0.5) * vec2(c.view_size) / vec2(c.size));
  bool still = max(abs(a.motion.x), abs(a.motion.y)) < kStill;
  vec2 at = vec2(pixel) + 0.5 - (still ? vec2(0.0) : a.motion);
  bool inside = c.known != 0u && all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(c.size)));
  at = inside ? at : vec2(pixel) + 0.5;
  ivec2 nearest = ivec2(at);

  PixelState state = unpack_state(inside ? texelFetch(previous_image, nearest, 0).a : 0.0);
  vec2 other = abs(a.motion - texelFetch(previous_motion, nearest, 0).xy);
  bool same = max(other.x, other.y) <= kOtherMotion + 0.25 * max(abs(a.motion.x), abs(a.motion.y));
  state.frames = inside ? (same ? state.frames : still ? 0.0 : min(state.frames, kFramesOther)) : 0.0;
  state.still = still ? min(state.still + 1.0, kStillFrames) : 0.0;
  state.frames = min(state.frames, still ? kMostFrames : kMostFramesMoving);
  state.frames = min(state.frames, 1.0 / mix(1.0 / kMostFrames, 1.0 / kSpriteFrames, min(a.sprites, 1.0)));

  vec3 history = to_ycocg(finite(sharp_previous(at)));
  float over = excess(history, a, state.still < kStillFrames ? kDeviations : kDeviationsAtRest);
  bool out_of_range = over > 1.0;
  state.missed = out_of_range ? min(state.missed + 1.0, kMostMissed) : 0.0;
  bool limit = out_of_range && (state.still < kStillFrames || state.missed >= kPatience);
  if (limit) {
    history = a.mean + (history - a.mean) / over;
    state.frames = min(state.frames, state.still < kStillFrames ? kFramesLimited : kFramesLimitedAtRest);
    state.missed = 0.0;
  }
  vec3 before = from_ycocg(history);
  if (kEnlarges != 0u && state.frames < kTrusted) {
    // Points alone would show as dots in pixels whose neighbours have none.
    float trust = state.frames / kTrusted;
    a.color = mix(a.filtered, a.color, trust);
    a.weight = floor(mix(2.0, a.weight, trust) + 0.5);
  }
  vec3 color = state.frames > 0.0 ? mix(before, a.color, a.weight / (a.weight + state.frames)) : a.color;
  state.frames = min(state.frames + a.weight, kMostFrames);
  imageStore(accumulated_image, pixel, vec4(clamp(color, vec3(0.0), vec3(65504.0)), pack_state(state)));
  imageStore(kept_motion, pixel, vec4(a.motion, 0.0, 0.0));
}
