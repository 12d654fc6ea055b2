// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/outputs.h"

namespace gloam {

void declare_shadow_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access) {
  for (const ImageRef image : {shadows.rows, shadows.atlas, shadows.pyramid, shadows.cookies, shadows.traced})
    pass.read(image, access);
}

void append_shadow_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows) {
  const auto sampled = [&](ImageRef image, gpu::SamplerHandle sampler, bool as_array = false) {
    return gpu::Binding::Sampled{{.image = context.image(image), .as_array = as_array}, sampler};
  };
  bindings.push_back({first, shadows.block});
  bindings.push_back({first + 1, sampled(shadows.rows, shadows.nearest)});
  bindings.push_back({first + 2, sampled(shadows.atlas, shadows.nearest)});
  bindings.push_back({first + 3, sampled(shadows.pyramid, shadows.nearest)});
  bindings.push_back({first + 4, sampled(shadows.cookies, shadows.linear, true)});
  bindings.push_back({first + 5, sampled(shadows.traced, shadows.nearest, true)});
}

}  // namespace gloam
