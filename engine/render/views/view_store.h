// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/math/types.h"
#include "engine/render/view_request.h"

namespace gloam {

/// Images that a renderer keeps for one view between frames.
struct ViewImages {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  uvec2 picture_size = uvec2(0);  ///< of `picture`: the view's, or ViewTarget::width and height
  gpu::ImageHandle lit;           ///< rgba16f, cd/m² · light_scale
  float light_scale = 1.0f;       ///< RenderView::light_scale of the frame that drew `lit`
  bool lit_is_last = false;       ///< `lit` holds the light after all passes of the last frame
  gpu::ImageHandle picture;       ///< rgba8 sRGB; null if the caller provides a target
  std::uint64_t world = 0;        ///< world_id of the world that drew the view last
  std::uint32_t idle_frames = 0;  ///< since a frame drew the view
  bool drawn = false;             ///< a frame that was not given up has drawn the images
};

/// The images of a renderer's views, the requests of the last frame, and the ages of views and companions.
class ViewStore {
 public:
  explicit ViewStore(gpu::Device& device) : device_(device) {}
  ~ViewStore();
  ViewStore(const ViewStore&) = delete;
  ViewStore& operator=(const ViewStore&) = delete;

  /// Creates the view's images if they are missing or of another size. Frees its picture if the caller provides a
  /// target. world: its world_id.
  [[nodiscard]] Status prepare(std::uint64_t world, const ViewRequest& request);
  /// The images of a prepared view; null if there are none.
  [[nodiscard]] const ViewImages* find(ViewId view) const;
  [[nodiscard]] const ViewImages& at(ViewId view) const { return images_.at(view.value); }
  /// Notes whether `lit` will hold the light after all passes of the frame, and its scale.
  void set_lit(ViewId view, bool is_last, float light_scale) {
    images_.at(view.value).lit_is_last = is_last;
    images_.at(view.value).light_scale = light_scale;
  }

  /// Notes a submitted frame: its views are drawn, and its requests are the last ones.
  void commit(std::span<const ViewRequest> requests);
  [[nodiscard]] const std::vector<ViewRequest>& last_requests() const { return last_requests_; }
  void set_last_requests(std::vector<ViewRequest> requests) { last_requests_ = std::move(requests); }

  /// After a frame: frees the images of views that were not drawn for kFramesUntilRelease frames.
  void free_idle_images();
  /// After a frame with these companions: returns the companions that were not drawn for kFramesUntilRelease frames,
  /// and forgets their ages.
  [[nodiscard]] std::vector<ViewId> take_idle_companions(std::span<const ViewId> drawn);
  void forget_companion(ViewId companion) { companion_idle_frames_.erase(companion.value); }

  /// Free images: of one view, or of the views that a world drew last.
  void release_view(ViewId view);
  void release_world(std::uint64_t world);

 private:
  void release_if(const std::function<bool(std::uint32_t id, const ViewImages&)>& unwanted);
  [[nodiscard]] Status make_image(ViewImages& view, gpu::ImageHandle& image, const char* name, gpu::Format format,
                                  const uvec2& size);
  void destroy(gpu::ImageHandle& image);

  gpu::Device& device_;
  std::map<std::uint32_t, ViewImages> images_;                    ///< by id
  std::map<std::uint32_t, std::uint32_t> companion_idle_frames_;  ///< of the companions that frames have drawn, by id
  std::vector<ViewRequest> last_requests_;
};

}  // namespace gloam
