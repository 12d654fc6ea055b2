// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Octahedral normals: Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer, "A Survey of Efficient Representations for
// Independent Unit Vectors" (JCGT 3(2), 2014), §3 "oct". sRGB: IEC 61966-2-1.
#include "engine/math/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gloam {
namespace {

/// Sign with sign(0) = 1, so that all points on a seam of the octahedron fold to the same side.
float sign_of(float v) { return v < 0.0f ? -1.0f : 1.0f; }

vec2 fold(float x, float y) { return {(1.0f - std::abs(y)) * sign_of(x), (1.0f - std::abs(x)) * sign_of(y)}; }

std::uint32_t snorm16(float v) {
  if (std::isnan(v)) return 0;
  const long rounded = std::lround(std::clamp(v, -1.0f, 1.0f) * 32767.0f);
  return static_cast<std::uint32_t>(rounded) & 0xffffu;
}

float from_snorm16(std::uint32_t bits) {
  const auto value = static_cast<std::int16_t>(bits & 0xffffu);
  return std::max(static_cast<float>(value) / 32767.0f, -1.0f);
}

}  // namespace

vec2 octahedral_encode(vec3 unit) {
  const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
  if (sum == 0.0f) return vec2(0.0f);
  const float x = unit.x / sum;
  const float y = unit.y / sum;
  return unit.z < 0.0f ? fold(x, y) : vec2(x, y);
}

vec3 octahedral_decode(vec2 code) {
  const float z = 1.0f - std::abs(code.x) - std::abs(code.y);
  const vec2 xy = z < 0.0f ? fold(code.x, code.y) : code;
  return glm::normalize(vec3(xy.x, xy.y, z));
}

std::uint32_t pack_normal_snorm16(vec3 unit) {
  const vec2 code = octahedral_encode(unit);
  return snorm16(code.x) | (snorm16(code.y) << 16);
}

vec3 unpack_normal_snorm16(std::uint32_t packed) {
  return octahedral_decode(vec2(from_snorm16(packed), from_snorm16(packed >> 16)));
}

std::uint16_t float_to_half(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  std::uint32_t half = 0;
  if (magnitude > 0x7f800000u) {
    half = 0x7e00u | ((magnitude >> 13) & 0x3ffu);  // quiet NaN with the payload's upper bits
  } else if (magnitude >= 0x477ff000u) {            // ≥ 65520, halfway from the greatest half to 65536: infinity
    half = 0x7c00u;
  } else if (magnitude >= 0x38800000u) {  // ≥ 2⁻¹⁴: normal. Rounding may correctly carry into the exponent.
    half = (magnitude - 0x38000000u + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
  } else if (magnitude >= 0x33000000u) {  // ≥ 2⁻²⁵: denormal, or rounds to the least denormal
    const std::uint32_t shift = 126u - (magnitude >> 23);
    const std::uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u;
    half = (mantissa + (1u << (shift - 1u)) - 1u + ((mantissa >> shift) & 1u)) >> shift;
  }
  return static_cast<std::uint16_t>(sign | half);
}

float half_to_float(std::uint16_t half) {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000u) << 16;
  const std::uint32_t exponent = (half >> 10) & 0x1fu;
  const std::uint32_t mantissa = half & 0x3ffu;
  if (exponent == 0) {
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign != 0 ? -magnitude : magnitude;
  }
  const std::uint32_t wide_exponent = exponent == 31 ? 255u : exponent + 112u;
  return std::bit_cast<float>(sign | (wide_exponent << 23) | (mantissa << 13));
}

}  // namespace gloam
