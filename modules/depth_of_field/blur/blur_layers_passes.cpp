// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/blur/blur_layers_passes.h"

#include <algorithm>

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

constexpr int kMostGatherTiles = 16;  ///< of a workgroup: each thread reads the work of all

ImageRef layer_image(FrameBuilder& frame, const DofFrame& dof, const char* name) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.format = gpu::Format::rgba16_float;
  desc.width = dof.inputs.layers_size.x;
  desc.height = dof.inputs.layers_size.y;
  return frame.graph().create_image(std::move(desc));
}

gpu::ShaderCode gather_shader(DofKnobs::Cache cache) {
  switch (cache) {
    case DofKnobs::Cache::vectors:
      return shaders::depth_of_field::gather_vec4_comp;
    case DofKnobs::Cache::channels:
      return shaders::depth_of_field::gather_channels_comp;
    default:
      return shaders::depth_of_field::gather_comp;
  }
}

/// Forms that wait for one another's texels have as many threads as there are texels.
std::int32_t gather_threads(DofKnobs::Cache form, bool threads_in_turn) {
  return dof_threads(threads_in_turn && form == DofKnobs::Cache::none);
}

/// One dispatch for each level.
void dispatch_levels(ComputePass& pass, const DofFrame& dof, std::uint32_t list) {
  for (int k = dof.inputs.constants.first_level; k <= dof.inputs.constants.last_level; ++k) {
    pass.push(shaders::DofLevel{k});
    dispatch_dof_list(pass, dof.tiles, list + static_cast<std::uint32_t>(k));
  }
}

}  // namespace

ComputeProgram dof_prefilter_program(Bokeh bokeh, bool more, bool fine, bool threads_in_turn) {
  return {shaders::depth_of_field::prefilter_comp,
          {{"kHexagonal", dof_hexagonal(bokeh)},
           {"kMore", more ? 1u : 0u},
           {"kThreads", dof_threads(threads_in_turn)},
           {"kFine", fine ? 1u : 0u}}};
}

ComputeProgram dof_gather_program(DofKnobs::Cache cache, Bokeh bokeh, bool near, bool threads_in_turn) {
  const DofKnobs::Cache form = dof_cache(cache, threads_in_turn);
  return {gather_shader(form),
          {{"kHexagonal", dof_hexagonal(bokeh)},
           {"kNear", near ? 1u : 0u},
           {"kThreads", gather_threads(form, threads_in_turn)}}};
}

void set_dof_workgroups(DofInputs& inputs) {
  const DofKnobs::Cache form = dof_cache(inputs.knobs.cache, inputs.threads_in_turn);
  const int filtering = dof_threads(inputs.threads_in_turn);
  const int gathering = gather_threads(form, inputs.threads_in_turn);
  for (int k = 0; k < GLOAM_DOF_LEVELS; ++k) {
    const int side = GLOAM_DOF_TILE >> k, blocks = std::max(side / 2, 1);
    inputs.constants.prefilter_tiles[k] = k == 0 ? 1 : std::max(filtering / (side * side), 1);
    const bool alone = form != DofKnobs::Cache::none;
    inputs.constants.gather_tiles[k] = alone ? 1 : std::clamp(gathering / (blocks * blocks), 1, kMostGatherTiles);
  }
}

DofLayers add_dof_prefilter_pass(FrameBuilder& frame, const DofFrame& dof, const DofSprites& sprites) {
  DofLayers layers;
  const auto program = [&](bool more, bool fine) {
    return dof_prefilter_program(dof.inputs.bokeh, more, fine, dof.inputs.threads_in_turn);
  };
  ComputePass pass(frame, "dof_prefilter", program(false, false));
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  pass.read("lit_image", frame.get<LitOutput>().color);
  pass.read("tile_sprites", sprites.tiles);
  layers.far = pass.write("far_image", layer_image(frame, dof, "dof_layer_far"));
  layers.near = pass.write("near_image", layer_image(frame, dof, "dof_layer_near"));
  read_dof_lists(pass, dof.tiles);
  for (const bool more : {false, true}) {
    const std::uint32_t list = more ? GLOAM_DOF_PREFILTER_MORE : GLOAM_DOF_PREFILTER;
    for (int k = dof.inputs.constants.first_level; k <= dof.inputs.constants.last_level; ++k) {
      pass.use(program(more, k == 0));
      pass.push(shaders::DofLevel{k});
      dispatch_dof_list(pass, dof.tiles, list + static_cast<std::uint32_t>(k));
    }
  }
  return layers;
}

DofLayers add_dof_gather_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& layers) {
  DofLayers gathered;
  const auto program = [&](bool near) {
    return dof_gather_program(dof.inputs.knobs.cache, dof.inputs.bokeh, near, dof.inputs.threads_in_turn);
  };
  ComputePass pass(frame, "dof_gather", program(false));
  pass.read("dof", dof.inputs.block);
  read_dof_lists(pass, dof.tiles);
  pass.read("layer_image", layers.far);
  gathered.far = pass.write("blurred_image", layer_image(frame, dof, "dof_blurred_far"));
  dispatch_levels(pass, dof, GLOAM_DOF_FAR);
  pass.use(program(true));
  pass.read("layer_image", layers.near);
  gathered.near = pass.write("blurred_image", layer_image(frame, dof, "dof_blurred_near"));
  dispatch_levels(pass, dof, GLOAM_DOF_NEAR);
  return gathered;
}

}  // namespace gloam
