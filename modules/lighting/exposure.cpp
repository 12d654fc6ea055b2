// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/exposure.h"

#include <cmath>

namespace gloam {

float exposure_from_ev100(float ev100) { return 1.0f / (1.2f * std::exp2(ev100)); }

Status ExposureSlots::prepare(gpu::Device& device) {
  frame_ = device.frame_number();
  if (buffer_) return {};
  gpu::BufferDesc desc;
  desc.name = "exposures";
  desc.module = "lighting";
  desc.size = kCapacity * sizeof(float);
  desc.usage = gpu::BufferUsage::storage;
  auto made = device.create_buffer(desc);
  if (!made.ok()) return made.error();
  device_ = &device;
  buffer_ = *made;
  return {};
}

BufferRef& ExposureSlots::in(FrameGraph& graph) {
  if (!imported_ || imported_.frame != graph.frame())
    imported_ = graph.import_buffer("exposures", buffer_, gpu::Access::fragment_read, gpu::Access::fragment_read);
  return imported_;
}

void ExposureSlots::release() {
  if (buffer_) device_->destroy(buffer_);
  buffer_ = {};
  slots_.clear();
  next_ = 0;
}

void ExposureSlots::give_up_frame(std::uint64_t frame) {
  std::erase_if(slots_, [&](const auto& entry) { return entry.second.frame == frame; });
}

ExposureSlots::Slot ExposureSlots::slot_of(LightingWorld world, const RenderView& view) {
  const Entity camera = view.camera_entity;
  const auto [found, fresh] = slots_.try_emplace({world.number, view.id.value, camera.index, camera.generation},
                                                 Kept{next_ % kCapacity, frame_});
  if (!fresh) return {found->second.index, false};
  const std::uint32_t index = found->second.index;
  const auto* const kept = &found->first;
  ++next_;
  if (next_ > kCapacity)
    std::erase_if(slots_, [&](const auto& entry) { return entry.second.index == index && &entry.first != kept; });
  return {index, true};
}

}  // namespace gloam
