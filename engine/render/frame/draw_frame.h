// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/render/frame/frame.h"
#include "engine/render/frame/renderer_parts.h"

namespace gloam {

/// Draws one frame and submits it, see Renderer::render. redraw: null, or the request that the frame serves. Returns
/// the frame: its views and builders are needed to read back what a redraw has copied. On an error or an exception the
/// frame is given up.
[[nodiscard]] Result<std::unique_ptr<Frame>> draw_frame(RendererParts& parts, World& world,
                                                        std::span<const ViewRequest> requests,
                                                        const Redraw* redraw = nullptr);

}  // namespace gloam
