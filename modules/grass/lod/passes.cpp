// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/passes.h"

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

void add_grass_lod_passes(FrameBuilder& frame, GrassFrame& grass) {
  const auto patches = static_cast<std::uint32_t>(grass.patches.size());
  const std::uint32_t blades = patches * GLOAM_GRASS_PATCH_BLADES;
  ComputePass keys(frame, "grass_keys", grass_keys_program());
  keys.read("lod", grass.lod_range);
  keys.read("patches", grass.patch_rows);
  keys.read("blade_rows", grass.store.rows);
  const BufferRef key_words = keys.write("keys", frame_buffer(frame, "grass_keys", blades));
  keys.dispatch(patches);

  const SortedKeys sorted = add_radix_sort_passes(frame, "grass_sort", key_words, {}, blades);
  grass.blades = sorted.values;
  grass.bins = sorted.bins;

  ComputePass live(frame, "grass_live", grass_live_program());
  live.read("lod", grass.lod_range);
  live.read("bins", grass.bins);
  grass.draws = live.write("draws", frame_buffer(frame, "grass_draws", sizeof(shaders::GrassDraws)));
  grass.dispatch = live.write("dispatch", frame_buffer(frame, "grass_dispatch", sizeof(shaders::GrassDispatch)));
  live.dispatch(1);

  ComputePass masters(frame, "grass_masters", grass_masters_program(grass.group_masters));
  masters.uniform("steps", grass.steps);
  masters.read("lod", grass.lod_range);
  masters.read("patches", grass.patch_rows);
  masters.read("blade_rows", grass.store.rows);
  masters.read("blades", grass.blades);
  masters.read("draws", grass.draws);
  grass.store.stamps = masters.write("stamps", grass.store.stamps);
  grass.dispatch = masters.write("dispatch", grass.dispatch);
  grass.masters = masters.write(
      "master_list", frame_buffer(frame, "grass_master_list",
                                  std::uint64_t{patches} * grass.slot_masters * sizeof(shaders::GrassMaster)));
  masters.dispatch_indirect(grass.draws, offsetof(shaders::GrassDraws, blade_groups));
}

}  // namespace gloam
