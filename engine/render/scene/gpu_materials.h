// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/transfers/upload.h"
#include "engine/gpu/device.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/uploads/asset_uploads.h"
#include "engine/scene/assets.h"

namespace gloam {

struct GpuMaterial {
  gpu::ResourceSetHandle set;
  std::uint32_t features = 0;  ///< GLOAM_SURFACE_…
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  bool subsurface = false;
  bool emissive = false;
  std::uint64_t content = 0;  ///< another number for each change of the material or of an image that it shows
};

/// Index of an image, and whether it holds sRGB colours: an image that textures use in both ways is there twice.
using ImageKey = std::pair<std::uint32_t, bool>;

/// Materials and images of a scene on the GPU. Constants of material i are at place i + 1 of a uniform buffer; place 0
/// has the default material.
class GpuMaterials {
 public:
  GpuMaterials(gpu::Device& device, Pipelines& pipelines) : device_(device), pipelines_(pipelines) {}
  ~GpuMaterials() { release(); }
  GpuMaterials(const GpuMaterials&) = delete;
  GpuMaterials& operator=(const GpuMaterials&) = delete;

  [[nodiscard]] const GpuMaterial& get(std::uint32_t index) const {
    return index < materials_.size() ? materials_[index] : default_;
  }

  /// Makes the white image, and the constants of all materials, for a full upload.
  [[nodiscard]] Status upload(const SceneAssets& assets, Uploader& uploader);
  /// A variant that is drawn: resource sets are made for its pipeline.
  void use_variant(SurfaceVariant variant) { variant_ = variant; }
  /// Takes the constants and features of changed materials over. count: the new number of materials. Returns the parts
  /// that must be copied to constants(), as buffer `buffer` of AssetUploads. Materials that textures or images of
  /// another revision concern need touch_texture or touch_image as well.
  [[nodiscard]] Result<std::vector<AssetUploads::BufferPart>> change(const SceneAssets& assets,
                                                                     const std::vector<std::uint32_t>& changed,
                                                                     std::uint32_t buffer);
  /// Materials that show one of these textures get a new resource set.
  void touch_textures(const SceneAssets& assets, const std::vector<bool>& touched);
  /// Shows an image in place of an earlier one, which is destroyed. A null image: white.
  void show_image(const SceneAssets& assets, const ImageKey& key, gpu::ImageHandle image);
  [[nodiscard]] const std::map<ImageKey, gpu::ImageHandle>& images() const { return images_; }
  void put_image(const ImageKey& key, gpu::ImageHandle image) { images_[key] = image; }
  /// Makes the resource sets that are missing.
  [[nodiscard]] Status make_sets(const SceneAssets& assets);
  [[nodiscard]] gpu::BufferHandle constants() const { return constants_; }
  void release();

 private:
  [[nodiscard]] Status make_constants(std::size_t places);
  void take_over(const Material& source, GpuMaterial& target);
  void drop_set(GpuMaterial& material);
  [[nodiscard]] Result<gpu::ResourceSetHandle> set_of(const SceneAssets& assets, const Material& material,
                                                      std::uint64_t place, gpu::PipelineHandle like);

  gpu::Device& device_;
  Pipelines& pipelines_;
  SurfaceVariant variant_;
  std::vector<GpuMaterial> materials_;
  GpuMaterial default_;
  gpu::BufferHandle constants_;
  std::map<ImageKey, gpu::ImageHandle> images_;
  gpu::ImageHandle white_;
  std::uint64_t contents_ = 0;
  bool sets_missing_ = false;
};

/// The textures of a material, in the order of their bindings.
[[nodiscard]] std::array<const TextureSlot*, 5> texture_slots(const Material& material);
/// The image of a texture.
[[nodiscard]] inline ImageKey key_of(const Texture& texture) { return {texture.image, texture.srgb}; }
/// Description of an RGBA8 image with all its mips, as textures show it.
[[nodiscard]] gpu::ImageDesc texture_image_desc(const std::string& name, std::uint32_t width, std::uint32_t height,
                                                bool srgb);

}  // namespace gloam
