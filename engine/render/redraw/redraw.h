// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/frame/frame.h"
#include "engine/render/frame/renderer_parts.h"
#include "engine/render/readback/capture.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/readback/picture.h"

/// Reading what passes of the last frame computed: one of its views is drawn again with copies, into the renderer's own
/// picture, and the GPU is waited for. Each function asserts that the view belongs to the last frame of this world.
namespace gloam {

/// A redrawn frame, and what it has copied.
struct Redrawn {
  std::unique_ptr<Frame> frame;
  std::unique_ptr<Captures> copies;
  /// The builder of the view that was read.
  [[nodiscard]] FrameBuilder& builder() const { return *frame->builders.back(); }
};

/// add_copies: declares the copies. They are finished when this returns without error.
[[nodiscard]] Result<Redrawn> redraw(RendererParts& parts, World& world, ViewId view,
                                     const std::function<Status(FrameBuilder&, Captures&)>& add_copies);

/// Renderer::read_images, read_geometry, pick and pick_position.
[[nodiscard]] Result<std::vector<ImageBytes>> read_images(RendererParts& parts, World& world, ViewId view,
                                                          std::span<const std::string_view> names);
[[nodiscard]] Result<GeometryPicture> read_geometry(RendererParts& parts, World& world, ViewId view);
[[nodiscard]] Result<std::vector<std::string>> pick(RendererParts& parts, World& world, ViewId view, std::uint32_t x,
                                                    std::uint32_t y);
[[nodiscard]] Result<std::optional<dvec3>> pick_position(RendererParts& parts, World& world, ViewId view,
                                                         std::uint32_t x, std::uint32_t y);

}  // namespace gloam
