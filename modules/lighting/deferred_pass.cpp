// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <optional>
#include <utility>

#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/shaders.h"

namespace gloam {

namespace {

/// Source of the local lights in the shader.
enum class LocalLights : std::uint8_t {
  all,             ///< every light of the view
  lists_or_masks,  ///< the tile's early list, or its group mask if the list did not fit
  lists,           ///< the tile's early list; needs LightsOutputs::lists_always_fit
  final_lists,     ///< the tile's final list, directional lights included; fallback tiles are drawn afterwards
};

/// First binding of shadows or cookies: GLOAM_SHADOWS_BINDING or GLOAM_COOKIES_BINDING in the shaders.
constexpr std::uint32_t kFirstShadowBinding = 13;
/// First of four bindings: GLOAM_FINAL_LISTS_BINDING in the shaders.
constexpr std::uint32_t kFirstFinalListBinding = 9;
constexpr std::uint32_t kFallbackTilesBinding = 19;

/// A full-screen triangle at depth 0, the depth of the sky: the depth test selects either the pixels with a surface or
/// the pixels with sky. Pixels that fail the test cost nothing. A condition in the shader would not save time on
/// software devices, which run both sides of it.
gpu::GraphicsPipelineDesc tested_pipeline(std::string name, gpu::ShaderCode fragment, gpu::CompareOp compare) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline(std::move(name), "lighting", fragment, gpu::Format::rgba16_float);
  desc.depth_format = gpu::Format::d32_float;
  desc.depth_compare = compare;
  return desc;
}

constexpr const char* kNames[] = {"deferred/brute", "deferred/tiled", "deferred/listed", "deferred/final"};

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

gpu::GraphicsPipelineDesc shading_pipeline(LocalLights source, std::uint32_t directional_lights,
                                           const ShadowsOutputs* shadows) {
  const bool tiled = source != LocalLights::all, final_lists = source == LocalLights::final_lists;
  const bool shadowed = shadows != nullptr && !shadows->cookies_only && !final_lists;
  std::vector<gpu::SpecConstant> constants = shadows == nullptr ? std::vector<gpu::SpecConstant>{} : shadows->constants;
  std::string variant = shadows == nullptr ? "" : "/" + shadows->variant;
  // Loops with shadows are not unrolled: one pipeline serves any number of directional lights.
  if (!shadowed) {
    constants.push_back({1, directional_lights});
    variant += "/" + std::to_string(directional_lights);
  }
  if (final_lists) {
    const FinalLists& lists = *shadows->final_lists;
    constants.insert(constants.end(), lists.constants.begin(), lists.constants.end());
    variant += "/" + lists.variant;
  } else if (tiled) {
    constants.push_back({2, source == LocalLights::lists ? 1u : 0u});
  }
  gpu::GraphicsPipelineDesc desc = tested_pipeline(kNames[static_cast<std::size_t>(source)] + variant,
                                                   shading_code(source, shadows), gpu::CompareOp::less);
  desc.constants = std::move(constants);
  return desc;
}

/// Draws fallback tiles as with shadows.mode = monolithic.
gpu::GraphicsPipelineDesc fallback_pipeline(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  const LocalLights source = inputs.outputs.has_lists() ? LocalLights::lists_or_masks : LocalLights::all;
  gpu::GraphicsPipelineDesc desc = shading_pipeline(source, inputs.directional_count, &shadows);
  desc.name = "deferred/fallback/" + desc.name;
  desc.vertex = shaders::lighting::deferred_fallback_vert;
  return desc;
}

gpu::GraphicsPipelineDesc sky_pipeline() {
  return tested_pipeline("deferred/sky", shaders::lighting::sky_frag, gpu::CompareOp::equal);
}

/// Inputs for recording the pass.
struct Deferred {
  ShadingInputs inputs;
  const ShadowsOutputs* shadows = nullptr;  ///< on the frame's board
  LocalLights source = LocalLights::all;
  GeometryOutputs geometry;
  ImageRef texels;
  ImageRef color;
  gpu::PipelineHandle surfaces;
  gpu::PipelineHandle fallback;  ///< none if every tile has a final list
  gpu::PipelineHandle sky;
  gpu::SamplerHandle sampler;
};

void declare_reads(PassBuilder& pass, const Deferred& d) {
  const GeometryOutputs& g = d.geometry;
  for (const ImageRef ref : {g.base_color, g.normals, g.material, g.emissive, g.depth})
    pass.read(ref, gpu::Access::fragment_read);
  pass.read(g.depth, gpu::Access::depth_test);
  const LightsOutputs& lights = d.inputs.outputs;
  if (lights.texels) pass.read(lights.texels, gpu::Access::fragment_read);
  if (d.shadows != nullptr) declare_arriving_reads(pass, *d.shadows, gpu::Access::fragment_read);
  if (d.source == LocalLights::final_lists && d.shadows != nullptr) {
    const FinalLists& lists_of_tiles = *d.shadows->final_lists;
    declare_final_list_reads(pass, lists_of_tiles, gpu::Access::fragment_read);
    pass.read(lists_of_tiles.fallback_tiles, gpu::Access::vertex_read);
    pass.read(lists_of_tiles.commands, gpu::Access::indirect_read);
  }
  if (d.source == LocalLights::all || !lights.has_lists()) return;
  pass.read(lights.tile_lists, gpu::Access::fragment_read);
  pass.read(lights.early_lists, gpu::Access::fragment_read);
  pass.read(lights.group_masks, gpu::Access::fragment_read);
}

std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context, const Deferred& d,
                                      LocalLights source) {
  const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, d.sampler}; };
  const GeometryOutputs& g = d.geometry;
  std::vector<gpu::Binding> bindings = {frame.view_binding(),       {1, d.inputs.lights},    {2, d.inputs.environment},
                                        {3, sampled(g.base_color)}, {4, sampled(g.normals)}, {5, sampled(g.material)},
                                        {6, sampled(g.emissive)},   {7, sampled(g.depth)},   {8, sampled(d.texels)}};
  if (source == LocalLights::final_lists) {
    append_final_list_bindings(bindings, kFirstFinalListBinding, context, *d.shadows->final_lists, d.shadows->nearest);
    if (has_cookies(*d.shadows)) append_cookie_bindings(bindings, kFirstShadowBinding, context, *d.shadows);
    return bindings;
  }
  if (source != LocalLights::all) {
    const LightsOutputs& lights = d.inputs.outputs;
    bindings.push_back({9, lights.grid});
    bindings.push_back({10, sampled(lights.tile_lists)});
    bindings.push_back({11, gpu::Binding::BufferRange{context.buffer(lights.early_lists)}});
    bindings.push_back({12, gpu::Binding::BufferRange{context.buffer(lights.group_masks)}});
  }
  if (d.shadows != nullptr) append_arriving_bindings(bindings, kFirstShadowBinding, context, *d.shadows);
  return bindings;
}

