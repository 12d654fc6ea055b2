// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/blur/blur_layers_passes.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

constexpr DofLine kRows{0, GLOAM_DOF_FAR_FIRST, 0}, kColumns{1, GLOAM_DOF_FAR_LAST, 0};
constexpr DofLine kUpwards{2, GLOAM_DOF_FAR_FIRST, 0};
constexpr DofLine kRightwardsAndUp{3, GLOAM_DOF_FAR_FIRST, 1};
constexpr DofLine kUpThenRight{3, GLOAM_DOF_FAR_LAST, 0};
constexpr DofLine kBothThenLeft{4, GLOAM_DOF_FAR_LAST, 2};

ImageRef& layer(DofLayers& layers, bool near) { return near ? layers.near : layers.far; }
const ImageRef& layer(const DofLayers& layers, bool near) { return near ? layers.near : layers.far; }

ImageRef layer_image(FrameBuilder& frame, const DofFrame& dof, const std::string& name, bool near) {
  return create_view_image(frame, name + (near ? "_near" : "_far"), gpu::Format::rgba16_float, dof.inputs.scale());
}

void read_common(ComputePass& pass, const DofFrame& dof) {
  pass.read("dof", dof.inputs.block);
  pass.read("reach_image", dof.tiles.reach, Sampling::linear);
  if (pass.declares("tile_flags"))
    pass.read("tile_flags", dof.tiles.flags);
  else
    read_dof_lists(pass, dof.tiles);
}

DofLayers add_round_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& from, bool columns) {
  const char* name = columns ? "dof_blur_y" : "dof_blur_x";
  DofLayers blurred;
  ComputePass pass(frame, name, dof_round_program(dof.inputs.scale(), false, columns));
  for (const bool near : {false, true}) {
    pass.use(dof_round_program(dof.inputs.scale(), near, columns));
    read_common(pass, dof);
    pass.read("layer_image", layer(from, near));
    layer(blurred, near) = pass.write("blurred_image", layer_image(frame, dof, name, near));
    dispatch_dof_list(pass, dof.tiles, (columns ? GLOAM_DOF_FAR_LAST : GLOAM_DOF_FAR_FIRST) + (near ? 1 : 0));
  }
  return blurred;
}

DofLayers add_hexagon_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& from) {
  DofLayers upright, both, blurred;
  ComputePass lines(frame, "dof_hexagon_lines", dof_hexagon_lines_program(dof.inputs.scale(), false));
  for (const bool near : {false, true}) {
    lines.use(dof_hexagon_lines_program(dof.inputs.scale(), near));
    read_common(lines, dof);
    lines.read("layer_image", layer(from, near));
    layer(upright, near) = lines.write("upright_image", layer_image(frame, dof, "dof_upright", near));
    layer(both, near) = lines.write("both_image", layer_image(frame, dof, "dof_both", near));
    dispatch_dof_list(lines, dof.tiles, GLOAM_DOF_FAR_FIRST + (near ? 1 : 0));
  }
  ComputePass rhombi(frame, "dof_hexagon_rhombi", dof_hexagon_rhombi_program(dof.inputs.scale(), false));
  for (const bool near : {false, true}) {
    rhombi.use(dof_hexagon_rhombi_program(dof.inputs.scale(), near));
    read_common(rhombi, dof);
    rhombi.read("upright_image", layer(upright, near));
    rhombi.read("both_image", layer(both, near));
    layer(blurred, near) = rhombi.write("blurred_image", layer_image(frame, dof, "dof_hexagon", near));
    dispatch_dof_list(rhombi, dof.tiles, GLOAM_DOF_FAR_LAST + (near ? 1 : 0));
  }
  return blurred;
}

/// Numbers of workgroups that cover all lines of a direction (on_line(), line.glsl).
uvec2 line_groups(const uvec2& size, std::uint32_t direction) {
  const bool upright = direction == kColumns.direction || direction == kUpwards.direction;
  const std::uint32_t length = upright ? size.y : size.x;
  std::uint32_t lines = upright ? size.x : size.y;
  if (direction > kUpwards.direction) lines += (size.x + 1) / 2;  // slanted lines
  return {(length + GLOAM_DOF_LINE - 1) / GLOAM_DOF_LINE, lines};
}

DofLayers add_line_pass(FrameBuilder& frame, const DofFrame& dof, const char* name, const DofLine& line,
                        const DofLayers& from, const DofLayers& other = {}) {
  DofLayers blurred;
  ComputePass pass(frame, name, dof_line_program(dof.inputs.knobs.cache, dof.inputs.scale(), false, line));
  const uvec2 groups = line_groups(dof.inputs.constants.layer_size, line.direction);
  for (const bool near : {false, true}) {
    pass.use(dof_line_program(dof.inputs.knobs.cache, dof.inputs.scale(), near, line));
    read_common(pass, dof);
    pass.read("layer_image", layer(from, near));
    pass.read("other_image", layer(other, near));
    layer(blurred, near) = pass.write("blurred_image", layer_image(frame, dof, name, near));
    pass.dispatch(groups.x, groups.y);
  }
  return blurred;
}

