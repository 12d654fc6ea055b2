// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/blur/blur_layers_passes.h"

#include <array>
#include <string>

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

constexpr DofLine kRows{0, GLOAM_DOF_FAR_FIRST, 0}, kColumns{1, GLOAM_DOF_FAR_LAST, 0};
constexpr DofLine kUpwards{2, GLOAM_DOF_FAR_FIRST, 0};
constexpr DofLine kRightwardsAndUp{3, GLOAM_DOF_FAR_FIRST, 1};
constexpr DofLine kUpThenRight{3, GLOAM_DOF_FAR_LAST, 0};
constexpr DofLine kBothThenLeft{4, GLOAM_DOF_FAR_LAST, 2};

struct LayerTraits {
  ImageRef DofLayers::*image;
  const char* name;
  std::uint32_t first, last;  ///< lists of tiles of the first and of the last pass
};
constexpr std::array kTraits = {
    LayerTraits{&DofLayers::far, "_far", GLOAM_DOF_FAR_FIRST, GLOAM_DOF_FAR_LAST},
    LayerTraits{&DofLayers::near, "_near", GLOAM_DOF_NEAR_FIRST, GLOAM_DOF_NEAR_LAST},
    LayerTraits{&DofLayers::beyond, "_beyond", GLOAM_DOF_BEYOND_FIRST, GLOAM_DOF_BEYOND_LAST}};
constexpr std::array kLayers = {DofLayer::far, DofLayer::near, DofLayer::beyond};

const LayerTraits& traits(DofLayer layer) { return kTraits[static_cast<std::size_t>(layer)]; }
ImageRef& image(DofLayers& layers, DofLayer layer) { return layers.*traits(layer).image; }
const ImageRef& image(const DofLayers& layers, DofLayer layer) { return layers.*traits(layer).image; }
std::uint32_t list_of(DofLayer layer, bool last) { return last ? traits(layer).last : traits(layer).first; }
/// kNear: the light beyond has the kernels of the near layer.
std::uint32_t kernels(DofLayer layer) { return layer == DofLayer::far ? 0 : 1; }

ImageRef layer_image(FrameBuilder& frame, const DofFrame& dof, const std::string& name, DofLayer layer) {
  return create_view_image(frame, name + traits(layer).name, gpu::Format::rgba16_float, dof.inputs.scale());
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
  ComputePass pass(frame, name, dof_round_program(dof.inputs.scale(), DofLayer::far, columns));
  for (const DofLayer layer : kLayers) {
    pass.use(dof_round_program(dof.inputs.scale(), layer, columns));
    read_common(pass, dof);
    pass.read("layer_image", image(from, layer));
    image(blurred, layer) = pass.write("blurred_image", layer_image(frame, dof, name, layer));
    dispatch_dof_list(pass, dof.tiles, list_of(layer, columns));
  }
  return blurred;
}

DofLayers add_hexagon_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& from) {
  DofLayers upright, both, blurred;
  ComputePass lines(frame, "dof_hexagon_lines", dof_hexagon_lines_program(dof.inputs.scale(), DofLayer::far));
  for (const DofLayer layer : kLayers) {
    lines.use(dof_hexagon_lines_program(dof.inputs.scale(), layer));
    read_common(lines, dof);
    lines.read("layer_image", image(from, layer));
    image(upright, layer) = lines.write("upright_image", layer_image(frame, dof, "dof_upright", layer));
    image(both, layer) = lines.write("both_image", layer_image(frame, dof, "dof_both", layer));
    dispatch_dof_list(lines, dof.tiles, list_of(layer, false));
  }
  ComputePass rhombi(frame, "dof_hexagon_rhombi", dof_hexagon_rhombi_program(dof.inputs.scale(), DofLayer::far));
  for (const DofLayer layer : kLayers) {
    rhombi.use(dof_hexagon_rhombi_program(dof.inputs.scale(), layer));
    read_common(rhombi, dof);
    rhombi.read("upright_image", image(upright, layer));
    rhombi.read("both_image", image(both, layer));
    image(blurred, layer) = rhombi.write("blurred_image", layer_image(frame, dof, "dof_hexagon", layer));
    dispatch_dof_list(rhombi, dof.tiles, list_of(layer, true));
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
  for (const DofLayer layer : kLayers) {
    pass.use(dof_line_program(dof.inputs.knobs.cache, dof.inputs.scale(), layer != DofLayer::far, line));
    read_common(pass, dof);
    pass.read("layer_image", image(from, layer));
    pass.read("other_image", image(other, layer));
    image(blurred, layer) = pass.write("blurred_image", layer_image(frame, dof, name, layer));
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
ComputeProgram dof_round_program(std::uint32_t scale, DofLayer layer, bool columns) {
  return {shaders::depth_of_field::round_comp,
          {{"kScale", scale},
           {"kNear", kernels(layer)},
           {"kDirection", columns ? 1u : 0u},
           {"kList", list_of(layer, columns)}}};
}
ComputeProgram dof_hexagon_lines_program(std::uint32_t scale, DofLayer layer) {
  return {shaders::depth_of_field::hexagon_lines_comp,
          {{"kScale", scale}, {"kNear", kernels(layer)}, {"kList", list_of(layer, false)}}};
}
ComputeProgram dof_hexagon_rhombi_program(std::uint32_t scale, DofLayer layer) {
  return {shaders::depth_of_field::hexagon_rhombi_comp,
          {{"kScale", scale}, {"kNear", kernels(layer)}, {"kList", list_of(layer, true)}}};
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
  for (const DofLayer layer : kLayers) {
    if (knobs.cache != DofKnobs::Cache::none) {
      const auto lines =
          round ? std::vector{kRows, kColumns} : std::vector{kUpwards, kRightwardsAndUp, kUpThenRight, kBothThenLeft};
      for (const DofLine& line : lines)
        programs.push_back(dof_line_program(knobs.cache, scale, layer != DofLayer::far, line));
    } else if (round) {
      for (const bool columns : {false, true}) programs.push_back(dof_round_program(scale, layer, columns));
    } else {
      programs.push_back(dof_hexagon_lines_program(scale, layer));
      programs.push_back(dof_hexagon_rhombi_program(scale, layer));
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
  layers.far = pass.write("far_image", layer_image(frame, dof, "dof_layer", DofLayer::far));
  layers.near = pass.write("near_image", layer_image(frame, dof, "dof_layer", DofLayer::near));
  layers.beyond = pass.write("beyond_image", layer_image(frame, dof, "dof_layer", DofLayer::beyond));
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
