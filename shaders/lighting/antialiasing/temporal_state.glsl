// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ANTIALIASING_TEMPORAL_STATE_GLSL
#define GLOAM_SHADERS_LIGHTING_ANTIALIASING_TEMPORAL_STATE_GLSL

const float kStillFrames = 3.0;
const float kMostMissed = 7.0;

// What a pixel's accumulated light stands for. Packed into an integer below 2048, which a half float holds exactly.
struct PixelState {
  float frames;  // that the light is the mean of, up to 63; 0: there is none
  float still;   // frames in a row without motion, up to kStillFrames
  float missed;  // frames in a row in which the history was out of range
};

float pack_state(PixelState s) { return s.frames + 64.0 * (s.still + 4.0 * s.missed); }

PixelState unpack_state(float packed) {
  packed = packed >= 0.0 && packed < 2048.0 ? floor(packed + 0.5) : 0.0;
  float upper = floor(packed / 64.0), missed = floor(upper / 4.0);
  return PixelState(packed - 64.0 * upper, upper - 4.0 * missed, missed);
}

#endif
