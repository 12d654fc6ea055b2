// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/lists/find_passes.h"

#include "engine/render/declare/compute_pass.h"
#include "modules/lights/knobs.h"
#include "modules/lights/lists/buffers.h"
#include "modules/lights/outputs.h"
#include "shaders/lights/shaders.h"

namespace gloam {
namespace {

/// Where a workgroup's threads run one after another, the version with one thread per tile is used: it needs no
/// barrier.
bool runs_threads_in_turn(const gpu::DeviceInfo& device) { return device.threads_in_turn; }

ComputeProgram accurate_program(const gpu::DeviceInfo& device) {
  if (runs_threads_in_turn(device)) return {shaders::lights::find_lights_accurate_tiles_comp};
  return {shaders::lights::find_lights_accurate_comp, {{"local_size_y", 8u}}};  // one thread per pixel
}

uvec2 tiles_of(FrameBuilder& frame, const LightsOutputs& outputs) {
  const gpu::ImageDesc& desc = frame.graph().desc(outputs.tile_lists);
  return {desc.width, desc.height};
}
uvec2 groups_of(FrameBuilder& frame, const LightsOutputs& outputs) {
  return (tiles_of(frame, outputs) + uvec2(GLOAM_TILE_GROUP - 1)) / uvec2(GLOAM_TILE_GROUP);
}

/// Copies the local lights into an image (see light_texels.comp). Also resets the counters of the searches that follow.
void add_light_texels_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  gpu::ImageDesc desc;
  desc.name = "light_texels";
  desc.module = "lights";
  desc.format = gpu::Format::rgba32_float;
  desc.width = 3;
  desc.height = GLOAM_MAX_LOCAL_LIGHTS;
  ComputePass pass(frame, "light_texels", shaders::lights::light_texels_comp);
  outputs.texels = pass.write("texels", frame.graph().create_image(desc));
  if (outputs.counters) {
    outputs.counters = pass.graph_pass().write(outputs.counters, gpu::Access::transfer_write);
    pass.record([counters = outputs.counters](PassContext& context) {
      record_counters_start(context.commands(), context.buffer(counters));
    });
  }
  pass.read("lights", outputs.lights);
  pass.dispatch_over(outputs.local_count);
}

void add_approx_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  ComputePass pass(frame, "find_lights_approx", shaders::lights::find_lights_approx_comp);
  pass.read("lights", outputs.lights);
  pass.read("grid", outputs.grid);
  pass.read("depth_bounds", frame.get<GeometryOutputs>().depth_bounds);
  pass.read("light_texels", outputs.texels);
  pass.read("z_bin_words", outputs.z_bins);
  pass.read("mask_tiles", outputs.mask_tiles);
  outputs.group_masks = pass.write("group_masks", outputs.group_masks);
  outputs.tile_lists = pass.write("tile_lists", outputs.tile_lists);
  outputs.counters = pass.write("counters", outputs.counters);
  const uvec2 groups = groups_of(frame, outputs);
  pass.dispatch(groups.x, groups.y);
}

void add_accurate_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  const gpu::DeviceInfo& device = frame.services().device.info();
  ComputePass pass(frame, "find_lights_accurate", accurate_program(device));
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("lights", outputs.lights);
  pass.read("grid", outputs.grid);
  pass.read("light_texels", outputs.texels);
  pass.read("group_masks", outputs.group_masks);
  outputs.tile_lists = pass.write("tile_lists", outputs.tile_lists);
  outputs.early_lists = pass.write("early_lists", outputs.early_lists);
  outputs.counters = pass.write("counters", outputs.counters);
  const uvec2 groups = runs_threads_in_turn(device) ? groups_of(frame, outputs) : tiles_of(frame, outputs);
  pass.dispatch(groups.x, groups.y);
}

void add_check_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  ComputePass pass(frame, "check_lists", shaders::lights::check_lists_comp);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, outputs);
  outputs.counters = pass.write("counters", outputs.counters);
  const uvec2 tiles = tiles_of(frame, outputs);
  pass.dispatch(tiles.x, tiles.y);
}

}  // namespace

void list_light_pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "lights")); };
  add({shaders::lights::light_texels_comp});
  if (knobs.value(kLightCulling) == LightCulling::brute) return;
  add({shaders::lights::find_lights_approx_comp});
  add(accurate_program(device));
  if (knobs.value(kLightCheck)) add({shaders::lights::check_lists_comp});
}

void add_find_lights_passes(FrameBuilder& frame, const VisibleLights& visible, const ZBins& bins,
                            const TileLightMasks& masks) {
  LightsOutputs outputs;
  outputs.local_count = visible.block.local_count;
  outputs.directional_count = visible.block.directional_count;
  outputs.lights = frame.upload_uniform(visible.block);
  const bool searches = outputs.local_count > 0 && frame.knobs().value(kLightCulling) == LightCulling::tiled;
  if (searches) upload_light_lists(frame, bins, masks, outputs);
  if (outputs.local_count > 0) add_light_texels_pass(frame, outputs);
  if (searches) {
    add_approx_pass(frame, outputs);
    add_accurate_pass(frame, outputs);
    const bool checks = frame.knobs().value(kLightCheck);
    if (checks) add_check_pass(frame, outputs);
    frame.keep_result("lights", kLightCountersResult, outputs.counters,
                      LightCountersNote{frame.view(), outputs.slot_capacity, checks, outputs.entry_bound});
  }
  frame.put(outputs);
}

}  // namespace gloam
