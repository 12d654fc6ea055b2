// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/gpu_materials.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/render/packing/mip_chain.h"
#include "engine/render/pipelines/pipelines.h"
#include "engine/render/scene/material_packing.h"

namespace gloam {
namespace {

std::vector<std::byte> constants_of(const Material& material) {
  std::vector<std::byte> bytes(kMaterialStride);
  const shaders::MaterialConstants packed = pack_material(material);
  std::memcpy(bytes.data(), &packed, sizeof(packed));
  return bytes;
}

/// The constants of the default material and of all materials.
std::vector<std::byte> all_constants(const SceneAssets& assets) {
  std::vector<std::byte> bytes = constants_of({});
  for (const Material& material : assets.materials) {
    const std::vector<std::byte> own = constants_of(material);
    bytes.insert(bytes.end(), own.begin(), own.end());
  }
  return bytes;
}

}  // namespace

std::array<const TextureSlot*, 5> texture_slots(const Material& material) {
  return {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture};
}

gpu::ImageDesc texture_image_desc(const std::string& name, std::uint32_t width, std::uint32_t height, bool srgb) {
  gpu::ImageDesc desc{.name = "texture." + name, .module = "engine"};
  desc.format = srgb ? gpu::Format::rgba8_srgb : gpu::Format::rgba8_unorm;
  desc.width = width;
  desc.height = height;
  desc.mips = mip_count(width, height);
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  return desc;
}

void GpuMaterials::drop_set(GpuMaterial& material) {
  if (material.set) device_.destroy(std::exchange(material.set, {}));
  material.content = ++contents_;
  sets_missing_ = true;
}

void GpuMaterials::take_over(const Material& source, GpuMaterial& target) {
  target.features = surface_features(source);
  target.alpha_mode = source.alpha_mode;
  target.double_sided = source.double_sided;
  target.subsurface = source.subsurface;
  target.emissive = is_emissive(source);
  drop_set(target);
}

Status GpuMaterials::make_constants(std::size_t places) {
  gpu::BufferDesc desc{.name = "scene.materials", .module = "engine", .size = places * kMaterialStride};
  desc.usage = gpu::BufferUsage::uniform | gpu::BufferUsage::transfer_target;
  auto buffer = device_.create_buffer(desc);
  if (!buffer.ok()) return buffer.error();
  if (constants_) device_.destroy(constants_);
  constants_ = *buffer;
  return {};
}

Status GpuMaterials::upload(const SceneAssets& assets, Uploader& uploader) {
  gpu::ImageDesc desc{.name = "white", .module = "engine", .format = gpu::Format::rgba8_unorm};
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  auto image = device_.create_image(desc);
  if (!image.ok()) return image.error();
  white_ = *image;
  uploader.image(white_, std::vector<std::byte>(4, std::byte{255}), gpu::Access::fragment_read);
  materials_.resize(assets.materials.size());
  take_over({}, default_);
  for (std::size_t i = 0; i < materials_.size(); ++i) take_over(assets.materials[i], materials_[i]);
  std::vector<std::byte> bytes = all_constants(assets);
  GLOAM_TRY(make_constants(bytes.size() / kMaterialStride));
  uploader.buffer(constants_, std::move(bytes), gpu::Access::uniform_read);
  return {};
}

Result<std::vector<AssetUploads::BufferPart>> GpuMaterials::change(const SceneAssets& assets,
                                                                   const std::vector<std::uint32_t>& changed,
                                                                   std::uint32_t buffer) {
  materials_.resize(std::max(materials_.size(), assets.materials.size()));
  std::vector<AssetUploads::BufferPart> parts;
  for (const std::uint32_t index : changed) {
    take_over(assets.materials[index], materials_[index]);
    parts.push_back({buffer, (std::uint64_t{index} + 1) * kMaterialStride, constants_of(assets.materials[index])});
  }
  if ((materials_.size() + 1) * kMaterialStride <= device_.desc(constants_).size) return parts;
  if (Status made = make_constants((materials_.size() + 1) * 3 / 2); !made.ok()) return made.error();
  drop_set(default_);
  for (GpuMaterial& material : materials_) drop_set(material);
  return std::vector<AssetUploads::BufferPart>{{buffer, 0, all_constants(assets)}};
}

void GpuMaterials::touch_textures(const SceneAssets& assets, const std::vector<bool>& touched) {
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    const auto shows = [&](const TextureSlot* slot) {
      return slot->texture < touched.size() && touched[slot->texture];
    };
    if (std::ranges::any_of(texture_slots(assets.materials[i]), shows)) drop_set(materials_[i]);
  }
}

void GpuMaterials::show_image(const SceneAssets& assets, const ImageKey& key, gpu::ImageHandle image) {
  std::vector<bool> touched(assets.textures.size(), false);
  for (std::size_t t = 0; t < touched.size(); ++t) touched[t] = key_of(assets.textures[t]) == key;
  touch_textures(assets, touched);
  const auto earlier = images_.find(key);
  if (earlier != images_.end()) {
    device_.destroy(earlier->second);
    images_.erase(earlier);
  }
  if (image) images_[key] = image;
}

Status GpuMaterials::make_sets(const SceneAssets& assets) {
  if (!sets_missing_) return {};
  // All pipelines of the surface shaders have the same layout of set 1. A variant that is drawn anyway is used, so that
  // nothing extra is compiled.
  const auto like = surface_pipeline(pipelines_, geometry_surface_pass(), variant_);
  if (!like.ok()) return like.error();
  const auto make = [&](const Material& source, GpuMaterial& target, std::uint64_t place) -> Status {
    if (target.set) return {};
    const auto set = set_of(assets, source, place, *like);
    if (!set.ok()) return set.error();
    target.set = *set;
    return {};
  };
  GLOAM_TRY(make({}, default_, 0));
  for (std::size_t i = 0; i < materials_.size(); ++i) GLOAM_TRY(make(assets.materials[i], materials_[i], i + 1));
  sets_missing_ = false;
  return {};
}

Result<gpu::ResourceSetHandle> GpuMaterials::set_of(const SceneAssets& assets, const Material& material,
                                                    std::uint64_t place, gpu::PipelineHandle like) {
  std::vector<gpu::Binding> bindings;
  bindings.push_back(
      {0, gpu::Binding::BufferRange{constants_, place * kMaterialStride, sizeof(shaders::MaterialConstants)}});
  std::uint32_t binding = 1;
  for (const TextureSlot* slot : texture_slots(material)) {
    const Texture* texture = slot->texture == kNone ? nullptr : &assets.textures[slot->texture];
    auto sampler = device_.create_sampler(texture == nullptr ? gpu::SamplerDesc{} : sampler_desc(*texture));
    if (!sampler.ok()) return sampler.error();
    const auto image = texture == nullptr ? images_.end() : images_.find(key_of(*texture));
    bindings.push_back(
        {binding++, gpu::Binding::Sampled{{.image = image == images_.end() ? white_ : image->second}, *sampler}});
  }
  return device_.create_resource_set(like, 1, bindings);
}

void GpuMaterials::release() {
  for (GpuMaterial& material : materials_)
    if (material.set) device_.destroy(material.set);
  if (default_.set) device_.destroy(default_.set);
  for (const auto& [key, image] : images_) device_.destroy(image);
  if (white_) device_.destroy(white_);
  if (constants_) device_.destroy(constants_);
  materials_.clear();
  images_.clear();
  default_ = {};
  white_ = {};
  constants_ = {};
  sets_missing_ = false;
}

}  // namespace gloam
