// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/draw_blades_passes.h"

#include <cstddef>
#include <utility>

#include "engine/render/declare/kept_indices.h"
#include "modules/grass/drawing/part_casters.h"
#include "modules/grass/drawing/textures.h"
#include "modules/grass/lod/detail.h"
#include "shaders/grass/drawing/pose_shared.h"
#include "shaders/grass/shaders.h"

namespace gloam {
namespace {

constexpr std::size_t kCasterClass = GLOAM_GRASS_CAST_CLASS;

const gpu::ShaderCode& blade_fragment(const BladeVersion& version) {
  if (version.textured)
    return version.motion ? shaders::grass::surface_textured_motion_frag : shaders::grass::surface_textured_frag;
  return version.motion ? shaders::grass::surface_motion_frag : shaders::grass::surface_frag;
}

}  // namespace

ComputeProgram grass_pose_program() { return {shaders::grass::pose_comp}; }

DrawProgram blade_program(std::uint32_t draw_class, const BladeVersion& version) {
  return {.fragment = blade_fragment(version),
          .constants = {{"kClass", draw_class},
                        {"kSegments", kClassSegments[draw_class]},
                        {"kClipped", version.clipped ? 1u : 0u}},
          .vertex = version.motion ? shaders::grass::blade_motion_vert : shaders::grass::blade_vert,
          .depth_write = true};
}

CasterProgram blade_caster_program() {
  return {.vertex = shaders::grass::caster_vert, .constants = {{"kSegments", kClassSegments[kCasterClass]}}};
}

void list_blade_pipelines(const BladeVersion& version, PipelineList& list) {
  for (std::uint32_t i = 0; i < GLOAM_GRASS_CLASSES; ++i)
    list.push_back(
        pipeline_desc(blade_program(i, version), "grass", geometry_formats(version.motion), kGeometryDepthFormat));
}

bool blade_pipelines_ready(const FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  if (services.wait_for_pipelines) return true;
  const auto* geometry = frame.find<GeometryOutputs>();
  PipelineList list;
  list_blade_pipelines({.motion = geometry != nullptr && geometry->motion,
                        .clipped = frame.view().clipped,
                        .textured = has_blade_textures(frame.world())},
                       list);
  return services.pipelines.request(list, services.log);
}

void bind_blades(ShaderPass& pass, const DrawnBlades& blades) {
  pass.read("poses", blades.poses);
  pass.read("draws", blades.draws);
  pass.read("knots", blades.knots);
}

DrawnBlades add_pose_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                          const SortedBlades& sorted) {
  ComputePass pass(frame, "grass_poses", grass_pose_program());
  pass.read("lod", inputs.lod_range);
  pass.read("patches", inputs.patch_rows);
  pass.read("blade_rows", store.rows);
  pass.read("types", inputs.types);
  pass.read("blades", sorted.blades);
  pass.read("draws", sorted.draws);
  pass.read("knots", store.knots);
  pass.read("previous_knots", store.previous_knots);
  pass.read("stamps", store.stamps);
  gpu::BufferDesc desc;
  desc.name = "grass_poses";
  desc.module = "grass";
  desc.size = std::uint64_t{inputs.patches} * GLOAM_GRASS_PATCH_BLADES * sizeof(shaders::GrassPose);
  DrawnBlades posed;
  posed.poses = pass.write("poses", frame.graph().create_buffer(desc));
  desc.name = "grass_casters";
  desc.size = std::uint64_t{inputs.patches} * GLOAM_GRASS_PATCH_BLADES * sizeof(std::uint32_t);
  posed.casters = pass.write("casters", frame.graph().create_buffer(desc));
  posed.casting = pass.write("casting", sorted.casting);
  pass.dispatch_indirect(sorted.draws, offsetof(shaders::GrassDraws, blade_groups));
  return posed;
}

