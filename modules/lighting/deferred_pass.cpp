// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <optional>
#include <span>

#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/environment.h"
#include "modules/lighting/kept_light.h"
#include "modules/lighting/lighting_passes.h"
#include "modules/lighting/occlusion_passes.h"
#include "modules/lighting/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/lit_tiles_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {

namespace {

constexpr gpu::Format kDiffuseLightFormat = gpu::Format::rgba16_float;

/// Source of the local lights in the shader.
enum class LocalLights : std::uint8_t {
  all,             ///< every light of the view
  lists_or_masks,  ///< the tile's early list, or its group mask if the list did not fit
  lists,           ///< the tile's early list; needs LightsOutputs::lists_always_fit
  final_lists,     ///< the tile's final list, directional lights included; fallback tiles are drawn afterwards
};

bool has_cookies(const ShadowsOutputs& shadows) { return shadows.cookie_lights > 0; }

/// `shadows`: null for shading without shadows and cookies.
gpu::ShaderCode shading_code(LocalLights source, const ShadowsOutputs* shadows) {
  using namespace shaders::lighting;
  const bool tiled = source != LocalLights::all;
  if (source == LocalLights::final_lists)
    return has_cookies(*shadows) ? deferred_final_cookies_frag : deferred_final_frag;
  if (shadows == nullptr) return tiled ? deferred_tiled_frag : deferred_frag;
  if (shadows->cookies_only) return tiled ? deferred_tiled_cookies_frag : deferred_cookies_frag;
  if (shadows->standard) return tiled ? deferred_tiled_shadowed_standard_frag : deferred_shadowed_standard_frag;
  return tiled ? deferred_tiled_shadowed_frag : deferred_shadowed_frag;
}

/// A full-screen triangle at depth 0, the depth of the sky: the depth test selects the pixels with a surface. Pixels
/// that fail the test cost nothing. A condition in the shader would not save time on software devices, which run both
/// sides of it.
DrawProgram shading_program(LocalLights source, const ShadingInputs& inputs, const ShadowsOutputs* shadows) {
  const bool tiled = source != LocalLights::all, final_lists = source == LocalLights::final_lists;
  const bool shadowed = shadows != nullptr && !shadows->cookies_only && !final_lists;
  DrawProgram program{shading_code(source, shadows)};
  program.depth_compare = gpu::CompareOp::less;
  if (shadows != nullptr) program.constants = shadows->constants;
  if (inputs.transmission) program.constants.set("kTransmission", 1u);
  if (inputs.plain_highlights) program.constants.set("kPlainHighlights", 1u);
  // Loops with shadows are not unrolled: one pipeline serves any number of directional lights.
  if (!shadowed) program.constants.set("kDirectionalLights", inputs.directional_count);
  if (inputs.specular_ambient_taken) program.constants.set("kSpecularAmbient", 0u);
  if (inputs.surroundings_follow) program.constants.set("kSpecularAmbient", 2u);
  if (inputs.diffuse_light_wanted) program.constants.set("kDiffuseLight", 1u);
  program.constants.set(indirect_constants(inputs));
  if (inputs.traced_indirect) program.constants.set("kTracedIndirect", 1u);
  if (inputs.occlusion) program.constants.set("kOcclusion", 1u);
  if (final_lists) {
    program.constants.set(shadows->final_lists->constants);
  } else if (tiled) {
    program.constants.set("kAlwaysFit", source == LocalLights::lists ? 1u : 0u);
  }
  return program;
}

/// Draws fallback tiles as with shadows.mode = monolithic.
DrawProgram fallback_program(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  const LocalLights source = inputs.outputs.has_lists() ? LocalLights::lists_or_masks : LocalLights::all;
  DrawProgram program = shading_program(source, inputs, &shadows);
  program.vertex = shaders::lighting::deferred_fallback_vert;
  return program;
}

/// Draws runs of tiles as shading_program() with final lists draws all.
DrawProgram tile_program(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  DrawProgram program = shading_program(LocalLights::final_lists, inputs, &shadows);
  program.vertex = shaders::lighting::lit_tiles_vert;
  return program;
}

/// Draws the pixels without a surface.
DrawProgram sky_program(const ShadingInputs& inputs) {
  DrawProgram program{shaders::lighting::sky_frag};
  if (inputs.diffuse_light_wanted) program.constants.set("kDiffuseLight", 1u);
  program.depth_compare = gpu::CompareOp::equal;
  return program;
}

gpu::GraphicsPipelineDesc pipeline_of(const DrawProgram& program, const ShadingInputs& inputs) {
  const gpu::Format colors[] = {gpu::Format::rgba16_float, kDiffuseLightFormat};
  const std::size_t targets = inputs.diffuse_light_wanted ? 2 : 1;
  return pipeline_desc(program, "lighting", std::span(colors).first(targets), gpu::Format::d32_float);
}

/// Binds what the program in use declares. `shadows`: null for shading without shadows and cookies.
void read_inputs(FrameBuilder& frame, DrawPass& pass, const ShadingInputs& inputs, const ShadowsOutputs* shadows) {
  pass.read_if_declared("environment", inputs.environment);
  pass.read_if_declared("indirect", inputs.indirect_constants);
  pass.read_if_declared("diffuse_probes", inputs.diffuse_probes);
  pass.read_if_declared("traced_indirect", inputs.traced_indirect);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, inputs.outputs);
  const auto* occlusion = frame.find<AmbientOcclusion>();
  pass.read_if_declared("hidden_image", occlusion != nullptr ? occlusion->hidden : ImageRef{});
  const auto* surroundings = frame.find<SurroundingsOutput>();
  pass.read_if_declared("far_image", surroundings != nullptr ? surroundings->light : ImageRef{});
  if (shadows == nullptr) return;
  read_shadows(pass, *shadows);
  if (shadows->final_lists) read_final_lists(pass, *shadows->final_lists);
}