DofLayers add_line_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& from) {
  if (dof.inputs.bokeh == Bokeh::round)
    return add_line_pass(frame, dof, "dof_blur_y", kColumns, add_line_pass(frame, dof, "dof_blur_x", kRows, from));
  const DofLayers upright = add_line_pass(frame, dof, "dof_upright", kUpwards, from);
  const DofLayers both = add_line_pass(frame, dof, "dof_both", kRightwardsAndUp, from, upright);
  const DofLayers right = add_line_pass(frame, dof, "dof_right", kUpThenRight, upright);
  return add_line_pass(frame, dof, "dof_hexagon", kBothThenLeft, both, right);
}

}  // namespace

ComputeProgram dof_prefilter_program(std::uint32_t scale, bool near) {
  return {shaders::depth_of_field::prefilter_comp, {{"kScale", scale}, {"kNear", near ? 1u : 0u}}};
}
ComputeProgram dof_round_program(std::uint32_t scale, bool near, bool columns) {
  return {shaders::depth_of_field::round_comp,
          {{"kScale", scale}, {"kNear", near ? 1u : 0u}, {"kDirection", columns ? 1u : 0u}}};
}
ComputeProgram dof_hexagon_lines_program(std::uint32_t scale, bool near) {
  return {shaders::depth_of_field::hexagon_lines_comp, {{"kScale", scale}, {"kNear", near ? 1u : 0u}}};
}
ComputeProgram dof_hexagon_rhombi_program(std::uint32_t scale, bool near) {
  return {shaders::depth_of_field::hexagon_rhombi_comp, {{"kScale", scale}, {"kNear", near ? 1u : 0u}}};
}
ComputeProgram dof_line_program(DofKnobs::Cache cache, std::uint32_t scale, bool near, const DofLine& line) {
  const std::uint32_t layer = near ? 1 : 0;
  return {cache == DofKnobs::Cache::vectors ? shaders::depth_of_field::line_vec4_comp
                                            : shaders::depth_of_field::line_channels_comp,
          {{"kScale", scale},
           {"kNear", layer},
           {"kDirection", line.direction},
           {"kList", line.list + layer},
           {"kOther", line.other}}};
}

std::vector<ComputeProgram> dof_blur_programs(const DofKnobs& knobs, Bokeh bokeh) {
  const std::uint32_t scale = knobs.scale();
  const bool round = bokeh == Bokeh::round;
  std::vector<ComputeProgram> programs;
  for (const bool near : {false, true}) {
    if (knobs.cache != DofKnobs::Cache::none) {
      const auto lines =
          round ? std::vector{kRows, kColumns} : std::vector{kUpwards, kRightwardsAndUp, kUpThenRight, kBothThenLeft};
      for (const DofLine& line : lines) programs.push_back(dof_line_program(knobs.cache, scale, near, line));
    } else if (round) {
      for (const bool columns : {false, true}) programs.push_back(dof_round_program(scale, near, columns));
    } else {
      programs.push_back(dof_hexagon_lines_program(scale, near));
      programs.push_back(dof_hexagon_rhombi_program(scale, near));
    }
  }
  return programs;
}

DofLayers add_dof_prefilter_pass(FrameBuilder& frame, const DofFrame& dof) {
  DofLayers layers;
  ComputePass pass(frame, "dof_prefilter", dof_prefilter_program(dof.inputs.scale(), false));
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  pass.read("lit_image", frame.get<LitOutput>().color);
  layers.far = pass.write("far_image", layer_image(frame, dof, "dof_layer", false));
  layers.near = pass.write("near_image", layer_image(frame, dof, "dof_layer", true));
  read_dof_lists(pass, dof.tiles);
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_PREFILTER_FAR);
  pass.use(dof_prefilter_program(dof.inputs.scale(), true));
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_PREFILTER_BOTH);
  return layers;
}

DofLayers add_dof_blur_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& layers) {
  if (dof.inputs.knobs.cache != DofKnobs::Cache::none) return add_line_passes(frame, dof, layers);
  if (dof.inputs.bokeh == Bokeh::hexagonal) return add_hexagon_passes(frame, dof, layers);
  return add_round_pass(frame, dof, add_round_pass(frame, dof, layers, false), true);
}

}  // namespace gloam
