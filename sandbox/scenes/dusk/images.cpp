// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/dusk/images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/math/types.h"
#include "sandbox/scenes/dusk/model.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSettsTexels = 256;
constexpr int kSettRows = 20;     // in the height of the image; even, since rows alternate
constexpr int kSettColumns = 14;  // in its width

constexpr std::uint32_t kSkyWidth = 1024, kSkyHeight = 320;
constexpr float kSkyLowest = -0.06f;    // radians
constexpr float kGlowAzimuth = 0.022f;  // of a turn: where the sun has set

Image blank_image(const char* name, std::uint32_t width, std::uint32_t height) {
  Image image{.name = name, .width = width, .height = height, .rgba = {}};
  image.rgba.reserve(std::size_t{4} * width * height);
  return image;
}

void push_texel(Image& image, vec3 value) {
  for (int i = 0; i < 3; ++i)
    image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value[i], 0.0f, 1.0f) * 255.0f)));
  image.rgba.push_back(255);
}

float to_srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f; }

float step_between(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// The stone of a texel.
struct Sett {
  float height;        ///< 0 in the joints, about 1 on top
  std::uint32_t name;  ///< of the stone, for random numbers
};

Sett sett_at(float u, float v) {
  const float y = v * kSettRows;
  const auto row = static_cast<std::uint32_t>(y) % kSettRows;
  const float shift = row % 2 == 0 ? 0.0f : 0.5f;
  const float wobble = 0.25f * (dusk_scatter(row, 5u) - 0.5f);
  float x = u * kSettColumns + shift + wobble;
  x = std::fmod(x + kSettColumns, static_cast<float>(kSettColumns));
  const auto column = static_cast<std::uint32_t>(x);
  const std::uint32_t name = row * 64u + column;
  const float in_x = x - static_cast<float>(column), in_y = y - std::floor(y);
  const float across = std::min(in_x, 1.0f - in_x) * 0.171f, along = std::min(in_y, 1.0f - in_y) * 0.12f;
  const float edge = std::min(across, along);  // metres from the middle of the joint
  const float crown = 1.0f - 0.35f * (std::pow(2.0f * in_x - 1.0f, 2.0f) + std::pow(2.0f * in_y - 1.0f, 2.0f));
  return {step_between(0.003f, 0.022f, edge) * crown * (0.85f + 0.3f * dusk_scatter(name, 2u)), name};
}

float lattice_noise(float x, float y, std::uint32_t period, std::uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::uint32_t>(static_cast<int>(fx) + 64 * static_cast<int>(period)) % period;
  const auto iy = static_cast<std::uint32_t>(static_cast<int>(fy) + 512);
  const float tx = step_between(0.0f, 1.0f, x - fx), ty = step_between(0.0f, 1.0f, y - fy);
  const std::uint32_t next = (ix + 1u) % period;
  const auto value = [&](std::uint32_t column, std::uint32_t row) { return dusk_scatter(column, row * 7u + seed); };
  return glm::mix(glm::mix(value(ix, iy), value(next, iy), tx), glm::mix(value(ix, iy + 1u), value(next, iy + 1u), tx),
                  ty);
}

/// Streaks of cloud, about 0.5 in the mean. u repeats after 1.
float cloud_noise(float u, float elevation) {
  float sum = 0.0f, weight = 0.5f;
  float x = u * 12.0f, y = elevation * 16.0f;
  std::uint32_t period = 12;
  for (std::uint32_t octave = 0; octave < 5; ++octave) {
    sum += weight * lattice_noise(x + 0.6f * y, y, period, 31u * octave);
    x *= 2.0f, y *= 2.0f, period *= 2u, weight *= 0.5f;
  }
  return sum / 0.97f;
}

/// Height of the far town and its trees above the horizon, radians.
float skyline(float u) {
  const float hills =
      0.022f + 0.016f * std::sin(u * 2.0f * kPi * 3.0f + 1.0f) + 0.010f * std::sin(u * 2.0f * kPi * 7.0f);
  const auto house = static_cast<std::uint32_t>(u * 170.0f);
  const float in_house = u * 170.0f - static_cast<float>(house);
  const float gable = 0.014f * (1.0f - std::abs(2.0f * in_house - 1.0f));
  float top = hills + 0.018f * dusk_scatter(house, 3u) + (dusk_scatter(house, 4u) > 0.5f ? gable : 0.004f);
  const float trees = lattice_noise(u * 240.0f, 1.0f, 240u, 77u);
  if (lattice_noise(u * 18.0f, 2.0f, 18u, 9u) > 0.52f) top = hills + 0.012f + 0.026f * trees;
  return top;
}

vec3 sky_color(float u, float elevation) {
  float turn = std::abs(u - kGlowAzimuth);
  turn = std::min(turn, 1.0f - turn) * 2.0f * kPi;
  const float glow = std::exp(-turn * turn / 0.9f), wide_glow = std::exp(-turn * turn / 3.2f);
  const float up = std::max(elevation, 0.0f);
  if (elevation < skyline(u)) {
    const auto cell_x = static_cast<std::uint32_t>(u * 1024.0f),
               cell_y = static_cast<std::uint32_t>((elevation + 1.0f) * 260.0f);
    const bool is_lit = elevation > 0.006f && dusk_scatter(cell_x, cell_y) > 0.975f;
    const vec3 haze = glm::mix(vec3(0.012f, 0.015f, 0.026f), vec3(0.045f, 0.025f, 0.026f), glow);
    return is_lit ? vec3(0.42f, 0.24f, 0.09f) : haze;
  }
  const float high = std::pow(std::min(up / (0.5f * kPi), 1.0f), 0.6f);
  vec3 color = glm::mix(vec3(0.050f, 0.085f, 0.190f), vec3(0.007f, 0.024f, 0.088f), high);
  color *= 1.0f - 0.75f * glow * std::exp(-up / 0.12f);
  color += wide_glow * std::exp(-up / 0.20f) * vec3(0.135f, 0.060f, 0.066f);
  color += glow * std::exp(-up / 0.13f) * vec3(0.52f, 0.17f, 0.055f);
  color += glow * std::exp(-up / 0.075f) * vec3(0.66f, 0.25f, 0.03f);
  const float cover = step_between(0.47f, 0.66f, cloud_noise(u, elevation)) * step_between(0.02f, 0.10f, elevation) *
                      step_between(1.1f, 0.45f, elevation);
  const vec3 lit = glow * std::exp(-up / 0.20f) * vec3(0.95f, 0.30f, 0.12f) +
                   wide_glow * std::exp(-up / 0.30f) * vec3(0.17f, 0.060f, 0.070f) + vec3(0.020f, 0.034f, 0.080f);
  return glm::mix(color, lit, 0.72f * cover);
}

}  // namespace

