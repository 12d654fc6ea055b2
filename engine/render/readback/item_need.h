// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "engine/render/view.h"

namespace gloam {

/// How many items of a buffer the shaders of a frame asked for, read back from its counters. Shaders append as many
/// items as they find; the CPU knows only an upper bound.
struct ItemNeed {
  std::uint64_t asked = 0;
  std::uint64_t bound = 0;  ///< the most that the frame could ask for
  std::uint64_t frame = 0;  ///< RenderView::frame
};

/// The number of items that a frame is expected to ask for. bound: the most that it can ask for. That is the result
/// when no need is known since the view's last camera cut. Otherwise the result is what the known frame asked for, in
/// proportion to the bound if that has grown.
[[nodiscard]] std::uint64_t expected_items(const std::optional<ItemNeed>& known, std::uint64_t bound,
                                           const RenderView& view);

/// Room that a frame's buffer should have, in items: the bound if that is at most `cheap`. Otherwise half as much again
/// as the frame is expected to ask for, at least `cheap` and an eighth of the bound, at most the bound. The result is
/// coarse: see coarse_capacity().
[[nodiscard]] std::uint64_t room_for_items(const std::optional<ItemNeed>& known, std::uint64_t bound,
                                           std::uint64_t cheap, const RenderView& view);

/// `items` rounded up to a power of two or one and a half times one, so that a buffer is rarely resized while bounds
/// change.
[[nodiscard]] std::uint64_t coarse_capacity(std::uint64_t items);

}  // namespace gloam
