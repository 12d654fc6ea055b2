// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/view.h"

namespace gloam::test {

/// A view of which only the frame and its newest camera cut matter.
[[nodiscard]] inline RenderView view_at(std::uint64_t frame, std::uint64_t cut_frame) {
  RenderView view;
  view.frame = frame;
  view.cut_frame = cut_frame;
  return view;
}

}  // namespace gloam::test
