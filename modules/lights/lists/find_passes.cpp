// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/lists/find_passes.h"

#include <initializer_list>

#include "modules/lights/lists/buffers.h"
#include "modules/lights/outputs.h"
#include "shaders/lights/shaders.h"

namespace gloam {
namespace {

gpu::ComputePipelineDesc light_texels_pipeline() {
  return {"light_texels", "lights", shaders::lights::light_texels_comp, {}};
}
gpu::ComputePipelineDesc approx_pipeline() {
  return {"find_lights_approx", "lights", shaders::lights::find_lights_approx_comp, {}};
}
gpu::ComputePipelineDesc accurate_pipeline() {
  return {
      "find_lights_accurate", "lights", shaders::lights::find_lights_accurate_comp, {{0, 8}}};  // one thread per pixel
}
gpu::ComputePipelineDesc accurate_tiles_pipeline() {
  return {"find_lights_accurate_tiles", "lights", shaders::lights::find_lights_accurate_tiles_comp, {}};
}
/// Where a workgroup's threads run one after another, the version with one thread per tile is used: it needs no
/// barrier.
bool runs_threads_in_turn(const gpu::DeviceInfo& device) { return device.threads_in_turn; }
gpu::ComputePipelineDesc check_pipeline() { return {"check_lists", "lights", shaders::lights::check_lists_comp, {}}; }

/// The pipeline and workgroup count of a search. Bindings are added when the pass records, because images and buffers
/// exist only then.
struct Search {
  gpu::PipelineHandle pipeline;
  uvec2 groups = uvec2(0);
};

/// Copies the local lights into an image (see light_texels.comp). Also resets the counters of the searches that follow.
Status add_light_texels_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  auto pipeline = frame.services().pipelines.get(light_texels_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  gpu::ImageDesc desc;
  desc.name = "light_texels";
  desc.module = "lights";
  desc.format = gpu::Format::rgba32_float;
  desc.width = 3;
  desc.height = GLOAM_MAX_LOCAL_LIGHTS;
  PassBuilder pass = frame.graph().add_pass("light_texels", "lights");
  outputs.texels = pass.write(frame.graph().create_image(desc), gpu::Access::compute_write);
  if (outputs.counters) outputs.counters = pass.write(outputs.counters, gpu::Access::transfer_write);
  pass.execute([outputs, pipeline = *pipeline](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    if (outputs.counters) record_counters_start(commands, context.buffer(outputs.counters));
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, outputs.lights},
                                     {1, gpu::Binding::Storage{{.image = context.image(outputs.texels)}}}};
    commands.bind(bindings);
    commands.dispatch((outputs.local_count + 63) / 64, 1, 1);
  });
  return {};
}

Result<Search> prepare(FrameBuilder& frame, const gpu::ComputePipelineDesc& desc, uvec2 groups) {
  auto pipeline = frame.services().pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  return Search{*pipeline, groups};
}

void record(gpu::CommandList& commands, const Search& search, std::initializer_list<gpu::Binding> bindings) {
  commands.bind_pipeline(search.pipeline);
  commands.bind(bindings);
  commands.dispatch(search.groups.x, search.groups.y, 1);
}

uvec2 tiles_of(FrameBuilder& frame, const LightsOutputs& outputs) {
  const gpu::ImageDesc& desc = frame.graph().desc(outputs.tile_lists);
  return {desc.width, desc.height};
}
uvec2 groups_of(FrameBuilder& frame, const LightsOutputs& outputs) {
  return (tiles_of(frame, outputs) + uvec2(GLOAM_TILE_GROUP - 1)) / uvec2(GLOAM_TILE_GROUP);
}

Status add_approx_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  auto search = prepare(frame, approx_pipeline(), groups_of(frame, outputs));
  if (!search.ok()) return search.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const ImageRef bounds = frame.get<GeometryOutputs>().depth_bounds;
  PassBuilder pass = frame.graph().add_pass("find_lights_approx", "lights");
  pass.read(bounds, gpu::Access::compute_read);
  pass.read(outputs.texels, gpu::Access::compute_read);
  outputs.group_masks = pass.write(outputs.group_masks, gpu::Access::compute_write);
  outputs.tile_lists = pass.write(outputs.tile_lists, gpu::Access::compute_write);
  outputs.counters = pass.write(outputs.counters, gpu::Access::compute_write);
  pass.execute([&frame, o = outputs, bounds, search = *search, sampler = *sampler](PassContext& context) {
    record(context.commands(), search,
           {frame.view_binding(),
            {1, o.lights},
            {2, o.grid},
            {3, gpu::Binding::Sampled{{.image = context.image(bounds)}, sampler}},
            {4, gpu::Binding::Sampled{{.image = context.image(o.texels)}, sampler}},
            {5, o.z_bins},
            {6, o.mask_tiles},
            {7, gpu::Binding::BufferRange{context.buffer(o.group_masks)}},
            {8, gpu::Binding::Storage{{.image = context.image(o.tile_lists)}}},
            {9, gpu::Binding::BufferRange{context.buffer(o.counters)}}});
  });
  return {};
}

