// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/render/host_geometry.h"
#include "engine/render/view.h"

namespace gloam {

/// Greatest width and height of a view, in pixels.
inline constexpr std::uint32_t kMostViewPixels = 16384;

/// Destination of a view's linear light (cd/m² before exposure), for captures: one mip and layer of an image that
/// belongs to the caller, of the view's size and with ImageUsage::color_target; six views make a cube. Several views of
/// a frame may draw into one image; they state the same accesses. `before`: the access that the image was left ready
/// for (none: the frame may discard all of its content). `after`: the access that it is left ready for.
struct LightTarget {
  gpu::ImageHandle image;
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;
  gpu::Access before = gpu::Access::none;
  gpu::Access after = gpu::Access::fragment_read;
};

/// Destination of a view's picture. `image`, if set, belongs to the caller (swapchain, host): rgba8 or bgra8, UNORM
/// (the shader encodes sRGB) or sRGB (the hardware does), created as a color_target. Its content is
/// discarded; after the frame it is ready for `after`, an access that its usage must allow. Without an image, the
/// renderer draws into its own picture, see read_picture.
///
/// The picture has the view's size, or the size `width` and `height`: then a module that accumulates pictures over
/// frames (Module::wants_jitter) enlarges it while it accumulates. `image` may have such a size only if the view shows
/// a picture of its own geometry (may_enlarge()). The renderer's own picture keeps the view's size if no module
/// enlarges it.
struct ViewTarget {
  gpu::ImageHandle image;
  /// Nobody but this view writes `image`, and it is of the renderer's device: a frame that would repeat the last ones
  /// leaves it as it is (scene.reuse). Not with an overlay.
  bool keeps_image = false;
  gpu::Access after = gpu::Access::color_target;
  std::uint32_t width = 0;  ///< pixels of the picture, at least those of the view; 0: those of the view
  std::uint32_t height = 0;
  /// Alternative to `image`, for images that exist only while a frame is recorded (gpu::Swapchain::acquire): called
  /// after the frame has begun. The view takes the size of the returned image, or if `width` is set, the picture does.
  /// If it returns none, the renderer draws into its own picture.
  std::function<Result<gpu::ImageHandle>()> acquire;
  /// Draws over the finished picture. Called while the frame is declared, after all modules have added their passes.
  /// Adds passes that write `picture`, and leaves `picture` at its newest version. Resources of the passes must live
  /// until the frame is submitted.
  std::function<Status(FrameGraph& graph, ImageRef& picture)> overlay;
  /// In place of a picture: the phases `output` and `visualize` are left out. The other members must not be set.
  std::optional<LightTarget> light;
};

struct ViewRequest {
  ViewSettings settings;
  ViewTarget target;
  /// Geometry that the host has drawn, at the view's size. None: gloam draws all geometry.
  std::optional<HostGeometry> geometry = {};
  /// Whether Renderer::read_linear may be called for this frame. It costs a copy of the view's light in frames in which
  /// a pass has moved LitOutput to another image, and nothing in other frames.
  bool keep_linear = true;
};

/// Whether the view draws a picture of its own geometry: no capture, reference, visualizer, point of a lens or geometry
/// of the host. Only such a view is jittered (RenderView::jitter), and only such a picture may be larger than its view.
[[nodiscard]] bool may_enlarge(const ViewRequest& request);

}  // namespace gloam