LocalLights best_source(const ShadingInputs& inputs) {
  if (!inputs.outputs.has_lists()) return LocalLights::all;
  return inputs.outputs.lists_always_fit ? LocalLights::lists : LocalLights::lists_or_masks;
}

/// The best source whose pipeline is ready. If it is not the best source of all, the pipeline of that one is built in
/// the background. All sources draw the same picture.
std::optional<LocalLights> ready_source(const FrameServices& services, const ShadingInputs& inputs,
                                        const ShadowsOutputs* shadows) {
  const LocalLights best = best_source(inputs);
  const auto pipeline = [&](LocalLights source) {
    return pipeline_of(shading_program(source, inputs, shadows), inputs);
  };
  if (services.pipelines.request({pipeline(best)}, services.log)) return best;
  if (best == LocalLights::all) return std::nullopt;
  for (const LocalLights other : {LocalLights::lists_or_masks, LocalLights::all})
    if (services.pipelines.find(pipeline(other))) return other;
  return std::nullopt;
}

PipelineList final_list_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  PipelineList list = {pipeline_of(shading_program(LocalLights::final_lists, inputs, &shadows), inputs)};
  if (!shadows.final_lists->always_complete) list.push_back(pipeline_of(fallback_program(inputs, shadows), inputs));
  return list;
}

/// Of frames that keep light.
PipelineList reuse_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  PipelineList list = {pipeline_of(tile_program(inputs, shadows), inputs)};
  list_kept_light_pipelines(inputs, shadows, list);
  return list;
}

bool keeps_light(const FrameBuilder& frame) { return frame.knobs().value(kLightReuse) != LightReuseKind::off; }

bool final_lists_ready(const FrameBuilder& frame, const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  const FrameServices& services = frame.services();
  if (services.wait_for_pipelines) return true;
  const bool ready = services.pipelines.request(final_list_pipelines(inputs, shadows), services.log);
  // A later frame may need the fallback although this one does not.
  static_cast<void>(services.pipelines.request({pipeline_of(fallback_program(inputs, shadows), inputs)}, services.log));
  if (keeps_light(frame)) static_cast<void>(services.pipelines.request(reuse_pipelines(inputs, shadows), services.log));
  return ready;
}

struct Variant {
  LocalLights source = LocalLights::all;
  const ShadowsOutputs* shadows = nullptr;  ///< null: without shadows; never null with LocalLights::final_lists
};