void record_fallback(FrameBuilder& frame, PassContext& context, const Deferred& d) {
  const FinalLists& lists = *d.shadows->final_lists;
  const LocalLights source = d.inputs.outputs.has_lists() ? LocalLights::lists_or_masks : LocalLights::all;
  std::vector<gpu::Binding> bindings = bindings_of(frame, context, d, source);
  bindings.push_back({kFallbackTilesBinding, gpu::Binding::BufferRange{context.buffer(lists.fallback_tiles)}});
  gpu::CommandList& commands = context.commands();
  commands.bind_pipeline(d.fallback);
  commands.bind(bindings);
  commands.draw_indirect(context.buffer(lists.commands), lists.fallback_draw);
}

void record(FrameBuilder& frame, PassContext& context, const Deferred& d) {
  gpu::RenderingDesc rendering;
  rendering.colors.push_back({.view = {.image = context.image(d.color)}, .load = gpu::LoadOp::discard});
  rendering.depth = {.view = {.image = context.image(d.geometry.depth)}, .load = gpu::LoadOp::load, .read_only = true};
  gpu::CommandList& commands = context.commands();
  begin_view_rendering(commands, frame.view(), std::move(rendering));
  commands.bind_pipeline(d.surfaces);
  commands.bind(bindings_of(frame, context, d, d.source));
  commands.draw(3, 1, 0, 0);
  if (d.fallback) record_fallback(frame, context, d);
  commands.bind_pipeline(d.sky);
  const gpu::Binding sky[] = {frame.view_binding(), {2, d.inputs.environment}};
  commands.bind(sky);
  commands.draw(3, 1, 0, 0);
  commands.end_rendering();
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
  const auto pipeline = [&](LocalLights source) { return shading_pipeline(source, inputs.directional_count, shadows); };
  if (services.pipelines.request({pipeline(best)}, services.log)) return best;
  if (best == LocalLights::all) return std::nullopt;
  for (const LocalLights other : {LocalLights::lists_or_masks, LocalLights::all})
    if (services.pipelines.find(pipeline(other).name)) return other;
  return std::nullopt;
}

bool final_lists_ready(const FrameServices& services, const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  if (services.wait_for_pipelines) return true;
  PipelineList wanted = {shading_pipeline(LocalLights::final_lists, inputs.directional_count, &shadows)};
  if (!shadows.final_lists->always_complete) wanted.push_back(fallback_pipeline(inputs, shadows));
  return services.pipelines.request(wanted, services.log);
}

/// Sets `shadows` and returns the source. While no pipeline with shadows is ready, frames are drawn without shadows.
/// While none is ready at all, they are drawn by brute force, whose pipeline is waited for.
LocalLights choose_variant(FrameBuilder& frame, Deferred& d) {
  const FrameServices& services = frame.services();
  d.shadows = frame.find<ShadowsOutputs>();
  if (d.shadows != nullptr && d.shadows->final_lists && final_lists_ready(services, d.inputs, *d.shadows))
    return LocalLights::final_lists;
  const LocalLights best = best_source(d.inputs);
  if (services.wait_for_pipelines) return best;
  if (d.shadows != nullptr)
    if (const auto source = ready_source(services, d.inputs, d.shadows)) return *source;
  d.shadows = nullptr;
  if (best == LocalLights::all) return best;
  return ready_source(services, d.inputs, nullptr).value_or(LocalLights::all);
}

}  // namespace

Status add_deferred_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  Deferred d;
  d.inputs = *inputs;
  d.source = choose_variant(frame, d);
  auto surfaces = services.pipelines.get(shading_pipeline(d.source, inputs->directional_count, d.shadows));
  if (!surfaces.ok()) return surfaces.error();
  d.surfaces = *surfaces;
  if (d.source == LocalLights::final_lists && !d.shadows->final_lists->always_complete) {
    auto fallback = services.pipelines.get(fallback_pipeline(*inputs, *d.shadows));
    if (!fallback.ok()) return fallback.error();
    d.fallback = *fallback;
  }
  auto sky = services.pipelines.get(sky_pipeline());
  if (!sky.ok()) return sky.error();
  d.sky = *sky;
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  d.sampler = *sampler;

  d.geometry = frame.get<GeometryOutputs>();
  // Without local lights the shader does not read this image, but every binding must be set.
  d.texels = inputs->outputs.texels ? inputs->outputs.texels : d.geometry.base_color;
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("deferred", "lighting");
  declare_reads(pass, d);
  d.color = lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, d](PassContext& context) { record(frame, context, d); });
  return {};
}

}  // namespace gloam
