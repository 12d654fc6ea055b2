// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/blade_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/math/packing.h"

namespace gloam {
namespace {

constexpr float kTurn = 2.0f * kPi;

/// round(value · most) for values in [0, 1]; values outside and NaN are clamped.
std::uint32_t to_unorm(float value, float most) {
  if (!(value > 0.0f)) return 0;
  return static_cast<std::uint32_t>(std::min(value, 1.0f) * most + 0.5f);
}
float from_unorm(std::uint32_t bits, float most) { return static_cast<float>(bits) / most; }

std::uint32_t to_snorm8(float value) {
  const float clamped = value >= -1.0f ? std::min(value, 1.0f) : -1.0f;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(clamped * 127.0f + 0.5f))) & 0xffu;
}
float from_snorm8(std::uint32_t bits) {
  return std::max(static_cast<float>(static_cast<std::int8_t>(bits & 0xffu)) / 127.0f, -1.0f);
}

/// Position between `from` and `to` in 1/65535; 0 in a box without size.
std::uint32_t to_box(float at, float from, float to) {
  return to > from ? to_unorm(static_cast<float>((double{at} - from) / (double{to} - from)), 65535.0f) : 0;
}
float from_box(std::uint32_t bits, float from, float to) {
  return from + from_unorm(bits & 0xffffu, 65535.0f) * (to - from);
}

}  // namespace

shaders::GrassBladeRow pack_blade_row(const GrassBlade& blade, const GrassPatch& patch) {
  const vec3& from = patch.roots.min;
  const vec3& to = patch.roots.max;
  const vec2 normal = octahedral_encode(blade.ground_normal);
  const float turns = blade.yaw / kTurn;
  shaders::GrassBladeRow row{};
  row.root_xz = to_box(blade.root_m.x, from.x, to.x) | (to_box(blade.root_m.z, from.z, to.z) << 16);
  row.root_y_normal = to_box(blade.root_m.y, from.y, to.y) | (to_snorm8(normal.x) << 16) | (to_snorm8(normal.y) << 24);
  row.size = std::uint32_t{float_to_half(blade.length_m)} | (std::uint32_t{float_to_half(blade.width_m)} << 16);
  row.kind = to_unorm(turns - std::floor(turns), 255.0f) | ((blade.type & 0xfu) << 8) | ((blade.layer & 0xfu) << 12) |
             ((blade.master % GLOAM_GRASS_PATCH_BLADES) << 16) | (to_unorm(blade.rank, 255.0f) << 24);
  return row;
}

GrassBlade unpack_blade_row(const shaders::GrassBladeRow& row, const GrassPatch& patch, std::uint32_t slot) {
  const vec3& from = patch.roots.min;
  const vec3& to = patch.roots.max;
  GrassBlade blade;
  blade.root_m = vec3(from_box(row.root_xz, from.x, to.x), from_box(row.root_y_normal, from.y, to.y),
                      from_box(row.root_xz >> 16, from.z, to.z));
  blade.ground_normal =
      octahedral_decode(vec2(from_snorm8(row.root_y_normal >> 16), from_snorm8(row.root_y_normal >> 24)));
  blade.length_m = half_to_float(static_cast<std::uint16_t>(row.size & 0xffffu));
  blade.width_m = half_to_float(static_cast<std::uint16_t>(row.size >> 16));
  blade.yaw = from_unorm(row.kind & 0xffu, 255.0f) * kTurn;
  blade.type = static_cast<std::uint16_t>((row.kind >> 8) & 0xfu);
  blade.layer = static_cast<std::uint16_t>((row.kind >> 12) & 0xfu);
  blade.rank = from_unorm(row.kind >> 24, 255.0f);
  blade.slot = slot;
  blade.master = slot - slot % GLOAM_GRASS_PATCH_BLADES + ((row.kind >> 16) & 0xffu);
  return blade;
}

}  // namespace gloam
