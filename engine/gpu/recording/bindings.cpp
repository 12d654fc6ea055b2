// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Checks of bindings, and of their use by draws and dispatches.
#include <algorithm>

#include "engine/gpu/recording/command_recorder.h"

namespace gloam::gpu::recording {

namespace {

constexpr AccessMask kComputeBuffer =
    mask_of(Access::compute_read) | mask_of(Access::compute_write) | mask_of(Access::uniform_read);
constexpr AccessMask kDrawBuffer = mask_of(Access::vertex_read) | mask_of(Access::fragment_read) |
                                   mask_of(Access::fragment_write) | mask_of(Access::uniform_read);
constexpr AccessMask kComputeSampled = mask_of(Access::compute_read) | mask_of(Access::uniform_read);
constexpr AccessMask kDrawSampled = mask_of(Access::vertex_read) | mask_of(Access::fragment_read) |
                                    mask_of(Access::uniform_read) | mask_of(Access::depth_test);
constexpr AccessMask kComputeStorage = mask_of(Access::compute_storage_read) | mask_of(Access::compute_write);
constexpr AccessMask kDrawStorage = mask_of(Access::fragment_write);

void check_range(Objects& objects, const Binding::BufferRange& range, const std::string& where) {
  const Buffer* buffer = objects.buffers.find(range.buffer);
  if (buffer == nullptr) return objects.fault(where + " names a buffer that is not alive");
  const BufferDesc& desc = buffer->desc;
  if (range.offset >= desc.size || range.size > desc.size - range.offset) {
    objects.fault(where + " reaches past the end of buffer '" + desc.name + "'");
  }
  if (!has(desc.usage, BufferUsage::storage | BufferUsage::uniform)) {
    objects.fault(where + ": buffer '" + desc.name + "' was made neither for uniform nor for storage use");
  }
}

void check_view(Objects& objects, const ImageView& view, ImageUsage usage, const std::string& where) {
  const Image* image = objects.images.find(view.image);
  if (image == nullptr) return objects.fault(where + " names an image that is not alive");
  const ImageDesc& desc = image->desc;
  if (view.first_mip + std::max(view.mip_count, 1u) > desc.mips ||
      view.first_layer + std::max(view.layer_count, 1u) > desc.layers) {
    objects.fault(where + " reaches past the mips or layers of image '" + desc.name + "'");
  }
  if (!has(desc.usage, usage)) objects.fault(where + ": image '" + desc.name + "' was not made for this use");
}

}  // namespace

void check_bindings(Objects& objects, std::span<const Binding> bindings, std::string_view command) {
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const Binding& binding = bindings[i];
    const std::string where = std::string(command) + ": binding " + std::to_string(binding.binding);
    for (std::size_t j = 0; j < i; ++j) {
      if (bindings[j].binding == binding.binding) objects.fault(where + " is given twice");
    }
    if (const auto* range = std::get_if<Binding::BufferRange>(&binding.resource)) {
      check_range(objects, *range, where);
    } else if (const auto* sampled = std::get_if<Binding::Sampled>(&binding.resource)) {
      check_view(objects, sampled->view, ImageUsage::sampled, where);
    } else if (const auto* storage = std::get_if<Binding::Storage>(&binding.resource)) {
      check_view(objects, storage->view, ImageUsage::storage, where);
    }
  }
}

std::string CommandRecorder::text_of(const Binding& binding) const {
  std::string text = std::to_string(binding.binding) + "=";
  if (const auto* range = std::get_if<Binding::BufferRange>(&binding.resource)) {
    return text + name(range->buffer) + "+" + std::to_string(range->offset) + ":" + std::to_string(range->size);
  }
  const auto* sampled = std::get_if<Binding::Sampled>(&binding.resource);
  const ImageView& view = sampled != nullptr ? sampled->view : std::get<Binding::Storage>(binding.resource).view;
  text += (sampled != nullptr ? "sampled " : "storage ") + name(view.image);
  text += gpu::text_of(ImageRange{view.first_mip, view.mip_count, view.first_layer, view.layer_count});
  return text;
}

void CommandRecorder::bind(std::span<const Binding> bindings) {
  std::string text;
  for (const Binding& binding : bindings) text += (text.empty() ? "" : ", ") + text_of(binding);
  note("bind", std::move(text), Place::anywhere);
  if (!pipeline_) fault("bind", "no pipeline is bound");
  check_bindings(objects_, bindings, "bind");
  bindings_.assign(bindings.begin(), bindings.end());
}

void CommandRecorder::bind_set(std::uint32_t set, ResourceSetHandle handle) {
  note("bind_set", std::to_string(set) + " " + std::to_string(handle.index), Place::anywhere);
  const ResourceSet* resources = objects_.resource_sets.find(handle);
  if (resources == nullptr) return fault("bind_set", "a resource set that is not alive");
  if (set == 0 || set != resources->set) {
    return fault("bind_set", "resources made for set " + std::to_string(resources->set) + " are bound as set " +
                                 std::to_string(set));
  }
  if (sets_.size() <= set) sets_.resize(set + 1);
  sets_[set] = handle;
}

void CommandRecorder::use_binding(const Binding& binding, bool compute, std::string_view command) {
  if (const auto* range = std::get_if<Binding::BufferRange>(&binding.resource)) {
    tracker_.use(range->buffer, compute ? kComputeBuffer : kDrawBuffer, command);
  } else if (const auto* sampled = std::get_if<Binding::Sampled>(&binding.resource)) {
    const ImageView& view = sampled->view;
    tracker_.use(view.image, {view.first_mip, view.mip_count, view.first_layer, view.layer_count},
                 compute ? kComputeSampled : kDrawSampled, command);
  } else if (const auto* storage = std::get_if<Binding::Storage>(&binding.resource)) {
    const ImageView& view = storage->view;  // a storage view has one mip
    tracker_.use(view.image, {view.first_mip, 1, view.first_layer, view.layer_count},
                 compute ? kComputeStorage : kDrawStorage, command);
  }
}

void CommandRecorder::use_bindings(bool compute, std::string_view command) {
  for (const Binding& binding : bindings_) use_binding(binding, compute, command);
  for (ResourceSetHandle handle : sets_) {
    if (!handle) continue;
    const ResourceSet* set = objects_.resource_sets.find(handle);
    if (set == nullptr) {
      fault(command, "a bound resource set is not alive");
      continue;
    }
    for (const Binding& binding : set->bindings) use_binding(binding, compute, command);
  }
}

}  // namespace gloam::gpu::recording
