// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reflection_passes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "engine/scene/assets.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/passes/composite.h"
#include "modules/reflections/passes/glossy_blur.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "modules/reflections/passes/planar_mirror.h"
#include "modules/reflections/passes/proxy_blending.h"
#include "modules/reflections/passes/screen_space_rays.h"
#include "modules/reflections/passes/temporal_accumulation.h"
#include "modules/reflections/probes/rows.h"
#include "modules/reflections/proxies/rows.h"

namespace gloam {
namespace {

constexpr float kThickness_m = 0.35f;  // of things that screen space sees from the front only
constexpr float kLobeWidth = 3.0f;     // radians: standard deviation of a lobe per square of the roughness
constexpr float kLeastAcross = 0.1f;   // narrowest blur along rows, per pixel roughness
constexpr float kAcross = 0.5f;        // the same with one roughness for all

/// Side of a texel of the reflection images at view depth 1 m (orthographic: everywhere), metres.
float texel_size(const RenderView& view, std::uint32_t scale) {
  return 2.0f / (std::abs(view.clip_from_view[1][1]) * static_cast<float>(view.height)) * static_cast<float>(scale);
}

shaders::ReflectionConstants constants_of(const RenderView& view, const ReflectionKnobs& knobs) {
  shaders::ReflectionConstants c{};
  c.scale = knobs.scale();
  c.size = (uvec2(view.width, view.height) + c.scale - 1u) / c.scale;
  c.k1 = knobs.k1;
  c.k2 = knobs.k2;
  c.refine = knobs.refine;
  c.reach_m = knobs.reach_m;
  c.thickness_m = kThickness_m;
  c.pixel_roughness = knobs.pixel_roughness ? 1 : 0;
  c.blur_radius = std::clamp(c.size.y / 8, 2u, std::uint32_t{GLOAM_MOST_BLUR_RADIUS});
  c.blur_scale =
      knobs.pixel_roughness ? kLobeWidth / texel_size(view, c.scale) : 0.5f * static_cast<float>(c.blur_radius);
  c.blur_across = knobs.pixel_roughness ? kLeastAcross : kAcross;
  c.light_scale = knobs.light_scale ? 1.0f : 0.0f;
  return c;
}

/// An image array of the world with these layers. Copied to the GPU when the captures have changed.
ImageRef captured_image(FrameBuilder& frame, Staging& staging, const char* name, const CapturedLayers& layers,
                        std::uint64_t version) {
  if (layers.count == 0) return {};
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "reflections";
  desc.format = gpu::Format::rgba16_float;
  desc.width = desc.height = layers.side;
  desc.layers = layers.count;
  desc.mips = layers.mips;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  desc.shape = gpu::ImageShape::array;
  const auto kept = frame.history_image(
      desc, {.scope = HistoryScope::world, .rest = gpu::Access::fragment_read, .reset = {.key = version}});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->image;
  const auto slice = staging.ring(frame.services().device).allocate(layers.texels.size() * sizeof(std::uint16_t));
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), layers.texels.data(), slice->bytes.size());
  PassBuilder pass = frame.graph().add_pass(std::string(name) + "_upload", frame.module());
  const ImageRef written = pass.write(kept->image, gpu::Access::transfer_write);
  pass.execute([written, source = *slice, &layers](PassContext& context) {
    for (std::uint32_t layer = 0; layer < layers.count; ++layer)
      for (std::uint32_t mip = 0; mip < layers.mips; ++mip) {
        const std::size_t halves = layer * layers.layer_halves() + layers.mip_offset(mip);
        context.commands().copy_buffer_to_image(source.buffer, source.offset + halves * sizeof(std::uint16_t),
                                                context.image(written), mip, layer, 1);
      }
  });
  return written;
}

/// The traced radiance of this view, if the world has it.
const TracedReflections* traced_of(const World& world, const RenderView& view) {
  const auto* traced = world.try_resource<TracedReflections>();
  const bool fits = traced != nullptr && traced->width == view.width && traced->height == view.height;
  return fits ? traced : nullptr;
}

