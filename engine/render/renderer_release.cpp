// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// How a renderer gives memory back. The public calls wait for the GPU first: what is destroyed while no frame is in
// flight is freed at once.

#include "engine/render/renderer_state.h"

namespace gloam {

void Renderer::State::make_rings() {
  using enum gpu::BufferUsage;
  uniforms.emplace(*options.device, "engine", uniform);
  this->storage.emplace(*options.device, "engine", gpu::BufferUsage::storage | transfer_source);
}

void Renderer::State::free_frame_memory() {
  graph.free_memory();
  make_rings();
  declared.placeholders.release();
  copies.reset();
}

void Renderer::State::release_module(std::size_t index) {
  const std::string_view name = options.modules[index]->name();
  options.modules[index]->release();
  results.forget_module(name);
  history.release_module(name);
  runtimes[index].views.clear();
}

void Renderer::State::release_modules_of(const std::function<bool(std::uint64_t slot, std::uint32_t id)>& gone) {
  for (std::size_t i = 0; i < runtimes.size(); ++i) {
    const std::size_t erased =
        std::erase_if(runtimes[i].views, [&](const auto& view) { return gone(view.first, view.second); });
    if (erased > 0 && runtimes[i].views.empty()) release_module(i);
  }
}

void Renderer::State::release_slot(std::uint64_t slot) {
  scenes.erase(slot);
  checked_instances.erase(slot);
  results.forget_world(slot);
  motion.forget_world(slot);
  history.release_world(slot);
  cuts.forget_world(slot);
  release_images([&](std::uint32_t, const ViewImages& view) { return view.world == slot; });
  release_modules_of([&](std::uint64_t world, std::uint32_t) { return world == slot; });
}

void Renderer::release_world(const World& world) {
  state_->check_idle("release_world");
  const RenderSlot* slot = world.try_resource<RenderSlot>();
  if (slot == nullptr || slot->renderer.expired()) return;
  static_cast<void>(wait());  // a lost device frees its memory when it is destroyed
  state_->release_slot(state_->slot_of(world).value);
  state_->free_frame_memory();
}

void Renderer::State::release_view(ViewId view) {
  motion.forget_view(view);
  history.release_view(view.value);
  cuts.forget_view(view);
  release_images([&](std::uint32_t id, const ViewImages&) { return id == view.value; });
  results.forget_view(view.value);
  for (const auto& module : options.modules) module->release_view(view);
  release_modules_of([&](std::uint64_t, std::uint32_t id) { return id == view.value; });
}

void Renderer::release_view(ViewId view) {
  state_->check_idle("release_view");
  const bool drawn = state_->images.contains(view.value);
  static_cast<void>(wait());
  for (const ViewId companion : CompanionViews::ids_of(view)) {
    state_->companion_idle_frames.erase(companion.value);
    state_->release_view(companion);
  }
  state_->release_view(view);
  if (drawn) state_->free_frame_memory();
}

void Renderer::release_view(World& world, ViewId view) {
  release_view(view);
  world.remove_view(view);
  for (const ViewId companion : CompanionViews::ids_of(view)) world.remove_view(companion);
}

void Renderer::free_idle_memory() {
  state_->check_idle("free_idle_memory");
  static_cast<void>(wait());
  state_->graph.free_idle_memory();
}

}  // namespace gloam
