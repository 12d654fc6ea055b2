// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_DISPLAY_TONE_CURVE_GLSL
#define GLOAM_SHADERS_LIGHTING_DISPLAY_TONE_CURVE_GLSL

// Maps exposed linear light to displayed linear light, per channel:
//   0 filmic    x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)   (Narkowicz 2015, fit of the ACES curve)
//   1 reinhard  x / (1 + x)
//   2 linear    x
//   3 agx       see below
// x: in 0…1e6. Every curve has reached white at 1e6, and its square still fits a float.

const uint kCurveAgx = 3u;

// A curve like AgX (the idea: Troy Sobotka, AgX for Blender 4.0): colours are first drawn toward grey, so that no
// channel stays at 0, then each channel goes through a sigmoid of its stops, and colours are drawn back a little less.
// A bright saturated light thus fades to white and does not stay at the edge of the gamut. The numbers are ours: the
// sigmoid has the slope 2.4 at middle grey, which it shows as bright as filmic does, and ends in black and in white.
const float kAgxInset = 0.2;    // share of the channels' mean before the sigmoid
const float kAgxOutset = 0.15;  // share that is taken off after it
const float kAgxMiddle = 0.18;  // light of middle grey
const float kAgxShown = 0.267;  // displayed linear light of middle grey
const float kAgxBelow = 10.0;   // stops from black to middle grey
const float kAgxStops = 16.5;   // stops from black to white
const float kAgxSlope = 2.4;    // of the displayed value, to the power 1 / 2.2, over the share of the stops
const float kAgxPower = 2.2;

// A curve t / (1 + t³)^(1/3) from the origin, with slope kAgxSlope there, through (width, height).
vec3 agx_half(vec3 x, float width, float height) {
  float rise = kAgxSlope * width / height;
  float scale = kAgxSlope * width / pow(rise * rise * rise - 1.0, 1.0 / 3.0);
  vec3 t = kAgxSlope * x / scale;
  return scale * t * pow(1.0 + t * t * t, vec3(-1.0 / 3.0));
}

vec3 agx_sigmoid(vec3 x) {
  float middle = kAgxBelow / kAgxStops, shown = pow(kAgxShown, 1.0 / kAgxPower);
  vec3 share = (log2(max(x, vec3(1e-9)) / kAgxMiddle) + kAgxBelow) / kAgxStops;
  vec3 from_middle = clamp(share, vec3(0.0), vec3(1.0)) - middle;
  vec3 above = shown + agx_half(max(from_middle, vec3(0.0)), 1.0 - middle, 1.0 - shown);
  vec3 below = shown - agx_half(max(-from_middle, vec3(0.0)), middle, shown);
  vec3 value = mix(above, below, lessThan(from_middle, vec3(0.0)));
  return pow(clamp(value, vec3(0.0), vec3(1.0)), vec3(kAgxPower));
}

float channel_mean(vec3 x) { return (x.r + x.g + x.b) * (1.0 / 3.0); }

// The colour before and after the curve of each channel; most curves leave it as it is.
vec3 before_curve(uint curve, vec3 x) { return curve == kCurveAgx ? mix(x, vec3(channel_mean(x)), kAgxInset) : x; }
vec3 after_curve(uint curve, vec3 x) {
  if (curve != kCurveAgx) return x;
  return clamp((x - kAgxOutset * channel_mean(x)) / (1.0 - kAgxOutset), vec3(0.0), vec3(1.0));
}

// The curve of one channel.
vec3 tone_curve(uint curve, vec3 x) {
  vec3 shown = x;
  if (curve == 0u) shown = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (curve == 1u) shown = x / (1.0 + x);
  if (curve == kCurveAgx) shown = agx_sigmoid(x);
  return clamp(shown, vec3(0.0), vec3(1.0));
}

// Logarithmic axis of the table, in stops around 1: from the darkest visible value to where every curve is white.
const float kTableFirstStop = -12.0;
const float kTableStops = 20.0;

#endif
