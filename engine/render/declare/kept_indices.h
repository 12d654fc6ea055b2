// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/render/frame_builder.h"

namespace gloam {

/// An index buffer of the world that is uploaded in its first frame and kept. name: of the buffer and of the pass that
/// fills it. indices: the same in every frame. An invalid reference if the frame is given up.
[[nodiscard]] BufferRef kept_indices(FrameBuilder& frame, const char* name, std::span<const std::uint32_t> indices);

}  // namespace gloam
