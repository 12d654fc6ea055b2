// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reflection_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/scene/assets.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/bake/capture_view.h"
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
#include "modules/reflections/proxies/room_tiers.h"
#include "modules/reflections/proxies/rows.h"
#include "modules/reflections/recapture/recapture.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

constexpr float kThickness = 0.35f;  // of things that screen space sees from the front only, in scene_unit()s
// The lobe of a surface of roughness √α as two round Gaussians. GGX about the mirror direction has the density
// c² / (π (c² + r²)²) over the angle r of the reflected ray, c = 2α (that of the ray is twice that of the half vector).
// The sum of the squared differences of this density and of its marginal over one axis, each over the sum of squares,
// is least for these three numbers: differences of 4.6 and 3.3 % (root mean square), at most 5.0 and 2.0 % of the peak.
constexpr float kCoreWidth = 1.0852f;  // standard deviation, radians per α
constexpr float kTailWidth = 2.8844f;
constexpr float kTailShare = 0.5133f;          // of the energy; the core has the rest
constexpr std::uint32_t kReachShare = 3;       // the blur ends after the picture's height over this
constexpr std::uint32_t kReachShareOfAll = 8;  // the same with one roughness for all
constexpr float kLeastAcross = 0.1f;           // narrowest blur along rows, per pixel roughness
constexpr float kAcross = 0.5f;                // the same with one roughness for all

/// Side of a texel of the reflection images at view depth 1. Orthographic: as a share of the picture's height.
float texel_size(const RenderView& view, std::uint32_t scale) {
  const float high = view.camera.orthographic ? 1.0f : 2.0f / std::abs(view.clip_from_view[1][1]);
  return high * static_cast<float>(scale) / static_cast<float>(view.height);
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
  c.blur_radius = std::clamp(c.size.y / (knobs.pixel_roughness ? kReachShare : kReachShareOfAll), 2u,
                             std::uint32_t{GLOAM_MOST_BLUR_RADIUS});
  c.blur_scale =
      knobs.pixel_roughness ? kCoreWidth / texel_size(view, c.scale) : 0.5f * static_cast<float>(c.blur_radius);
  c.blur_tail = knobs.pixel_roughness ? kTailWidth / kCoreWidth : 0.0f;
  c.blur_tail_share = knobs.pixel_roughness ? kTailShare : 0.0f;
  c.blur_across = knobs.pixel_roughness ? kLeastAcross : kAcross;
  return c;
}

/// Where reflections are accumulated, the frames show the pixels of each block in turn, and texels stand for its
/// middle.
void choose_pixels(shaders::ReflectionConstants& c, const RenderView& view) {
  constexpr std::array<std::uint32_t, 4> kTurns = {0, 3, 1, 2};
  c.first_candidate = kTurns[(view.frame - view.cut_frame) % kTurns.size()];
  c.centered = 1;
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
  const auto probes = static_cast<std::uint32_t>(frame.get<SurroundingProbes>().rows.size());
  return {.constants = constants,
          .block = frame.upload_uniform(constants),
          .tiles = frame.upload_uniform(shaders::ProxyTileConstants{
              tiles.tiles, tiles.words_per_tile, static_cast<std::uint32_t>(plan.proxies.size()), probes})};
}

/// The probes of the view, for lighting.
SurroundingProbes surrounding_probes(FrameBuilder& frame, std::span<const CaptureFactor> factors,
                                     std::span<const vec4> cells) {
  const World& world = frame.world();
  const auto& captures = world.resource<ReflectionCaptures>();
  SurroundingProbes probes;
  // A bake has diffuse light of probes before their images.
  if (captures.probes.count > 0) probes.rows = probe_rows(world, frame.view(), captures, factors);
  probes.factors.assign(cells.begin(), cells.end());
  probes.scale = frame.view().light_scale / captures.light_scale;
  return probes;
}

/// The surfaces of the view that reflect. On the board from PassPhase::lists to shading.
struct FoundSurfaces {
  ReflectionUniforms uniforms;
  MirrorSurfaces surfaces;
};

