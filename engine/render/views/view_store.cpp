// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/views/view_store.h"

#include "engine/render/renderer_options.h"

namespace gloam {

ViewStore::~ViewStore() {
  release_if([](std::uint32_t, const ViewImages&) { return true; });
}

void ViewStore::destroy(gpu::ImageHandle& image) {
  if (image) device_.destroy(image);
  image = {};
}

Status ViewStore::make_image(ViewImages& view, gpu::ImageHandle& image, const char* name, gpu::Format format,
                             const uvec2& size) {
  if (image) return {};
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "engine";
  desc.format = format;
  desc.width = size.x;
  desc.height = size.y;
  desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
  if (format == gpu::Format::rgba16_float)
    desc.usage = desc.usage | gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_target;
  auto made = device_.create_image(desc);
  if (!made.ok()) return made.error();
  image = *made;
  view.drawn = false;
  return {};
}

Status ViewStore::prepare(std::uint64_t world, const ViewRequest& request) {
  const ViewSettings& settings = request.settings;
  ViewImages& view = images_[settings.id.value];
  view.world = world;
  if (view.width != settings.width || view.height != settings.height) {
    destroy(view.lit);
    view.width = settings.width;
    view.height = settings.height;
  }
  const ViewTarget& target = request.target;
  const uvec2 size = target.width > 0 ? uvec2(target.width, target.height) : uvec2(settings.width, settings.height);
  if (size != view.picture_size) destroy(view.picture);
  view.picture_size = size;
  const bool has_target = request.target.image || request.target.light;
  if (has_target) destroy(view.picture);
  GLOAM_TRY(make_image(view, view.lit, "lit", gpu::Format::rgba16_float, {view.width, view.height}));
  if (!has_target) GLOAM_TRY(make_image(view, view.picture, "picture", gpu::Format::rgba8_srgb, size));
  return {};
}

const ViewImages* ViewStore::find(ViewId view) const {
  const auto found = images_.find(view.value);
  return found == images_.end() ? nullptr : &found->second;
}

void ViewStore::commit(std::span<const ViewRequest> requests) {
  for (const ViewRequest& request : requests) images_.at(request.settings.id.value).drawn = true;
  last_requests_.assign(requests.begin(), requests.end());
}

void ViewStore::release_if(const std::function<bool(std::uint32_t id, const ViewImages&)>& unwanted) {
  for (auto at = images_.begin(); at != images_.end();) {
    const std::uint32_t id = at->first;
    if (!unwanted(id, at->second)) {
      ++at;
      continue;
    }
    destroy(at->second.lit);
    destroy(at->second.picture);
    std::erase_if(last_requests_, [&](const ViewRequest& request) { return request.settings.id.value == id; });
    at = images_.erase(at);
  }
}

void ViewStore::free_idle_images() {
  for (auto& [id, view] : images_) ++view.idle_frames;
  for (const ViewRequest& request : last_requests_) images_.at(request.settings.id.value).idle_frames = 0;
  release_if([](std::uint32_t, const ViewImages& view) { return view.idle_frames >= kFramesUntilRelease; });
}

std::vector<ViewId> ViewStore::take_idle_companions(std::span<const ViewId> drawn) {
  for (auto& [id, idle] : companion_idle_frames_) ++idle;
  for (const ViewId companion : drawn) companion_idle_frames_[companion.value] = 0;
  std::vector<ViewId> idle_ones;
  for (const auto& [id, idle] : companion_idle_frames_)
    if (idle >= kFramesUntilRelease) idle_ones.push_back(ViewId{id});
  for (const ViewId companion : idle_ones) forget_companion(companion);
  return idle_ones;
}

void ViewStore::release_view(ViewId view) {
  release_if([&](std::uint32_t id, const ViewImages&) { return id == view.value; });
}

void ViewStore::release_world(std::uint64_t world) {
  release_if([&](std::uint32_t, const ViewImages& view) { return view.world == world; });
}

}  // namespace gloam
