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

/// Number of a world among those that a shadows module has prepared; a resource of the world.
struct ShadowWorld {
  std::uint64_t number = 0;
};

/// Cookies of one world.
struct WorldCookies {
  KeptImage images;
  std::uint32_t layers = 0;
  std::uint64_t version = 0;  ///< of Cookies that was uploaded
  ImageRef imported;          ///< in the frame being declared
  std::uint64_t last_frame = 0;
};

/// GPU memory of the module, by world and view. Two worlds never share.
class ShadowStates {
 public:
  ShadowStates() = default;
  ~ShadowStates() { release(); }
  ShadowStates(const ShadowStates&) = delete;
  ShadowStates& operator=(const ShadowStates&) = delete;

  /// Once a view and frame, before the others; forgets what no frame has used for long.
  void begin(gpu::Device& device);
  /// The view's images, made anew when size or format are others: then its cache is empty.
  [[nodiscard]] Result<ViewShadows*> view(ShadowWorld world, ViewId view, std::uint32_t atlas_size, bool d16);
  /// Makes sure that the view has an image of planes, of the size of its atlas.
  [[nodiscard]] Status reserve_planes(ViewShadows& view);
  /// The same for its image of backgrounds.
  [[nodiscard]] Status reserve_backgrounds(ViewShadows& view);
  [[nodiscard]] const ViewShadows* find(ShadowWorld world, ViewId view) const;
  /// A frame of the view draws no maps: what earlier ones did is no news any more.
  void rest(ShadowWorld world, ViewId view);
  /// An array of at least `layers` rgba8_srgb images of the world.
  [[nodiscard]] Result<WorldCookies*> cookies(ShadowWorld world, std::uint32_t layers, std::uint32_t side);
  /// Memory whose bytes this frame copies into images.
  [[nodiscard]] UploadRing& staging() { return *staging_; }
  /// The same for visibilities that rays have found, which may be many bytes: given back with the first frame that has
  /// none.
  [[nodiscard]] UploadRing& traced_staging();
  /// With room for so many texels in this frame. One for all worlds and views; look up images while recording, not
  /// before.
  [[nodiscard]] Result<const ShadowScratch*> scratch(std::uint64_t texels);
  void release();

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;
  [[nodiscard]] Result<gpu::ImageHandle> make(const gpu::ImageDesc& desc);
  void destroy(KeptImage& image);

  gpu::Device* device_ = nullptr;
  std::map<Key, ViewShadows> views_;
  std::map<std::uint64_t, WorldCookies> cookies_;
  std::unique_ptr<UploadRing> staging_;
  std::unique_ptr<UploadRing> traced_staging_;
  bool has_traced_ = false;  ///< in the newest frame
  ShadowScratch scratch_;
  std::uint64_t scratch_frame_ = 0;  ///< of its last use
  std::uint64_t staging_frame_ = ~0ull;
};

}  // namespace gloam