/// Tiers 1 and 2, or the mirrored picture in their place.
void add_mirror_passes(FrameBuilder& frame, Staging& staging, const ReflectionPlan& plan,
                       const ReflectionUniforms& uniforms, const MirrorSurfaces& surfaces, CaptureFactors& factors) {
  const ReflectionKnobs& knobs = plan.knobs;
  const auto& captures = frame.world().resource<ReflectionCaptures>();
  ProxyInputs proxies{.rows = plan.proxies,
                      .masks = frame.world().view_resource<ProxyTiles>(frame.view().id).masks,
                      .factors = plan.factors,
                      .images = {}};
  if (knobs.proxies) {
    bool uploaded = false;
    proxies.images =
        upload_captures(frame, staging, "reflection_proxies", captures.proxies, captures.version, &uploaded);
    if (uploaded) factors.forget_proxy_recaptures();
    proxies.images = add_proxy_recapture(frame, factors, proxies.images);
  }
  ScreenSpaceHits hits;
  if (knobs.screen_space) hits = add_screen_space_pass(frame, knobs, uniforms, surfaces.tiles);
  MirroredLight light = plan.planar ? add_planar_pass(frame, knobs, uniforms, surfaces, *plan.planar)
                                    : add_proxy_pass(frame, knobs, uniforms, surfaces, hits, proxies);
  if (knobs.temporal) light = add_temporal_pass(frame, uniforms, surfaces.tiles, light, knobs, captures.version);
  if (knobs.blur) light = add_glossy_passes(frame, uniforms, surfaces.tiles, light, knobs.dilation);
  add_composite_pass(frame, uniforms, surfaces, hits, light, knobs.bends());
  frame.put(ReflectionHandles{uniforms, hits, light, surfaces.tiles.image});
}

/// The knobs of a view: captures show probes alone.
ReflectionKnobs knobs_of(const FrameBuilder& frame) {
  ReflectionKnobs knobs = reflection_knobs(frame.knobs());
  if (frame.view().purpose != ViewPurpose::capture || knobs.mode == ReflectionKnobs::Mode::off) return knobs;
  knobs.mode = ReflectionKnobs::Mode::tiers;
  knobs.screen_space = knobs.proxies = false;
  return knobs;
}

}  // namespace

void announce_reflections(FrameBuilder& frame, Staging& staging, CaptureFactors& factors, ProbeProgress& progress) {
  const World& world = frame.world();
  const RenderView& view = frame.view();
  const ReflectionKnobs knobs = in_room(knobs_of(frame), world, view.id);
  if (knobs.mode == ReflectionKnobs::Mode::off) return;
  const auto* change = world.try_resource<ReflectionOverride>();
  const Reflective seen = strongest_reflection(world.resource<SceneAssets>(), frame.draws());
  if (seen == Reflective::no) return;
  const auto& captures = world.resource<ReflectionCaptures>();
  ReflectionPlan plan;
  plan.knobs = knobs;
  plan.planar = drawn_planar_mirror(frame);
  plan.traced = traced_of(world, view);
  std::span<const CaptureFactor> of_proxies, of_probes;
  if (knobs.light_scale) {
    factors.update(world, captures);
    of_proxies = factors.proxies(), of_probes = factors.probes();
    plan.factors.assign(factors.cells().begin(), factors.cells().end());
  }
  std::vector<CaptureFactor> without_lamps;
  if (is_unlit_capture(view.id)) {
    plan.factors.assign(std::size_t{kProbeCells} * kProbeCells, vec4(0.0f));
    without_lamps.assign(captures.probe_entities.size(), CaptureFactor{.first = 0});
    of_probes = without_lamps;
  }
  SurroundingProbes probes = surrounding_probes(frame, of_probes, plan.factors);
  plan.no_specular = change != nullptr && *change == ReflectionOverride::no_specular;
  const bool reference = plan.no_specular || plan.traced != nullptr;
  plan.mirror = !reference && seen == Reflective::mirror && (knobs.mirror() || plan.planar);
  if (!plan.mirror && probes.rows.empty() && !reference) return;
  plan.constants = constants_of(view, knobs, static_cast<float>(scene_unit(frame.world())));
  if (knobs.temporal && plan.mirror && knobs.scale() > 1) choose_pixels(plan.constants, view);
  plan.constants.capture_scale = view.light_scale / captures.light_scale;
  if (knobs.proxies)
    plan.proxies = proxy_rows(world, view, world.resource<ProxySet>(), world.view_resource<ProxyTiles>(view.id),
                              captures, of_proxies, knobs.naive, plan.factors);
  if (plan.mirror && !plan.planar && knobs.screen_space && !frame.draws().blended.empty())
    frame.put(BlendedLayerWanted{});
  probes.surroundings_follow = !reference;
  if (!probes.rows.empty()) {
    bool uploaded = false;
    probes.images = upload_captures(frame, staging, "reflection_probes", captures.probes, captures.version, &uploaded);
    if (uploaded) factors.forget_probe_recaptures();
    probes.images = add_probe_recapture(frame, factors, progress, probes.images);
  }
  frame.put(std::move(probes));
  if (reference) frame.put(SpecularAmbientTaken{});
  frame.put(std::move(plan));
}

