// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/resources/frame_resources.h"

namespace gloam {

FrameResources::FrameResources(gpu::Device& device)
    : pipelines(device), results(device), declared(device), history(device), graph(device), device_(device) {
  make_rings();
}

void FrameResources::make_rings() {
  using enum gpu::BufferUsage;
  uniforms.emplace(device_, "engine", uniform);
  this->storage.emplace(device_, "engine", gpu::BufferUsage::storage | transfer_source);
}

void FrameResources::begin_frame() {
  uniforms->begin_frame();
  storage->begin_frame();
  results.begin_frame();
  graph.begin();
  declared.recordings.begin_frame();
  declared.due_pipelines.begin_frame();
  history.begin_frame();
  cuts.begin_frame();
}

void FrameResources::commit(World& world, bool redraw) {
  history.commit(graph, !redraw);
  cuts.commit();
  motion.commit(world);
}

void FrameResources::give_up_frame() {
  graph.give_up_frame();
  results.give_up_frame();
}

void FrameResources::forget_world(std::uint64_t world) {
  results.forget_world(world);
  motion.forget_world(world);
  history.release_world(world);
  cuts.forget_world(world);
}

void FrameResources::forget_view(ViewId view) {
  motion.forget_view(view);
  history.release_view(view.value);
  cuts.forget_view(view);
  results.forget_view(view.value);
}

void FrameResources::forget_module(std::string_view module) {
  results.forget_module(module);
  history.release_module(module);
}

void FrameResources::free_memory() {
  graph.free_memory();
  make_rings();
  declared.placeholders.release();
}

}  // namespace gloam
