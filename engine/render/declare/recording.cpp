// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/recording.h"

namespace gloam::declare {

void Recording::clear(std::string_view new_name) {
  name = new_name;
  items.clear();
  in_force.clear();
  bound.clear();
  pushes.clear();
  first_push = push_bytes = 0;
  steps.clear();
  functions.clear();
  surface_passes.clear();
  colors.clear();
  depth = {};
  depth_read_only = false;
  failed = false;
}

void Recording::shrink() {
  name.shrink_to_fit();
  items.shrink_to_fit();
  in_force.shrink_to_fit();
  bound.shrink_to_fit();
  pushes.shrink_to_fit();
  steps.shrink_to_fit();
  functions.shrink_to_fit();
  surface_passes.shrink_to_fit();
  colors.shrink_to_fit();
}

void Recordings::free_idle_memory() {
  all_.resize(used_);
  for (const auto& recording : all_) recording->shrink();
}

Recording& Recordings::next(std::string_view name) {
  if (used_ == all_.size()) all_.push_back(std::make_unique<Recording>());
  Recording& recording = *all_[used_++];
  recording.clear(name);
  return recording;
}

namespace {

gpu::ImageView view_of(const Item& item, const PassContext& context) {
  return {.image = context.image(item.image),
          .first_mip = item.part.first_mip,
          .mip_count = item.part.mip_count,
          .first_layer = item.part.first_layer,
          .layer_count = item.part.layer_count};
}

gpu::Binding binding_of(const Item& item, std::uint32_t binding, const PassContext& context) {
  switch (item.kind) {
    case Item::Kind::sampled:
      return {binding, gpu::Binding::Sampled{view_of(item, context), item.sampler}};
    case Item::Kind::storage:
      return {binding, gpu::Binding::Storage{view_of(item, context)}};
    case Item::Kind::buffer:
      return {binding, gpu::Binding::BufferRange{context.buffer(item.buffer), item.range.offset, item.range.size}};
    case Item::Kind::range:
      break;
  }
  return {binding, item.range};
}

}  // namespace

std::span<const gpu::Binding> bindings_of(const Recording& recording, const Step& step, const PassContext& context,
                                          std::vector<gpu::Binding>& storage) {
  storage.clear();
  for (const BoundItem& bound : std::span(recording.bound).subspan(step.first_bound, step.bound_count))
    storage.push_back(binding_of(recording.items[bound.item], bound.binding, context));
  return storage;
}

void begin_step(const Recording& recording, const Step& step, PassContext& context,
                std::vector<gpu::Binding>& storage) {
  gpu::CommandList& commands = context.commands();
  commands.bind_pipeline(step.due == nullptr ? step.pipeline : *step.due);
  commands.bind(bindings_of(recording, step, context, storage));
  if (step.push_bytes > 0)
    commands.push_constants(std::span(recording.pushes).subspan(step.first_push, step.push_bytes));
}

}  // namespace gloam::declare
