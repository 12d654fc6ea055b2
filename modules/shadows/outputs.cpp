// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/outputs.h"

#include <algorithm>

#include "modules/shadows/knobs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {
namespace {

gpu::Binding::Sampled sampled(const PassContext& context, ImageRef image, gpu::SamplerHandle sampler,
                              bool as_array = false) {
  return {{.image = context.image(image), .as_array = as_array}, sampler};
}

}  // namespace

std::span<const Entity> WithheldCasters::of(Entity light) const {
  const auto found = std::lower_bound(lights.begin(), lights.end(), light,
                                      [](const OfLight& a, Entity b) { return a.light.index < b.index; });
  if (found == lights.end() || found->light != light) return {};
  return found->casters;
}

ShadowsOutputs by_single_fetches(ShadowsOutputs shadows) {
  constexpr std::uint32_t kSingleFetches = 2;
  for (gpu::SpecConstant& constant : shadows.constants) {
    if (constant.id != GLOAM_SHADOWS_FILTER_ID || constant.value != kContactHardening) continue;
    constant.value = kSingleFetches;
    shadows.standard = false;
  }
  shadows.variant = shadow_variant(shadows.constants);
  return shadows;
}

void declare_shadow_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access) {
  for (const ImageRef image : {shadows.rows, shadows.atlas, shadows.pyramid, shadows.cookies, shadows.traced})
    pass.read(image, access);
}

void append_shadow_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows) {
  bindings.push_back({first, shadows.block});
  bindings.push_back({first + 1, sampled(context, shadows.rows, shadows.nearest)});
  bindings.push_back({first + 2, sampled(context, shadows.atlas, shadows.nearest)});
  bindings.push_back({first + 3, sampled(context, shadows.pyramid, shadows.nearest)});
  bindings.push_back({first + 4, sampled(context, shadows.cookies, shadows.linear, true)});
  bindings.push_back({first + 5, sampled(context, shadows.traced, shadows.nearest, true)});
}

void declare_arriving_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access) {
  if (!shadows.cookies_only) return declare_shadow_reads(pass, shadows, access);
  pass.read(shadows.rows, access);
  pass.read(shadows.cookies, access);
}

void append_arriving_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                              const ShadowsOutputs& shadows) {
  if (!shadows.cookies_only) return append_shadow_bindings(bindings, first, context, shadows);
  append_cookie_bindings(bindings, first, context, shadows);
}

void append_cookie_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows) {
  bindings.push_back({first, shadows.block});
  bindings.push_back({first + 1, sampled(context, shadows.rows, shadows.nearest)});
  bindings.push_back({first + 2, sampled(context, shadows.cookies, shadows.linear, true)});
}

void declare_final_list_reads(PassBuilder& pass, const FinalLists& lists, gpu::Access access) {
  pass.read(lists.tiles, access);
  pass.read(lists.entries, access);
  pass.read(lists.visibilities[0], access);
  if (lists.visibilities[1].resource != lists.visibilities[0].resource) pass.read(lists.visibilities[1], access);
}

void append_final_list_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                                const FinalLists& lists, gpu::SamplerHandle nearest) {
  bindings.push_back({first, sampled(context, lists.tiles, nearest)});
  bindings.push_back({first + 1, gpu::Binding::BufferRange{context.buffer(lists.entries)}});
  bindings.push_back({first + 2, gpu::Binding::BufferRange{context.buffer(lists.visibilities[0])}});
  bindings.push_back({first + 3, gpu::Binding::BufferRange{context.buffer(lists.visibilities[1])}});
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
