// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reflection_passes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/assets.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/passes/composite.h"
#include "modules/reflections/passes/glossy_blur.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "modules/reflections/passes/planar_mirror.h"
#include "modules/reflections/passes/proxy_blending.h"
#include "modules/reflections/passes/screen_space_rays.h"
#include "modules/reflections/passes/temporal_accumulation.h"
#include "modules/reflections/passes/uploads.h"
#include "modules/reflections/probes/rows.h"
#include "modules/reflections/proxies/rows.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

constexpr float kThickness = 0.35f;   // of things that screen space sees from the front only, in scene_unit()s
constexpr float kLobeWidth = 3.0f;    // radians: standard deviation of a lobe per square of the roughness
constexpr float kLeastAcross = 0.1f;  // narrowest blur along rows, per pixel roughness
constexpr float kAcross = 0.5f;       // the same with one roughness for all

/// Side of a texel of the reflection images at view depth 1 m (orthographic: everywhere), metres.
float texel_size(const RenderView& view, std::uint32_t scale) {
  return 2.0f / (std::abs(view.clip_from_view[1][1]) * static_cast<float>(view.height)) * static_cast<float>(scale);
}

shaders::ReflectionConstants constants_of(const RenderView& view, const ReflectionKnobs& knobs, float unit_m) {
  shaders::ReflectionConstants c{};
  c.scale = knobs.scale();
  c.size = (uvec2(view.width, view.height) + c.scale - 1u) / c.scale;
  c.k1 = knobs.k1;
  c.unit_m = unit_m;
  c.k2 = knobs.k2 / unit_m;
  c.refine = knobs.refine;
  c.reach_m = knobs.reach_m * unit_m;
  c.thickness_m = kThickness * unit_m;
  c.pixel_roughness = knobs.pixel_roughness ? 1 : 0;
  c.blur_radius = std::clamp(c.size.y / 8, 2u, std::uint32_t{GLOAM_MOST_BLUR_RADIUS});
  c.blur_scale =
      knobs.pixel_roughness ? kLobeWidth / texel_size(view, c.scale) : 0.5f * static_cast<float>(c.blur_radius);
  c.blur_across = knobs.pixel_roughness ? kLeastAcross : kAcross;
  c.light_scale = knobs.light_scale ? 1.0f : 0.0f;
  return c;
}

/// The traced radiance of this view, if the world has it.
const TracedReflections* traced_of(const World& world, const RenderView& view) {
  const auto* traced = world.try_resource<TracedReflections>();
  const bool fits = traced != nullptr && traced->width == view.width && traced->height == view.height;
  return fits ? traced : nullptr;
}

ReflectionUniforms upload_uniforms(FrameBuilder& frame, const ReflectionPlan& plan) {
  shaders::ReflectionConstants constants = plan.constants;
  if (const HomogeneousFog* fog = frame.find<HomogeneousFog>()) {
    constants.fog_density = fog->density;
    constants.fog_radiance = vec4(fog->radiance * frame.view().light_scale, 0.0f);
    constants.fog_sky_m = fog->sky_distance_m;
  }
  const auto& tiles = frame.world().view_resource<ProxyTiles>(frame.view().id);
  return {.constants = constants,
          .block = frame.upload_uniform(constants),
          .tiles = frame.upload_uniform(shaders::ProxyTileConstants{tiles.tiles, tiles.words_per_tile,
                                                                    static_cast<std::uint32_t>(plan.proxies.size()),
                                                                    static_cast<std::uint32_t>(plan.probes.size())})};
}

/// Tiers 1 and 2, or the mirrored picture in their place.
struct MirrorReflections {
  MirrorTiles tiles;
  ScreenSpaceHits hits;
  MirroredLight light;
  ImageRef upscaled;  ///< add_sharpen_pass()
};

MirrorReflections add_mirror_passes(FrameBuilder& frame, Staging& staging, const ReflectionPlan& plan,
                                    const ReflectionUniforms& uniforms) {
  const ReflectionKnobs& knobs = plan.knobs;
  const auto& captures = frame.world().resource<ReflectionCaptures>();
  ProxyInputs proxies{.rows = plan.proxies,
                      .masks = frame.world().view_resource<ProxyTiles>(frame.view().id).masks,
                      .changed = plan.changed};
  if (knobs.proxies)
    proxies.images = upload_captures(frame, staging, "reflection_proxies", captures.proxies, captures.version);
  const MirrorSurfaces surfaces = add_mirror_surface_pass(frame, uniforms);
  ScreenSpaceHits hits;
  if (knobs.screen_space) hits = add_screen_space_pass(frame, knobs, uniforms, surfaces.tiles);
  MirroredLight light = plan.planar ? add_planar_pass(frame, knobs, uniforms, surfaces, *plan.planar)
                                    : add_proxy_pass(frame, knobs, uniforms, surfaces, hits, proxies);
  if (knobs.temporal) light = add_temporal_pass(frame, uniforms, surfaces.tiles, light);
  if (knobs.blur) light = add_glossy_passes(frame, uniforms, surfaces.tiles, light);
  const ImageRef upscaled = add_sharpen_pass(frame, uniforms, surfaces.tiles, hits, light);
  return {surfaces.tiles, hits, light, upscaled};
}

}  // namespace

