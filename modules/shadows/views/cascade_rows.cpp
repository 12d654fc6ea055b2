// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/cascade_rows.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace gloam {
namespace {

static_assert(sizeof(shaders::CascadeRow) == sizeof(shaders::ShadowRow));

shaders::ShadowRow as_row(const shaders::CascadeRow& cascade) { return std::bit_cast<shaders::ShadowRow>(cascade); }

}  // namespace

void append_cascade_rows(std::span<const DirectionalLook> lights, shaders::ShadowBlock& block,
                         std::vector<shaders::ShadowRow>& rows) {
  block.cascade_row = static_cast<std::uint32_t>(rows.size());
  const std::size_t count = std::clamp<std::size_t>(lights.size(), 1, std::size(block.directional));
  for (std::size_t i = 0; i < count; ++i) {
    const shaders::DirectionalShadow& shadow = block.directional[i];
    shaders::CascadeRow row{};
    row.cascade_count = static_cast<float>(shadow.cascade_count);
    row.penumbra_m_per_m = shadow.penumbra_m_per_m;
    row.traced_layer = shadow.traced_layer;
    if (i < lights.size()) {
      row.direction = lights[i].direction;
      row.brightest = lights[i].brightest;
    }
    for (const shaders::ShadowCascade& cascade : shadow.cascades) {
      row.cascade = cascade;
      rows.push_back(as_row(row));
    }
  }
}

}  // namespace gloam