ImageRef upload_traced(FrameBuilder& frame, Staging& staging, const TracedReflections& traced) {
  const auto slice = staging.ring(frame.services().device).allocate(traced.radiance.size() * sizeof(float));
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), traced.radiance.data(), slice->bytes.size());
  PassBuilder pass = frame.graph().add_pass("reflection_traced_upload", frame.module());
  const ImageRef written =
      pass.write(create_view_image(frame, "reflection_traced", gpu::Format::rgba32_float), gpu::Access::transfer_write);
  pass.execute([written, source = *slice](PassContext& context) {
    context.commands().copy_buffer_to_image(source.buffer, source.offset, context.image(written), 0, 0, 1);
  });
  return written;
}

void add_fog(const FrameBuilder& frame, shaders::ReflectionConstants& constants) {
  const HomogeneousFog* fog = frame.find<HomogeneousFog>();
  if (fog == nullptr) return;
  constants.fog_density = fog->density;
  constants.fog_radiance = vec4(fog->radiance, 0.0f);
  constants.fog_sky_m = fog->sky_distance_m;
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
  ReflectionFrame reflections;
  reflections.knobs = knobs;
  find_planar_mirror(frame, reflections);
  reflections.mirror = seen == Reflective::mirror && (knobs.mirror() || reflections.planar);
  reflections.probes = probe_rows(world, view, captures);
  reflections.no_specular = change != nullptr && *change == ReflectionOverride::no_specular;
  reflections.traced = traced_of(world, view);
  if (!reflections.mirror && reflections.probes.empty() && !reflections.no_specular && reflections.traced == nullptr)
    return;
  reflections.constants = constants_of(view, knobs);
  if (knobs.proxies)
    reflections.proxies = proxy_rows(world, view, world.resource<ProxySet>(), world.view_resource<ProxyTiles>(view.id),
                                     captures, knobs.naive);
  if (knobs.light_scale) reflections.changed = changed_lights(world, view, captures);
  reflections.constants.changed_lights = static_cast<std::uint32_t>(reflections.changed.size());
  if (!reflections.changed.empty()) frame.put(DiffuseLightWanted{});
  frame.put(SpecularAmbientTaken{});
  frame.put(std::move(reflections));
}

void add_reflection_passes(FrameBuilder& frame, Staging& staging) {
  ReflectionFrame* found = frame.find<ReflectionFrame>();
  if (found == nullptr || found->no_specular) return;
  ReflectionFrame& reflections = *found;
  const auto& captures = frame.world().resource<ReflectionCaptures>();
  add_fog(frame, reflections.constants);
  reflections.block = frame.upload_uniform(reflections.constants);
  const auto& tiles = frame.world().view_resource<ProxyTiles>(frame.view().id);
  reflections.tiles = frame.upload_uniform(shaders::ProxyTileConstants{
      tiles.tiles, tiles.words_per_tile, static_cast<std::uint32_t>(reflections.proxies.size()),
      static_cast<std::uint32_t>(reflections.probes.size())});
  if (reflections.traced != nullptr) {
    reflections.mirror = false;
    reflections.traced_image = upload_traced(frame, staging, *reflections.traced);
  }
  if (reflections.mirror) {
    if (reflections.knobs.proxies)
      reflections.proxy_images =
          captured_image(frame, staging, "reflection_proxies", captures.proxies, captures.version);
    add_mirror_surface_pass(frame, reflections);
    if (reflections.knobs.screen_space) add_screen_space_pass(frame, reflections);
    if (reflections.planar)
      add_planar_pass(frame, reflections);
    else
      add_proxy_pass(frame, reflections);
    if (reflections.knobs.temporal) add_temporal_pass(frame, reflections);
    if (reflections.knobs.blur) add_glossy_passes(frame, reflections);
    add_sharpen_pass(frame, reflections);
  }
  if (!reflections.probes.empty())
    reflections.probe_images = captured_image(frame, staging, "reflection_probes", captures.probes, captures.version);
  add_composite_pass(frame, reflections);
}

void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, std::size_t probes, PipelineList& list) {
  if (knobs.mode == ReflectionKnobs::Mode::off) return;
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "reflections")); };
  const bool planar = knobs.mode == ReflectionKnobs::Mode::planar, mirror = knobs.mirror() || planar;
  if (mirror) add(mirror_surface_program());
  if (knobs.screen_space) add(screen_space_program(knobs));
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
