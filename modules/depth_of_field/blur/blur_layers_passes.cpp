// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/blur/blur_layers_passes.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

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

}  // namespace

ComputeProgram dof_prefilter_program(Bokeh bokeh, bool fine, bool threads_in_turn) {
  return {shaders::depth_of_field::prefilter_comp, dof_constants(bokeh, "kFine", fine, threads_in_turn)};
}

ComputeProgram dof_gather_program(DofKnobs::Cache cache, Bokeh bokeh, bool near, bool threads_in_turn) {
  const DofKnobs::Cache form = dof_cache(cache, threads_in_turn);
  // Forms that wait for one another's texels have as many threads as there are texels.
  const bool few = threads_in_turn && form == DofKnobs::Cache::none;
  return {gather_shader(form), dof_constants(bokeh, "kNear", near, few)};
}

DofLayers add_dof_prefilter_pass(FrameBuilder& frame, const DofFrame& dof, const DofSprites& sprites) {
  DofLayers layers;
  ComputePass pass(frame, "dof_prefilter", dof_prefilter_program(dof.inputs.bokeh, true, dof.inputs.threads_in_turn));
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  pass.read("lit_image", frame.get<LitOutput>().color);
  pass.read("tile_sprites", sprites.tiles);
  layers.far = pass.write("far_image", layer_image(frame, dof, "dof_layer_far"));
  layers.near = pass.write("near_image", layer_image(frame, dof, "dof_layer_near"));
  read_dof_lists(pass, dof.tiles);
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_PREFILTER_FINE);
  pass.use(dof_prefilter_program(dof.inputs.bokeh, false, dof.inputs.threads_in_turn));
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_PREFILTER_COARSE);
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
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_FAR);
  pass.use(program(true));
  pass.read("layer_image", layers.near);
  gathered.near = pass.write("blurred_image", layer_image(frame, dof, "dof_blurred_near"));
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_NEAR);
  return gathered;
}

}  // namespace gloam