SettsImages setts_images() {
  SettsImages out{.color = blank_image("setts", kSettsTexels, kSettsTexels),
                  .normal = blank_image("setts normal", kSettsTexels, kSettsTexels),
                  .roughness = blank_image("setts roughness", kSettsTexels, kSettsTexels)};
  constexpr float kTexel = 1.0f / kSettsTexels;
  constexpr float kDepth = 0.011f / (2.0f * kTexel * kSettsSide_m);  // height of a stone ÷ the distance of two texels
  for (std::uint32_t row = 0; row < kSettsTexels; ++row) {
    for (std::uint32_t column = 0; column < kSettsTexels; ++column) {
      const float u = (static_cast<float>(column) + 0.5f) * kTexel, v = (static_cast<float>(row) + 0.5f) * kTexel;
      const auto height = [&](float du, float dv) {
        return sett_at(std::fmod(u + du + 1.0f, 1.0f), std::fmod(v + dv + 1.0f, 1.0f)).height;
      };
      const Sett sett = sett_at(u, v);
      const float top = std::clamp(sett.height, 0.0f, 1.0f), shade = 0.75f + 0.5f * dusk_scatter(sett.name, 6u);
      const vec3 stone = glm::mix(vec3(0.40f, 0.39f, 0.40f), vec3(0.46f, 0.40f, 0.36f), dusk_scatter(sett.name, 8u));
      push_texel(out.color, glm::mix(vec3(0.17f, 0.16f, 0.15f), stone * shade, top));
      const vec3 normal = glm::normalize(vec3(kDepth * (height(-kTexel, 0.0f) - height(kTexel, 0.0f)),
                                              kDepth * (height(0.0f, kTexel) - height(0.0f, -kTexel)), 1.0f));
      push_texel(out.normal, 0.5f * normal + 0.5f);
      push_texel(out.roughness, {0.0f, glm::mix(0.85f, 0.30f + 0.2f * dusk_scatter(sett.name, 9u), top), 0.0f});
    }
  }
  return out;
}

float sky_elevation(float v) {
  const float share = 1.0f - v;  // 0 at the lowest row
  return kSkyLowest + (0.5f * kPi - kSkyLowest) * std::pow(share, 1.7f);
}

Image dusk_sky_image() {
  Image image = blank_image("dusk sky", kSkyWidth, kSkyHeight);
  for (std::uint32_t row = 0; row < kSkyHeight; ++row) {
    const float elevation = sky_elevation((static_cast<float>(row) + 0.5f) / kSkyHeight);
    for (std::uint32_t column = 0; column < kSkyWidth; ++column) {
      const vec3 color = sky_color((static_cast<float>(column) + 0.5f) / kSkyWidth, elevation);
      push_texel(image, {to_srgb(color.x / kBrightestSky), to_srgb(color.y / kBrightestSky),
                         to_srgb(color.z / kBrightestSky)});
    }
  }
  return image;
}

}  // namespace gloam
