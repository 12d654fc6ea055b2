// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/outputs.h"

#include <algorithm>

#include "modules/shadows/knobs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {

std::span<const Entity> WithheldCasters::of(Entity light) const {
  const auto found = std::lower_bound(lights.begin(), lights.end(), light,
                                      [](const OfLight& a, Entity b) { return a.light.index < b.index; });
  if (found == lights.end() || found->light != light) return {};
  return found->casters;
}

ShadowsOutputs by_single_fetches(ShadowsOutputs shadows) {
  const gpu::SpecConstant* filter = shadows.constants.find("kFilter");
  if (filter != nullptr && filter->value == gpu::SpecValue(kContactHardening)) {
    shadows.constants.set_if_present("kFilter", kSingleFetches);
    shadows.standard = false;
  }
  return shadows;
}

void read_shadows(ShaderPass& pass, const ShadowsOutputs& shadows) {
  pass.read_if_declared("shadow_block", shadows.block);
  pass.read_if_declared("shadow_rows", shadows.rows);
  pass.read_if_declared("shadow_atlas", shadows.atlas);
  pass.read_if_declared("shadow_pyramid", shadows.pyramid);
  pass.read_if_declared("shadow_cookies", shadows.cookies, Sampling::linear);
  pass.read_if_declared("shadow_traced", shadows.traced);
}

void read_final_lists(ShaderPass& pass, const FinalLists& lists) {
  pass.read_if_declared("final_tiles", lists.tiles);
  pass.read_if_declared("final_entries", lists.entries);
  pass.read_if_declared("visibilities_0", lists.visibilities[0]);
  pass.read_if_declared("visibilities_1", lists.visibilities[1]);
}

void write_visibilities(ShaderPass& pass, FinalLists& lists) {
  const bool split = lists.visibilities[1].resource != lists.visibilities[0].resource;
  lists.visibilities[0] = pass.write("visibilities_0", lists.visibilities[0]);
  lists.visibilities[1] = pass.write("visibilities_1", lists.visibilities[split ? 1 : 0]);
  if (!split) lists.visibilities[0] = lists.visibilities[1];
}

const FinalLists* find_final_lists(const FrameBuilder& frame) {
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  return shadows != nullptr && shadows->final_lists ? &*shadows->final_lists : nullptr;
}

FinalList decode_final_list(uvec4 texel) {
  if (texel.y == GLOAM_NO_FINAL_LIST) return {.complete = false};
  return {true, texel.x, texel.z >> 16, texel.y, texel.z & 0xFFFFu};
}

FinalEntry decode_final_entry(std::uint32_t word) { return {word & 1023u, word >> 10}; }

float decode_visibility(FinalEntry entry, std::uint32_t pixel, std::span<const std::uint32_t> words,
                        std::uint32_t visibility_bits) {
  if (entry.slot == GLOAM_ALL_LIT) return 1.0f;
  const std::uint32_t most = (1u << visibility_bits) - 1;
  const std::size_t at =
      std::size_t{entry.slot} * (GLOAM_SLOT_PIXELS * visibility_bits / 32) + pixel * visibility_bits / 32;
  if (entry.slot >= GLOAM_NO_ROOM || at >= words.size()) return 0.0f;
  return static_cast<float>(words[at] >> pixel * visibility_bits % 32 & most) / static_cast<float>(most);
}

}  // namespace gloam