/// While no pipeline with shadows is ready, frames are drawn without shadows. While none is ready at all, they are
/// drawn by brute force, whose pipeline is waited for.
Variant choose_variant(FrameBuilder& frame, const ShadingInputs& inputs) {
  const FrameServices& services = frame.services();
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  if (shadows != nullptr && shadows->final_lists && final_lists_ready(frame, inputs, *shadows))
    return {LocalLights::final_lists, shadows};
  const LocalLights best = best_source(inputs);
  if (services.wait_for_pipelines) return {best, shadows};
  if (shadows != nullptr)
    if (const auto source = ready_source(services, inputs, shadows)) return {*source, shadows};
  if (best == LocalLights::all) return {best};
  return {ready_source(services, inputs, nullptr).value_or(LocalLights::all)};
}

/// The second target of the pass, on the board.
void add_diffuse_light_target(FrameBuilder& frame, DrawPass& pass) {
  const ImageRef image = create_view_image(frame, "diffuse_light", kDiffuseLightFormat);
  frame.put(DiffuseLightOutput{pass.target(image)});
}

void draw_fallback_tiles(FrameBuilder& frame, DrawPass& pass, const ShadingInputs& inputs,
                         const ShadowsOutputs& shadows) {
  const FinalLists& lists = *shadows.final_lists;
  pass.use(fallback_program(inputs, shadows));
  read_inputs(frame, pass, inputs, &shadows);
  pass.read("fallback_tiles", lists.fallback_tiles);
  pass.draw_indirect(lists.commands, lists.fallback_draw);
}

std::optional<KeptLight> kept_light(FrameBuilder& frame, const ShadingInputs& inputs, const Variant& variant,
                                    LightReuse& reuse) {
  if (variant.source != LocalLights::final_lists || !keeps_light(frame)) return std::nullopt;
  auto kept = plan_kept_light(frame, inputs, *variant.shadows,
                              shading_program(variant.source, inputs, variant.shadows).constants,
                              reuse_pipelines(inputs, *variant.shadows), reuse);
  if (kept) add_lit_tiles_pass(frame, inputs, *variant.shadows, *kept);
  if (!frame.status().ok()) return std::nullopt;
  return kept;
}

/// Lights the tiles that have changed, or all pixels if most have.
void draw_changed_tiles(FrameBuilder& frame, DrawPass& pass, const ShadingInputs& inputs, const ShadowsOutputs& shadows,
                        const KeptLight& kept) {
  pass.use(tile_program(inputs, shadows));
  read_inputs(frame, pass, inputs, &shadows);
  pass.read("changed_tiles", kept.tiles);
  pass.draw_indirect(kept.commands, offsetof(shaders::LitTileCommands, tiles));
  pass.use(shading_program(LocalLights::final_lists, inputs, &shadows));
  read_inputs(frame, pass, inputs, &shadows);
  pass.draw_indirect(kept.commands, offsetof(shaders::LitTileCommands, whole));
}

}  // namespace

void list_deferred_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows, PipelineList& list) {
  const PipelineList needed =
      shadows.final_lists ? final_list_pipelines(inputs, shadows)
                          : PipelineList{pipeline_of(shading_program(best_source(inputs), inputs, &shadows), inputs)};
  list.insert(list.end(), needed.begin(), needed.end());
}

void add_deferred_pass(FrameBuilder& frame, LightReuse& reuse) {
  const ShadingInputs& inputs = shading_inputs(frame);
  const Variant variant = choose_variant(frame, inputs);
  std::optional<KeptLight> kept = kept_light(frame, inputs, variant, reuse);
  LitOutput& lit = frame.get<LitOutput>();
  DrawPass pass(frame, "deferred", shading_program(variant.source, inputs, variant.shadows));
  ImageRef& color = kept ? kept->light : lit.color;
  color = pass.target(color, kept ? gpu::LoadOp::load : gpu::LoadOp::discard);
  if (inputs.diffuse_light_wanted) add_diffuse_light_target(frame, pass);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  if (kept) {
    draw_changed_tiles(frame, pass, inputs, *variant.shadows, *kept);
  } else {
    read_inputs(frame, pass, inputs, variant.shadows);
    pass.draw_triangle();
  }
  if (variant.source == LocalLights::final_lists && !variant.shadows->final_lists->always_complete)
    draw_fallback_tiles(frame, pass, inputs, *variant.shadows);
  pass.use(sky_program(inputs));
  pass.read_if_declared("environment", inputs.sky);
  pass.draw_triangle();
  if (kept) lit.color = add_kept_light_copy(frame, *kept, lit.color);
}

}  // namespace gloam
