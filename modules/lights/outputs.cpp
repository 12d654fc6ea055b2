// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/outputs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "modules/lights/knobs.h"
#include "modules/lights/masks/mask_population.h"
#include "modules/lights/selection/light_list.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {
namespace {

double luminance(const vec3& color) { return glm::dot(dvec3(color), dvec3(0.2126, 0.7152, 0.0722)); }

}  // namespace

std::span<const Entity> local_lights(const VisibleLights& visible) { return visible.local_entities; }

std::span<const Entity> directional_lights(const VisibleLights& visible) { return visible.directional_entities; }

static_assert(kShadowTile == GLOAM_SHADOW_TILE);

std::vector<DirectionalLook> directional_looks(const VisibleLights& visible) {
  std::vector<DirectionalLook> looks;
  for (std::uint32_t i = 0; i < visible.block.directional_count; ++i) {
    const shaders::DirectionalLight& light = visible.block.directional[i];
    looks.push_back({light.direction, std::max({light.color.r, light.color.g, light.color.b}) / visible.light_scale});
  }
  return looks;
}

shaders::LocalLight local_light_reach(const VisibleLights& visible, std::size_t light) {
  GLOAM_ASSERT(light < visible.block.local_count, "no such local light");
  shaders::LocalLight reach = visible.block.local[light];
  reach.color = vec3(glm::greaterThan(reach.color, vec3(0.0f)));
  return reach;
}

std::uint64_t local_lights_hash(const VisibleLights& visible) {
  return hash_bytes(std::as_bytes(std::span(visible.block.local).first(visible.block.local_count)));
}

double local_illuminance_at(const VisibleLights& visible, std::size_t light, const vec3& point, const vec3& normal) {
  GLOAM_ASSERT(light < visible.block.local_count, "no such local light");
  const shaders::LocalLight& l = visible.block.local[light];
  const dvec3 offset = dvec3(l.position) - dvec3(point);
  const double d2 = std::max(glm::dot(offset, offset), 1e-30);
  const dvec3 to_light = offset / std::sqrt(d2);
  const double window = range_window(d2 * static_cast<double>(l.inverse_range_squared));
  const double cone = std::clamp(
      -glm::dot(to_light, dvec3(l.direction)) * static_cast<double>(l.spot_scale) + static_cast<double>(l.spot_offset),
      0.0, 1.0);
  return luminance(l.color / visible.light_scale) * window * cone * cone / d2 *
         std::max(glm::dot(dvec3(normal), to_light), 0.0);
}

double directional_illuminance_at(const VisibleLights& visible, std::size_t light, const vec3& normal) {
  GLOAM_ASSERT(light < visible.block.directional_count, "no such directional light");
  const shaders::DirectionalLight& l = visible.block.directional[light];
  return luminance(l.color / visible.light_scale) * std::max(-glm::dot(dvec3(normal), dvec3(l.direction)), 0.0);
}

std::vector<LightOnPoint> illuminance_at(const World& world, ViewId view, const vec3& point, const vec3& normal) {
  std::vector<LightOnPoint> lights;
  const auto* visible = world.try_view_resource<VisibleLights>(view);
  if (visible == nullptr) return lights;
  const auto add = [&](Entity entity, double lux) {
    if (lux > 0.0) lights.push_back({entity, lux});
  };
  for (std::uint32_t i = 0; i < visible->block.directional_count; ++i)
    add(visible->directional_entities[i], directional_illuminance_at(*visible, i, normal));
  for (std::uint32_t i = 0; i < visible->block.local_count; ++i)
    add(visible->local_entities[i], local_illuminance_at(*visible, i, point, normal));
  return lights;
}

bool wide_highlights(const KnobRegistry& knobs) { return knobs.try_value(kEmitterHighlights).value_or(false); }

void read_light_lists(ShaderPass& pass, const LightsOutputs& lights) {
  pass.read_if_declared("lights", lights.lights);
  pass.read_if_declared("grid", lights.grid);
  pass.read_if_declared("light_texels", lights.texels);
  pass.read_if_declared("tile_lists", lights.tile_lists);
  pass.read_if_declared("early_lists", lights.early_lists);
  pass.read_if_declared("group_masks", lights.group_masks);
  pass.read_if_declared("mask_tiles", lights.mask_tiles);
  pass.read_if_declared("z_bin_words", lights.z_bins);
}

std::uint64_t most_tile_lights(const LightsOutputs& lights, uvec2 shadow_tiles, std::span<const std::uint32_t> chosen) {
  return lights.masks == nullptr ? 0 : mask_population(*lights.masks, shadow_tiles, chosen, 1);
}

std::span<const std::byte> empty_light_block() {
  static const shaders::LightBlock block{};
  return std::as_bytes(std::span(&block, 1));
}

TileList decode_tile_list(uvec2 texel) {
  TileList tile;
  tile.has_list = texel.x != GLOAM_NO_SLOT;
  tile.slot = tile.has_list ? texel.x : 0;
  tile.count = texel.y & 0xFFFFu;
  tile.approx_count = texel.y >> 16;
  return tile;
}

std::vector<std::uint32_t> decode_light_mask(std::span<const std::uint32_t> words) {
  GLOAM_ASSERT(words.size() == GLOAM_MASK_WORDS, "a light mask has a word for the groups and one a group of lights");
  std::vector<std::uint32_t> lights;
  for (std::uint32_t groups = words[0]; groups != 0; groups &= groups - 1) {
    const auto group = static_cast<std::uint32_t>(std::countr_zero(groups));
    for (std::uint32_t bits = words[group + 1]; bits != 0; bits &= bits - 1)
      lights.push_back(group * 32 + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
  return lights;
}

std::vector<std::uint32_t> decode_light_list(std::span<const std::uint32_t> early_lists, std::uint32_t slot,
                                             std::uint32_t count) {
  std::vector<std::uint32_t> lights;
  for (std::uint64_t entry = slot; entry < std::uint64_t{slot} + count && entry / 3 < early_lists.size(); ++entry)
    lights.push_back(early_lists[entry / 3] >> (10 * (entry % 3)) & 1023u);
  return lights;
}

}  // namespace gloam