void add_reflection_list_passes(FrameBuilder& frame) {
  const ReflectionPlan* plan = frame.find<ReflectionPlan>();
  if (plan == nullptr || plan->no_specular || plan->traced != nullptr) return;
  const ReflectionUniforms uniforms = upload_uniforms(frame, *plan);
  frame.put(FoundSurfaces{uniforms, add_surface_passes(frame, uniforms, plan->mirror)});
}

void add_reflection_passes(FrameBuilder& frame, Staging& staging, CaptureFactors& factors) {
  const ReflectionPlan* plan = frame.find<ReflectionPlan>();
  if (plan == nullptr || plan->no_specular) return;
  if (plan->traced != nullptr)
    return add_traced_light_pass(frame, upload_traced(frame, staging, "reflection_traced", *plan->traced));
  auto& [uniforms, surfaces] = frame.get<FoundSurfaces>();
  add_surroundings_passes(frame, uniforms, surfaces, plan->mirror);
  if (plan->mirror) return add_mirror_passes(frame, staging, *plan, uniforms, surfaces, factors);
  frame.put(ReflectionHandles{.uniforms = uniforms, .hits = {}, .light = {}, .mirrors = {}});
}

void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, bool blended, std::size_t probes,
                               PipelineList& list) {
  const bool planar = knobs.mode == ReflectionKnobs::Mode::planar;
  if (knobs.mode == ReflectionKnobs::Mode::off) return;
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "reflections")); };
  const bool mirror = knobs.mirror() || planar;
  for (const bool mirrors : {false, true}) add(list_tiles_program(mirrors));
  // A lamp may change in any frame: both kinds are made ahead.
  for (const bool factors : {false, true}) {
    const gpu::SpecConstants constants = probe_constants(probes, factors);
    add(surface_program(mirror, constants));
    add(surroundings_program(mirror, constants));
    if (knobs.screen_space) add(screen_space_program(knobs, blended, constants));
  }
  if (knobs.recapture)
    for (const ComputeProgram& program : recapture_programs()) add(program);
  if (!mirror) return;
  if (planar) add(planar_program(knobs));
  for (const bool factors : {false, true})
    if (!planar) add(proxy_program(knobs, factors));
  if (knobs.temporal) add(temporal_program());
  if (knobs.blur)
    for (const bool columns : {false, true}) {
      if (knobs.dilation) add(dilate_program(columns, direct));
      add(blur_program(columns, direct));
    }
  const bool centered = knobs.temporal && knobs.scale() > 1;
  add(composite_program(knobs.screen_space, false, centered));
  if (knobs.bends()) add(composite_program(knobs.screen_space, true, centered));
}

}  // namespace gloam
