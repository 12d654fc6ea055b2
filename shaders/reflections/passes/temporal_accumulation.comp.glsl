// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/motion_api.glsl"
#include "shaders/render/view_shared.h"

// Accumulates reflections over frames. Each frame shows another pixel of each block (first_candidate), so the mean over
// frames is that of the block, and the result stands for the middle of the block. A reflection is looked up where its
// mirror image was in the previous frame: the point as far behind the mirror as the hit is in front of it. What was
// there is limited to the range of colours around the texel now, so that nothing lags behind that has moved or was
// hidden, and counts for as many frames as it has seen.

layout(local_size_x = GLOAM_REFLECTION_GROUP, local_size_y = GLOAM_REFLECTION_GROUP) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2, scalar) uniform MotionBlock { MotionConstants motion; };
layout(set = 0, binding = 3) uniform usampler2D mirror_image;
layout(set = 0, binding = 4) uniform sampler2D surface_image;
layout(set = 0, binding = 5) uniform sampler2D color_image;
layout(set = 0, binding = 6) uniform sampler2D previous_image;
layout(set = 0, binding = 7) uniform sampler2D previous_count;  // frames / kMostFrames, packed distance in yz
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D accumulated_image;
layout(set = 0, binding = 9, rgba8) uniform writeonly image2D count_image;

layout(push_constant, scalar) uniform Push { uint known; };  // 0: there is no previous frame

#include "shaders/reflections/mirror_surface_api.glsl"

const float kMostFrames = 4.0;   // that the mean is taken over
const float kDeviations = 1.25;  // of the colours around a texel, that the history may differ by
const float kFarther = 1.5;      // ratio of distances from which on the history shows something else

struct ColorRange {
  vec4 low, high;
};

// Range of the colours of the reflecting texels around a texel: mean and deviations, within the least and greatest.
ColorRange color_range(ivec2 texel) {
  vec4 low = vec4(65504.0), high = vec4(0.0), sum = vec4(0.0), squares = vec4(0.0);
  float count = 0.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 at = clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), ivec2(reflection.size) - 1);
    bool reflects = texelFetch(surface_image, at, 0).y > 0.0;
    vec4 color = texelFetch(color_image, at, 0);
    color = reflects ? color : vec4(0.0);  // texels of other tiles hold no values
    low = reflects ? min(low, color) : low;
    high = max(high, color);
    sum += color;
    squares += color * color;
    count += reflects ? 1.0 : 0.0;
  }
  vec4 mean = sum / max(count, 1.0);
  vec4 apart = kDeviations * sqrt(max(squares / max(count, 1.0) - mean * mean, vec4(0.0)));
  return ColorRange(max(low, mean - apart), min(high, mean + apart));
}

// Where the mirror image was on the previous screen, in pixels, less where the pixel is now. Far away: nowhere.
vec2 mirrored_motion(MirrorSurface s, float distance_m) {
  vec3 seen = vec3(s.direction.x, -s.direction.y, s.direction.z);
  vec3 clip = previous_clip_at_rest(motion, s.position + seen * distance_m);
  vec2 at = (0.5 + clip.xy / (clip.z > 0.0 ? clip.z : 1.0) * vec2(0.5, -0.5)) * vec2(view.size) - 0.5;
  return clip.z > 0.0 ? at - vec2(s.pixel) : vec2(-1e6);
}

// The previous image at a place (texels, centres at halves), by the Catmull-Rom spline: it does not blur. Five fetches.
vec4 sharp_previous(vec2 at) {
  vec2 size = vec2(reflection.size), center = floor(at - 0.5) + 0.5, f = at - center;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w12 = 1.0 - w0 - w3;
  vec2 middle = (center + (w12 - w1) / w12) / size, before = (center - 1.0) / size, after = (center + 2.0) / size;
  vec4 sum = textureLod(previous_image, middle, 0.0) * (w12.x * w12.y);
  sum += textureLod(previous_image, vec2(before.x, middle.y), 0.0) * (w0.x * w12.y);
  sum += textureLod(previous_image, vec2(after.x, middle.y), 0.0) * (w3.x * w12.y);
  sum += textureLod(previous_image, vec2(middle.x, before.y), 0.0) * (w12.x * w0.y);
  sum += textureLod(previous_image, vec2(middle.x, after.y), 0.0) * (w12.x * w3.y);
  float total = (w12.x + w0.x + w3.x) * w12.y + w12.x * (w0.y + w3.y);
  return max(sum / total, vec4(0.0));
}

// Frames that the previous image has seen of this reflection. stored: what previous_count holds there.
float frames_seen(vec4 stored, float distance_m) {
  float before_m = reflection.unit_m * unpack_hit_distance(stored.yz);
  bool same = max(before_m, distance_m) <= kFarther * min(before_m, distance_m) + 0.1 * reflection.unit_m;
  float frames = floor(stored.x * 255.0 + 0.5);
  return same ? frames : min(frames, 1.0);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(texel), reflection.size))) return;
  vec4 color = vec4(0.0), count = vec4(0.0), surface = texelFetch(surface_image, texel, 0);
  if (surface.y > 0.0) {
    MirrorSurface s = decode_mirror_surface(texelFetch(mirror_image, texel, 0).xy, texel);
    color = texelFetch(color_image, texel, 0);
    vec2 stored_m = surface.zw;
    float distance_m = reflection.unit_m * unpack_hit_distance(stored_m);
    vec2 at = vec2(texel) + 0.5 + mirrored_motion(s, distance_m) / float(reflection.scale);
    bool inside = known != 0u && all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(reflection.size)));
    ivec2 nearest = clamp(ivec2(floor(at)), ivec2(0), ivec2(reflection.size) - 1);
    float frames = inside ? frames_seen(texelFetch(previous_count, nearest, 0), distance_m) : 0.0;
    ColorRange range = color_range(texel);
    vec4 before = frames > 0.0 ? clamp(sharp_previous(at), range.low, range.high) : color;
    color = mix(before, color, 1.0 / (1.0 + frames));
    count = vec4(min(frames + 1.0, kMostFrames - 1.0) / 255.0, stored_m, 0.0);
  }
  imageStore(accumulated_image, texel, color);
  imageStore(count_image, texel, count);
}
