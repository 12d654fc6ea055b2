// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/dof_passes.h"

#include <cmath>

#include "engine/core/assert.h"
#include "modules/depth_of_field/blur/blur_layers_passes.h"
#include "modules/depth_of_field/compose/compose_layers_pass.h"
#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

// Pixels of the circle's radius over which the picture passes from sharp to blurred. Layers of half the size are as
// soft as a circle of 2 pixels. A later end of the passage lowers FLIP against the lens, but shows sharp edges in
// blurs.
constexpr float kHalfBlend_px = 2.5f;
constexpr float kFullBlend_px = 0.75f;

// Radius of the round kernel as a multiple of the circle's. Its light falls to a half at 0.51 radii of the circle and
// to a hundredth at 1.2, in nearly all directions alike.
constexpr float kRoundReach = 1.4f;

// Tiles that a kernel of this radius in pixels reaches (taps_of(), list.comp.glsl).
int spread_of(float radius, float scale) {
  const float taps = std::ceil(radius * 1.001f / scale + 0.5f) - 1.0f;
  return static_cast<int>(std::ceil(taps * scale / static_cast<float>(GLOAM_DOF_TILE)));
}

shaders::DofConstants constants_of(const RenderView& view, const DofKnobs& knobs, const Lens& lens, Bokeh bokeh) {
  shaders::DofConstants c{};
  c.size = {view.width, view.height};
  c.layer_size = (c.size + knobs.scale() - 1u) / knobs.scale();
  c.tiles = (c.size + std::uint32_t{GLOAM_DOF_TILE} - 1u) / std::uint32_t{GLOAM_DOF_TILE};
  c.inverse_size = 1.0f / vec2(c.size);
  c.coc_offset = static_cast<float>(lens.offset_px);
  c.coc_slope = static_cast<float>(lens.slope_px);
  c.radius = knobs.radius;
  c.blend = knobs.full_resolution ? kFullBlend_px : kHalfBlend_px;
  c.reach = bokeh == Bokeh::round ? kRoundReach : 1.0f;
  c.spread = spread_of(c.radius * c.reach, static_cast<float>(knobs.scale()));
  GLOAM_ASSERT(c.spread <= GLOAM_DOF_MOST_SPREAD, "a kernel reaches farther than its tiles are searched");
  return c;
}

}  // namespace

void add_dof_passes(FrameBuilder& frame, const DepthOfField& values, const Lens& lens) {
  DofInputs inputs;
  inputs.knobs = dof_knobs(frame.knobs());
  inputs.bokeh = values.bokeh;
  inputs.constants = constants_of(frame.view(), inputs.knobs, lens, inputs.bokeh);
  inputs.block = frame.upload_uniform(inputs.constants);
  inputs.depth = front_depth(frame);
  const DofFrame dof{inputs, add_dof_tile_passes(frame, inputs)};
  const DofLayers layers = add_dof_prefilter_pass(frame, dof);
  const DofLayers blurred = add_dof_blur_passes(frame, dof, layers);
  add_dof_compose_pass(frame, dof, blurred);
  frame.put(dof);
}

void list_dof_pipelines(const DofKnobs& knobs, bool threads_in_turn, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "depth_of_field")); };
  add(dof_bounds_program());
  add(dof_reach_program());
  for (const bool near : {false, true}) {
    add(dof_prefilter_program(knobs.scale(), near));
    add(dof_compose_program(knobs.scale(), near, threads_in_turn));
  }
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    add(dof_list_program(knobs.scale(), bokeh));
    for (const ComputeProgram& program : dof_blur_programs(knobs, bokeh)) add(program);
  }
}

}  // namespace gloam