DrawnBlades add_blade_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                           const SortedBlades& sorted, DrawnBlades posed) {
  const BufferRef indices = kept_indices(frame, "grass_indices", blade_indices());
  DrawnBlades blades = posed;
  blades.draws = sorted.draws;
  blades.knots = store.knots;
  blades.indices = indices;
  if (!frame.status().ok()) return blades;
  GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  const BladeVersion version{.motion = static_cast<bool>(geometry.motion),
                             .clipped = frame.view().clipped,
                             .textured = static_cast<bool>(inputs.textures)};
  DrawPass pass(frame, "grass_blades", blade_program(0, version));
  geometry_targets(pass, geometry);
  for (std::uint32_t i = 0; i < GLOAM_GRASS_CLASSES; ++i) {
    if (i > 0) pass.use(blade_program(i, version));
    bind_blades(pass, blades);
    bind_motion(pass, frame.view());
    if (version.textured) pass.read("blade_textures", inputs.textures, Sampling::linear);
    if (version.motion) {
      pass.uniform("steps", inputs.steps);
      pass.read("previous_knots", store.previous_knots);
      pass.read("stamps", store.stamps);
    }
    pass.draw_indexed_indirect(blades.indices, blades.draws,
                               offsetof(shaders::GrassDraws, draws) + i * sizeof(shaders::GrassDraw), 1);
  }
  return blades;
}

void add_blade_casters(FrameBuilder& frame, std::shared_ptr<const GrassFrame> grass, const CastingBlades& casting) {
  const auto pipeline = frame.services().pipelines.get(caster_pipeline_desc(blade_caster_program(), frame.module()));
  if (!frame.check(pipeline)) return;
  CasterSource source;
  source.bounds = casting.bounds;
  source.moving = casting.rest == 0;
  source.content_hash = source.moving ? casting.content : casting.rest;
  source.turns = source.moving ? casting.turns : 1;
  const auto lists = std::make_shared<std::vector<PartLists>>();
  source.prepare = [grass, lists, most = casting.most](FrameBuilder& later, std::span<const CasterSourcePart> parts) {
    return add_part_lists(later, grass->drawn, most, parts, *lists);
  };
  source.declare_reads = [grass, lists](PassBuilder& pass) {
    const DrawnBlades& blades = grass->drawn;
    for (const PartLists& one : *lists) {
      pass.read(one.casting, gpu::Access::vertex_read);
      pass.read(one.casting, gpu::Access::indirect_read);
      pass.read(one.casters, gpu::Access::vertex_read);
    }
    for (const BufferRef buffer : {blades.poses, blades.draws, blades.knots, blades.casting, blades.casters})
      pass.read(buffer, gpu::Access::vertex_read);
    pass.read(blades.casting, gpu::Access::indirect_read);
    pass.read(blades.indices, gpu::Access::vertex_input);
  };
  source.record = [grass, lists, pipeline = *pipeline,
                   world_from_relative =
                       glm::translate(dmat4(1.0), frame.view().position)](const CasterSourceDraw& draw) {
    PassContext& context = draw.context();
    const DrawnBlades& blades = grass->drawn;
    const auto bound = [&](std::uint32_t binding, BufferRef buffer) {
      return gpu::Binding{binding, gpu::Binding::BufferRange{context.buffer(buffer)}};
    };
    gpu::Binding::BufferRange counts{context.buffer(blades.casting)}, casters{context.buffer(blades.casters)};
    if (const PartLists* part = find_part(*lists, draw.part())) {
      const std::uint64_t at = draw.part() - part->first, bytes = std::uint64_t{part->room} * sizeof(std::uint32_t);
      counts = {context.buffer(part->casting), at * PartLists::kPartBytes, sizeof(shaders::GrassCasting)};
      casters = {context.buffer(part->casters), at * bytes, bytes};
    }
    const gpu::Binding bindings[] = {bound(1, blades.poses), bound(2, blades.draws), bound(3, blades.knots),
                                     gpu::Binding{4, counts}, gpu::Binding{5, casters}};
    gpu::CommandList& commands = context.commands();
    draw.bind_pipeline(pipeline);
    commands.bind(bindings);
    commands.push(draw.projection().constants(world_from_relative));
    commands.bind_indices(context.buffer(blades.indices), 0);
    commands.draw_indexed_indirect(counts.buffer, counts.offset + offsetof(shaders::GrassCasting, draw), 1);
  };
  frame.add_caster_source(std::move(source));
}

}  // namespace gloam
