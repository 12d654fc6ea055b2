// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/view_glare.h"

#include <algorithm>

#include "modules/glare/components.h"

namespace gloam {

float counted_glare(float share) { return share > 0.0f ? std::min(share, kMostGlare) : 0.0f; }

float glare_share(const World& world, const RenderView& view) {
  const Glare* own = view.camera_entity == kNoEntity ? nullptr : world.try_get<Glare>(view.camera_entity);
  if (own != nullptr) return counted_glare(own->share);
  const auto* usual = world.try_resource<DefaultGlare>();
  return usual != nullptr ? counted_glare(usual->share) : 0.0f;
}

}  // namespace gloam
