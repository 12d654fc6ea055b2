// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/sort_blades_passes.h"

#include <cstddef>

#include "engine/render/sort/radix_sort.h"
#include "shaders/grass/shaders.h"

namespace gloam {
namespace {

BufferRef frame_buffer(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "grass";
  desc.size = bytes;
  return frame.graph().create_buffer(desc);
}

}  // namespace

ComputeProgram grass_keys_program() { return {shaders::grass::keys_comp}; }
ComputeProgram grass_live_program() { return {shaders::grass::live_comp}; }
ComputeProgram grass_masters_program(std::uint32_t group_masters) {
  return {shaders::grass::masters_comp, {{"kGroupMasters", group_masters}}};
}

SortedBlades add_blade_sort_passes(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store) {
  const std::uint32_t blades = inputs.patches * GLOAM_GRASS_PATCH_BLADES;
  ComputePass keys(frame, "grass_keys", grass_keys_program());
  keys.read("lod", inputs.lod_range);
  keys.read("patches", inputs.patch_rows);
  keys.read("blade_rows", store.rows);
  const BufferRef key_words = keys.write("keys", frame_buffer(frame, "grass_keys", blades));
  keys.dispatch(inputs.patches);

  const SortedKeys sorted = add_radix_sort_passes(frame, "grass_sort", key_words, {}, blades);

  ComputePass live(frame, "grass_live", grass_live_program());
  live.read("lod", inputs.lod_range);
  live.read("bins", sorted.bins);
  const BufferRef draws = live.write("draws", frame_buffer(frame, "grass_draws", sizeof(shaders::GrassDraws)));
  const BufferRef dispatch =
      live.write("dispatch", frame_buffer(frame, "grass_dispatch", sizeof(shaders::GrassDispatch)));
  const BufferRef casting = live.write("casting", frame_buffer(frame, "grass_casting", sizeof(shaders::GrassCasting)));
  live.dispatch(1);
  return {sorted.values, sorted.bins, draws, casting, dispatch};
}

MasterList add_master_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                           const SortedBlades& sorted) {
  ComputePass pass(frame, "grass_masters", grass_masters_program(inputs.group_masters));
  pass.uniform("steps", inputs.steps);
  pass.read("lod", inputs.lod_range);
  pass.read("patches", inputs.patch_rows);
  pass.read("blade_rows", store.rows);
  pass.read("blades", sorted.blades);
  pass.read("draws", sorted.draws);
  MasterList list;
  list.stamps = pass.write("stamps", store.stamps);
  list.dispatch = pass.write("dispatch", sorted.dispatch);
  list.masters = pass.write(
      "master_list", frame_buffer(frame, "grass_master_list",
                                  std::uint64_t{inputs.patches} * inputs.slot_masters * sizeof(shaders::GrassMaster)));
  pass.dispatch_indirect(sorted.draws, offsetof(shaders::GrassDraws, blade_groups));
  return list;
}

}  // namespace gloam