Status add_accurate_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  auto search = runs_threads_in_turn(frame.services().device.info())
                    ? prepare(frame, accurate_tiles_pipeline(), groups_of(frame, outputs))
                    : prepare(frame, accurate_pipeline(), tiles_of(frame, outputs));
  if (!search.ok()) return search.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  PassBuilder pass = frame.graph().add_pass("find_lights_accurate", "lights");
  for (const ImageRef image : {geometry.depth, outputs.texels, geometry.depth_bounds})
    pass.read(image, gpu::Access::compute_read);
  pass.read(outputs.group_masks, gpu::Access::compute_read);
  outputs.tile_lists = pass.write(outputs.tile_lists, gpu::Access::compute_write);
  outputs.early_lists = pass.write(outputs.early_lists, gpu::Access::compute_write);
  outputs.counters = pass.write(outputs.counters, gpu::Access::compute_write);
  pass.execute([&frame, o = outputs, geometry, search = *search, sampler = *sampler](PassContext& context) {
    record(context.commands(), search,
           {frame.view_binding(),
            {1, o.lights},
            {2, o.grid},
            {3, gpu::Binding::Sampled{{.image = context.image(geometry.depth)}, sampler}},
            {4, gpu::Binding::Sampled{{.image = context.image(o.texels)}, sampler}},
            {5, gpu::Binding::Sampled{{.image = context.image(geometry.depth_bounds)}, sampler}},
            {6, gpu::Binding::BufferRange{context.buffer(o.group_masks)}},
            {7, gpu::Binding::Storage{{.image = context.image(o.tile_lists)}}},
            {8, gpu::Binding::BufferRange{context.buffer(o.early_lists)}},
            {9, gpu::Binding::BufferRange{context.buffer(o.counters)}}});
  });
  return {};
}

Status add_check_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  auto search = prepare(frame, check_pipeline(), tiles_of(frame, outputs));
  if (!search.ok()) return search.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const ImageRef depth = frame.get<GeometryOutputs>().depth;
  PassBuilder pass = frame.graph().add_pass("check_lists", "lights");
  for (const ImageRef image : {depth, outputs.texels, outputs.tile_lists}) pass.read(image, gpu::Access::compute_read);
  for (const BufferRef buffer : {outputs.group_masks, outputs.early_lists})
    pass.read(buffer, gpu::Access::compute_read);
  outputs.counters = pass.write(outputs.counters, gpu::Access::compute_write);
  pass.execute([&frame, o = outputs, depth, search = *search, sampler = *sampler](PassContext& context) {
    record(context.commands(), search,
           {frame.view_binding(),
            {1, o.lights},
            {2, o.grid},
            {3, gpu::Binding::Sampled{{.image = context.image(depth)}, sampler}},
            {4, gpu::Binding::Sampled{{.image = context.image(o.texels)}, sampler}},
            {5, gpu::Binding::BufferRange{context.buffer(o.group_masks)}},
            {6, gpu::Binding::Sampled{{.image = context.image(o.tile_lists)}, sampler}},
            {7, gpu::Binding::BufferRange{context.buffer(o.early_lists)}},
            {8, gpu::Binding::BufferRange{context.buffer(o.counters)}}});
  });
  return {};
}

}  // namespace

void list_light_pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) {
  list.push_back(light_texels_pipeline());
  if (knobs.is("lights.culling", "brute")) return;
  list.push_back(approx_pipeline());
  list.push_back(runs_threads_in_turn(device) ? accurate_tiles_pipeline() : accurate_pipeline());
  if (knobs.is("lights.check", "on")) list.push_back(check_pipeline());
}

Status add_find_lights_passes(FrameBuilder& frame, const VisibleLights& visible, const ZBins& bins,
                              const TileLightMasks& masks) {
  LightsOutputs outputs;
  outputs.local_count = visible.block.local_count;
  outputs.directional_count = visible.block.directional_count;
  auto lights = frame.services().uniforms.write_value(visible.block);
  if (!lights.ok()) return lights.error();
  outputs.lights = *lights;
  const bool searches = outputs.local_count > 0 && frame.knobs().is("lights.culling", "tiled");
  if (searches) GLOAM_TRY(upload_light_lists(frame, bins, masks, outputs));
  if (outputs.local_count > 0) GLOAM_TRY(add_light_texels_pass(frame, outputs));
  if (searches) {
    GLOAM_TRY(add_approx_pass(frame, outputs));
    GLOAM_TRY(add_accurate_pass(frame, outputs));
    const bool checks = frame.knobs().is("lights.check", "on");
    if (checks) GLOAM_TRY(add_check_pass(frame, outputs));
    frame.keep_result("lights", kLightCountersResult, outputs.counters,
                      LightCountersNote{frame.view(), outputs.slot_capacity, checks});
  }
  frame.put(outputs);
  return {};
}

}  // namespace gloam
