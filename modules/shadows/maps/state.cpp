// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/state.h"

#include "modules/shadows/atlas/mip_places.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

constexpr std::uint64_t kFramesKept = 120;

gpu::ImageDesc kept_image(const char* name, gpu::Format format, std::uint32_t side) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "shadows";
  desc.format = format;
  desc.width = size_with_mips(side).x;
  desc.height = size_with_mips(side).y;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source;
  return desc;
}

}  // namespace

void ShadowStates::begin(gpu::Device& device) {
  device_ = &device;
  if (staging_ == nullptr)
    staging_ = std::make_unique<UploadRing>(device, "shadows", gpu::BufferUsage::transfer_source, 1 << 16);
  const std::uint64_t frame = device.frame_number();
  if (staging_frame_ == frame) return;
  staging_->begin_frame();
  if (!has_traced_) traced_staging_.reset();
  if (traced_staging_ != nullptr) traced_staging_->begin_frame();
  has_traced_ = false;
  if (scratch_frame_ + kFramesKept < frame) scratch_.release(device);
  staging_frame_ = frame;
  for (auto at = views_.begin(); at != views_.end();) {
    if (at->second.last_frame + kFramesKept >= frame) {
      ++at;
      continue;
    }
    destroy_images(at->second);
    at = views_.erase(at);
  }
  for (auto at = cookies_.begin(); at != cookies_.end();) {
    if (at->second.last_frame + kFramesKept >= frame) {
      ++at;
      continue;
    }
    destroy(at->second.images);
    at = cookies_.erase(at);
  }
}

Result<gpu::ImageHandle> ShadowStates::make(const gpu::ImageDesc& desc) { return device_->create_image(desc); }

void ShadowStates::destroy(KeptImage& image) {
  if (image.image) device_->destroy(image.image);
  image = {};
}

void ShadowStates::destroy_images(ViewShadows& view) {
  for (KeptImage* image : {&view.atlas, &view.pyramid, &view.planes, &view.backgrounds}) destroy(*image);
}

ImageRef import_kept(FrameGraph& graph, const char* name, KeptImage& image) {
  if (image.imported && image.imported.frame == graph.frame()) return graph.newest(image.imported);
  const gpu::Access before = image.filled ? gpu::Access::fragment_read : gpu::Access::none;
  image.imported = graph.import_image(name, image.image, before, gpu::Access::fragment_read);
  return image.imported;
}

Result<ViewShadows*> ShadowStates::view(ShadowWorld world, ViewId owner, ViewId user, std::uint32_t atlas_size,
                                        bool d16) {
  ViewShadows& found = views_[{world.number, owner.value}];
  found.users.insert(user.value);
  found.last_frame = device_->frame_number();
  if (found.atlas.image && found.pyramid.image && found.atlas_size == atlas_size && found.d16 == d16) return &found;
  destroy_images(found);
  found.cache.clear();
  found.atlas_size = atlas_size;
  found.d16 = d16;
  auto atlas = make(kept_image("shadow_atlas", d16 ? gpu::Format::r16_unorm : gpu::Format::r32_float, atlas_size));
  if (!atlas.ok()) return atlas.error();
  found.atlas.image = *atlas;
  gpu::ImageDesc both_bounds =
      kept_image("shadow_pyramid", gpu::Format::r32_float, atlas_size >> GLOAM_SHADOW_PYRAMID_MIP);
  both_bounds.height *= 2;
  auto pyramid = make(both_bounds);
  if (!pyramid.ok()) return pyramid.error();
  found.pyramid.image = *pyramid;
  return &found;
}

Status ShadowStates::reserve_planes(ViewShadows& view) {
  if (view.planes.image) return {};
  auto planes =
      make(kept_image("shadow_planes", gpu::Format::rgba32_float, view.atlas_size / GLOAM_SHADOW_PLANE_BLOCK));
  if (!planes.ok()) return planes.error();
  view.planes.image = *planes;
  return {};
}

Status ShadowStates::reserve_backgrounds(ViewShadows& view) {
  if (view.backgrounds.image) return {};
  gpu::ImageDesc desc = kept_image("shadow_backgrounds", gpu::Format::r32_float, view.atlas_size);
  desc.width = view.atlas_size;
  desc.shape = gpu::ImageShape::array;  // like the scratch image, which is bound in place of a missing one
  auto backgrounds = make(desc);
  if (!backgrounds.ok()) return backgrounds.error();
  view.backgrounds.image = *backgrounds;
  return {};
}

const ViewShadows* ShadowStates::find(ShadowWorld world, ViewId view) const {
  const auto found = views_.find({world.number, view.value});
  return found == views_.end() ? nullptr : &found->second;
}

void ShadowStates::rest(ShadowWorld world, ViewId owner) {
  const auto found = views_.find({world.number, owner.value});
  if (found == views_.end()) return;
  found->second.counts = {};
  if (found->second.users.size() <= 1) found->second.drawn.clear();
}

void ShadowStates::release_view(ViewId view) {
  for (auto at = views_.begin(); at != views_.end();) {
    const bool last = at->second.users.erase(view.value) > 0 && at->second.users.empty();
    if (last) destroy_images(at->second);
    at = last ? views_.erase(at) : std::next(at);
  }
}

Result<WorldCookies*> ShadowStates::cookies(ShadowWorld world, std::uint32_t layers, std::uint32_t side) {
  WorldCookies& found = cookies_[world.number];
  found.last_frame = device_->frame_number();
  if (found.images.image && found.layers == layers) return &found;
  destroy(found.images);
  found = {};
  gpu::ImageDesc desc;
  desc.name = "shadow_cookies";
  desc.module = "shadows";
  desc.format = gpu::Format::rgba8_srgb;
  desc.width = desc.height = side;
  desc.layers = layers;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  desc.shape = gpu::ImageShape::array;
  auto made = make(desc);
  if (!made.ok()) return made.error();
  found.images.image = *made;
  found.layers = layers;
  found.last_frame = device_->frame_number();
  return &found;
}

UploadRing& ShadowStates::traced_staging() {
  has_traced_ = true;
  if (traced_staging_ == nullptr) {
    traced_staging_ = std::make_unique<UploadRing>(*device_, "shadows", gpu::BufferUsage::transfer_source, 1);
    traced_staging_->begin_frame();
  }
  return *traced_staging_;
}

Result<const ShadowScratch*> ShadowStates::scratch(std::uint64_t texels) {
  scratch_frame_ = device_->frame_number();
  GLOAM_TRY(scratch_.reserve(*device_, texels));
  return &scratch_;
}

void ShadowStates::release() {
  if (device_ != nullptr) scratch_.release(*device_);
  for (auto& [key, view] : views_) destroy_images(view);
  for (auto& [key, cookies] : cookies_) destroy(cookies.images);
  views_.clear();
  cookies_.clear();
  staging_.reset();
  traced_staging_.reset();
  has_traced_ = false;
  staging_frame_ = ~0ull;
}

}  // namespace gloam
