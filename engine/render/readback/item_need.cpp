// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/readback/item_need.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gloam {

std::uint64_t expected_items(const std::optional<ItemNeed>& known, std::uint64_t bound, const RenderView& view) {
  if (!known || known->frame < view.cut_frame) return bound;
  if (bound <= known->bound) return std::min(known->asked, bound);
  const double growth = static_cast<double>(bound) / static_cast<double>(std::max<std::uint64_t>(known->bound, 1));
  const double expected = std::ceil(static_cast<double>(known->asked) * growth);
  return std::min(static_cast<std::uint64_t>(expected), bound);
}

std::uint64_t room_for_items(const std::optional<ItemNeed>& known, std::uint64_t bound, std::uint64_t cheap,
                             const RenderView& view) {
  const std::uint64_t expected = expected_items(known, bound, view);
  return coarse_capacity(std::min(bound, std::max({expected + expected / 2, cheap, bound / 8})));
}

std::uint64_t coarse_capacity(std::uint64_t items) {
  if (items < 2) return items;
  const std::uint64_t step = std::bit_floor(items) / 2;
  return (items + step - 1) / step * step;
}

}  // namespace gloam
