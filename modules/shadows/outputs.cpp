// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

gpu::Binding::Sampled sampled(const PassContext& context, ImageRef image, gpu::SamplerHandle sampler,
                              bool as_array = false) {
  return {{.image = context.image(image), .as_array = as_array}, sampler};
}

}  // namespace

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
  bindings.push_back({first, shadows.block});
  bindings.push_back({first + 1, sampled(context, shadows.rows, shadows.nearest)});
  bindings.push_back({first + 2, sampled(context, shadows.cookies, shadows.linear, true)});
}

}  // namespace gloam
