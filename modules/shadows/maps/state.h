// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/upload.h"
#include "engine/gpu/device.h"
#include "modules/shadows/atlas/view_maps.h"
#include "modules/shadows/maps/scratch.h"

namespace gloam {

/// Identifies a world among those that this shadows module has prepared; a resource of the world.
struct ShadowWorld {
  std::uint64_t number = 0;
};

/// The GPU images of one world's cookies.
struct WorldCookies {
  KeptImage images;
  std::uint32_t layers = 0;
  std::uint64_t version = 0;     ///< version of the uploaded Cookies
  ImageRef imported;             ///< import of the image in the frame that is being declared
  std::uint64_t last_frame = 0;  ///< Device::frame_number of its last use
};

/// GPU memory of the module, by world and view. Worlds share no images of maps or cookies.
class ShadowStates {
 public:
  ShadowStates() = default;
  ~ShadowStates() { release(); }
  ShadowStates(const ShadowStates&) = delete;
  ShadowStates& operator=(const ShadowStates&) = delete;

  /// Call once per view and frame, before the other functions. Destroys images that no frame has used for 120 frames.
  void begin(gpu::Device& device);
  /// The view's images and cache. When size or format differ from the last call, the images are created anew and the
  /// cache is empty.
  /// owner: ShadowViews::owner, under which several views share one state. user: the view.
  [[nodiscard]] Result<ViewShadows*> view(ShadowWorld world, ViewId owner, ViewId user, std::uint32_t atlas_size,
                                          bool d16);
  /// Creates the view's image of planes, in the size of its atlas, unless it exists.
  [[nodiscard]] Status reserve_planes(ViewShadows& view);
  /// Creates the view's image of backgrounds, in the size of its atlas, unless it exists.
  [[nodiscard]] Status reserve_backgrounds(ViewShadows& view);
  /// The view's state; null if view() was never called for it, or if its images have been destroyed since.
  [[nodiscard]] const ViewShadows* find(ShadowWorld world, ViewId owner) const;
  /// Resets the view's counters and its list of drawn faces. For frames of the view that draw no maps.
  void rest(ShadowWorld world, ViewId owner);
  /// Destroys the images that only this view uses.
  void release_view(ViewId view);
  /// The world's cookies: an rgba8_srgb array of `layers` layers with side × side texels. If the number of layers
  /// differs from the last call, the array is created anew and is not filled.
  [[nodiscard]] Result<WorldCookies*> cookies(ShadowWorld world, std::uint32_t layers, std::uint32_t side);
  /// Staging memory of this frame for copies into images.
  [[nodiscard]] UploadRing& staging() { return *staging_; }
  /// The same for traced visibilities, which may need many bytes. Its memory is released in the first frame that does
  /// not use it.
  [[nodiscard]] UploadRing& traced_staging();
  /// The scratch images, with room for a batch of `texels` texels. All worlds and views share them. Later calls in the
  /// same frame may replace the images: look them up while recording, not before.
  [[nodiscard]] Result<const ShadowScratch*> scratch(std::uint64_t texels);
  /// Destroys everything.
  void release();

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;
  [[nodiscard]] Result<gpu::ImageHandle> make(const gpu::ImageDesc& desc);
  void destroy(KeptImage& image);
  void destroy_images(ViewShadows& view);

  gpu::Device* device_ = nullptr;
  std::map<Key, ViewShadows> views_;
  std::map<std::uint64_t, WorldCookies> cookies_;
  std::unique_ptr<UploadRing> staging_;
  std::unique_ptr<UploadRing> traced_staging_;
  bool has_traced_ = false;  ///< the newest frame used traced_staging()
  ShadowScratch scratch_;
  std::uint64_t scratch_frame_ = 0;  ///< frame of its last use
  std::uint64_t staging_frame_ = ~0ull;
};

}  // namespace gloam