void announce_reflections(FrameBuilder& frame) {
  const ReflectionKnobs knobs = reflection_knobs(frame.knobs());
  if (knobs.mode == ReflectionKnobs::Mode::off) return;
  const World& world = frame.world();
  const RenderView& view = frame.view();
  const auto* change = world.try_resource<ReflectionOverride>();
  const Reflective seen = strongest_reflection(world.resource<SceneAssets>(), frame.draws().solid);
  if (seen == Reflective::no) return;
  const auto& captures = world.resource<ReflectionCaptures>();
  ReflectionPlan plan;
  plan.knobs = knobs;
  plan.planar = drawn_planar_mirror(frame);
  plan.traced = traced_of(world, view);
  plan.mirror = plan.traced == nullptr && seen == Reflective::mirror && (knobs.mirror() || plan.planar);
  plan.probes = probe_rows(world, view, captures);
  plan.no_specular = change != nullptr && *change == ReflectionOverride::no_specular;
  if (!plan.mirror && plan.probes.empty() && !plan.no_specular && plan.traced == nullptr) return;
  plan.constants = constants_of(view, knobs, static_cast<float>(scene_unit(frame.world())));
  plan.constants.capture_scale = view.light_scale / captures.light_scale;
  if (knobs.proxies)
    plan.proxies = proxy_rows(world, view, world.resource<ProxySet>(), world.view_resource<ProxyTiles>(view.id),
                              captures, knobs.naive);
  if (knobs.light_scale) plan.changed = changed_lights(world, view, captures);
  plan.constants.changed_lights = static_cast<std::uint32_t>(plan.changed.size());
  if (!plan.changed.empty()) frame.put(DiffuseLightWanted{});
  if (plan.mirror && !plan.planar && knobs.screen_space && !frame.draws().blended.empty())
    frame.put(BlendedLayerWanted{});
  frame.put(SpecularAmbientTaken{});
  frame.put(std::move(plan));
}

void add_reflection_passes(FrameBuilder& frame, Staging& staging) {
  const ReflectionPlan* plan = frame.find<ReflectionPlan>();
  if (plan == nullptr || plan->no_specular) return;
  const auto& captures = frame.world().resource<ReflectionCaptures>();
  const ReflectionUniforms uniforms = upload_uniforms(frame, *plan);
  ImageRef traced;
  if (plan->traced != nullptr) traced = upload_traced(frame, staging, *plan->traced);
  MirrorReflections mirrors;
  if (plan->mirror) mirrors = add_mirror_passes(frame, staging, *plan, uniforms);
  ProbeInputs probes{.rows = plan->probes, .changed = plan->changed};
  if (!plan->probes.empty())
    probes.images = upload_captures(frame, staging, "reflection_probes", captures.probes, captures.version);
  add_composite_pass(frame, uniforms, {mirrors.tiles, mirrors.upscaled, probes, traced});
  frame.put(ReflectionHandles{uniforms, mirrors.hits, mirrors.light, probes.images});
}

void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, bool blended, std::size_t probes,
                               PipelineList& list) {
  if (knobs.mode == ReflectionKnobs::Mode::off) return;
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "reflections")); };
  const bool planar = knobs.mode == ReflectionKnobs::Mode::planar, mirror = knobs.mirror() || planar;
  if (mirror) add(mirror_surface_program());
  if (knobs.screen_space) add(screen_space_program(knobs, blended));
  if (knobs.mirror()) add(proxy_program(knobs));
  if (planar) add(planar_program(knobs));
  if (mirror) add(sharpen_program(knobs.screen_space && !planar));
  if (mirror && knobs.temporal) add(temporal_program());
  if (mirror && knobs.blur)
    for (const bool columns : {false, true}) {
      add(dilate_program(columns, direct));
      add(blur_program(columns, direct));
    }
  const gpu::Format formats[] = {gpu::Format::rgba16_float};
  for (const bool tiles : {false, true})
    list.push_back(pipeline_desc(composite_program(mirror && tiles, probes, tiles), "reflections", formats,
                                 gpu::Format::d32_float));
}

}  // namespace gloam
