// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/recapture/recapture.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "engine/frame/mip_chain_passes.h"
#include "engine/scene/components.h"
#include "modules/lighting/components.h"
#include "modules/reflections/bake/cube.h"
#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/bake/proxy_capture.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/scene_unit.h"
#include "shaders/reflections/recapture/recapture_shared.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFaces = 6;

struct Outdated {
  DueRecapture::Kind kind = DueRecapture::Kind::none;
  std::size_t layer = 0;
  float error = kMostCaptureError;
};

/// Whether frames can capture the proxy again: it is no image file and no fire.
bool is_drawn(const World& world, Entity proxy) {
  const IbrProxy* component = world.try_get<IbrProxy>(proxy);
  return component != nullptr && component->texture == 0 && component->kind != IbrProxyKind::fire &&
         world.try_get<WorldTransform>(proxy) != nullptr;
}

/// Takes a proxy in view that is more outdated.
void look_at_proxies(const World& world, ViewId view, const CaptureFactors& factors, Outdated& chosen) {
  const ProxySet* set = world.try_resource<ProxySet>();
  const ProxyTiles* tiles = world.try_view_resource<ProxyTiles>(view);
  const std::vector<Entity>& entities = world.resource<ReflectionCaptures>().proxy_entities;
  if (set == nullptr || tiles == nullptr) return;
  for (const std::uint32_t index : tiles->proxies) {
    if (index >= set->proxies.size()) continue;
    const Entity proxy = set->proxies[index].entity;
    const auto found =
        std::lower_bound(entities.begin(), entities.end(), proxy, [](Entity a, Entity b) { return a.index < b.index; });
    if (found == entities.end() || *found != proxy) continue;
    const auto layer = static_cast<std::size_t>(found - entities.begin());
    if (layer >= factors.proxies().size() || !(factors.proxies()[layer].error > chosen.error)) continue;
    if (is_drawn(world, proxy)) chosen = {DueRecapture::Kind::proxy, layer, factors.proxies()[layer].error};
  }
}

void look_at_probes(const World& world, const CaptureFactors& factors, Outdated& chosen) {
  const std::vector<Entity>& entities = world.resource<ReflectionCaptures>().probe_entities;
  for (std::size_t layer = 0; layer < std::min(entities.size(), factors.probes().size()); ++layer) {
    const float error = factors.probes()[layer].error;
    if (!(error > chosen.error) || world.try_get<CubeProbe>(entities[layer]) == nullptr) continue;
    if (world.try_get<WorldTransform>(entities[layer]) != nullptr) chosen = {DueRecapture::Kind::probe, layer, error};
  }
}

DueRecapture& due_of(World& world, ViewId main) {
  if (DueRecapture* found = world.try_view_resource<DueRecapture>(main)) return *found;
  return world.set_view_resource(main, DueRecapture{});
}

const CompanionLight::Images* drawn_images(const FrameBuilder& frame, const DueRecapture& due) {
  const CompanionLight* companions = frame.shared().find<CompanionLight>();
  if (companions == nullptr) return nullptr;
  const auto found = companions->views.find(due.view.value);
  return found == companions->views.end() ? nullptr : &found->second;
}

MipChain blit_chain(std::string name, ImageRef image) {
  return {.name = std::move(name),
          .module = "reflections",
          .image = image,
          .filter = MipFilter::blit,
          .pipeline = {},
          .sampler = {}};
}

/// Images of a probe that is captured over several frames.
struct ProbeImages {
  ImageRef faces;       ///< six layers
  ImageRef map;         ///< the octahedral map
  bool filled = false;  ///< with what earlier frames have written
};

ProbeImages probe_images(FrameBuilder& frame, const ReflectionCaptures& captures) {
  gpu::ImageDesc faces;
  faces.name = "reflection_probe_faces";
  faces.module = "reflections";
  faces.format = gpu::Format::rgba16_float;
  faces.width = faces.height = captures.probes.side / 2;
  faces.mips = static_cast<std::uint32_t>(std::bit_width(faces.width));
  faces.layers = kFaces;
  faces.shape = gpu::ImageShape::array;
  faces.usage = gpu::ImageUsage::storage | gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_source |
                gpu::ImageUsage::transfer_target;
  gpu::ImageDesc map = faces;
  map.name = "reflection_probe_map";
  map.width = map.height = captures.probes.side;
  map.mips = captures.probes.mips;
  map.layers = 1;
  map.shape = gpu::ImageShape::plain;
  const HistoryUse use{
      .scope = HistoryScope::world, .final_access = gpu::Access::compute_read, .reset = {.key = captures.version}};
  const auto kept_faces = frame.history_image(faces, use), kept_map = frame.history_image(map, use);
  if (!frame.check(kept_faces) || !frame.check(kept_map)) return {};
  return {kept_faces->image, kept_map->image, kept_faces->filled()};
}

/// Writes mip 0 of a face.
ImageRef add_face(FrameBuilder& frame, const CompanionLight::Images& drawn, ImageRef faces, std::uint32_t face) {
  const auto& captures = frame.world().resource<ReflectionCaptures>();
  ComputePass pass(frame, "reflection_recapture_face", shaders::reflections::probe_face_comp);
  pass.read("light_image", drawn.light);
  pass.push(shaders::RecaptureConstants{captures.light_scale / frame.view().light_scale, 0});
  const ImageRef written = pass.write(
      "face_image", faces, gpu::ImageRange{.first_mip = 0, .mip_count = 1, .first_layer = face, .layer_count = 1});
  pass.dispatch_over(uvec2(captures.probes.side / 2));
  return written;
}

/// Writes a mip of the map from the faces.
ImageRef add_map_mip(FrameBuilder& frame, const CapturedLayers& layers, const ProbeImages& images, std::uint32_t mip) {
  std::vector<shaders::ProbeSample> samples;
  for (const LobeSample& sample : lobe_samples_of_mip(mip, layers.mips, layers.side / 2))
    samples.push_back({sample.direction, sample.weight, sample.lod});
  ComputePass pass(frame, "reflection_recapture_map", shaders::reflections::probe_map_comp);
  pass.read("face_images", images.faces, Sampling::linear);
  pass.items("lobe", std::span<const shaders::ProbeSample>(samples));
  pass.push(shaders::ProbeMapConstants{static_cast<std::uint32_t>(samples.size()), mip == 0 ? 1u : 0u});
  const ImageRef written = pass.write("map_image", images.map, gpu::ImageRange{.first_mip = mip, .mip_count = 1});
  pass.dispatch_over(uvec2(layers.side >> mip));
  return written;
}

/// The drawn capture with the proxy's size and all mips.
ImageRef add_downsampling(FrameBuilder& frame, const CapturedLayers& layers, const CompanionLight::Images& drawn,
                          const shaders::RecaptureConstants& constants) {
  gpu::ImageDesc desc;
  desc.name = "reflection_recapture";
  desc.module = "reflections";
  desc.format = gpu::Format::rgba16_float;
  desc.width = desc.height = layers.side;
  desc.mips = layers.mips;
  desc.usage = gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source | gpu::ImageUsage::transfer_target;
  ComputePass pass(frame, "reflection_recapture", shaders::reflections::recapture_proxy_comp);
  pass.read("light_image", drawn.light);
  pass.read("depth_image", drawn.depth);
  pass.push(constants);
  const ImageRef image =
      pass.write("captured_image", frame.graph().create_image(desc), gpu::ImageRange{.first_mip = 0, .mip_count = 1});
  pass.dispatch_over(uvec2(layers.side));
  return add_mip_chain(frame.graph(), blit_chain("reflection_recapture_mips", image));
}

ImageRef add_copy(FrameBuilder& frame, const CapturedLayers& layers, ImageRef from, ImageRef images,
                  std::uint32_t layer) {
  PassBuilder pass = frame.graph().add_pass("reflection_recapture_copy", frame.module());
  pass.read(from, gpu::Access::transfer_read);
  const ImageRef written = pass.write(images, gpu::Access::transfer_write);
  pass.execute([=, mips = layers.mips](PassContext& context) {
    for (std::uint32_t mip = 0; mip < mips; ++mip)
      context.commands().blit(context.image(from), context.image(written), {mip, 0}, {mip, layer});
  });
  return written;
}

}  // namespace

void add_recapture_view(World& world, const ViewSettings& main, const RecaptureState& state,
                        CompanionViews& companions) {
  if (DueRecapture* found = world.try_view_resource<DueRecapture>(main.id)) *found = {};
  const auto& captures = world.resource<ReflectionCaptures>();
  const ProbeProgress& progress = state.progress;
  const bool goes_on = progress.running && progress.layer < captures.probe_entities.size();
  if (state.factors == nullptr || (state.factors->outdated() == 0 && !goes_on)) return;
  Outdated chosen;
  if (goes_on) {
    chosen = {DueRecapture::Kind::probe, progress.layer, 1.0f};
  } else {
    if (state.proxies) look_at_proxies(world, main.id, *state.factors, chosen);
    look_at_probes(world, *state.factors, chosen);
  }
  if (chosen.kind == DueRecapture::Kind::none) return;
  DueRecapture due{chosen.kind, static_cast<std::uint32_t>(chosen.layer), goes_on ? progress.step : 0, {}};
  const double unit = scene_unit(world);
  if (due.kind == DueRecapture::Kind::proxy) {
    const Entity entity = captures.proxy_entities[due.layer];
    PlacedProxy placed;
    if (place_proxy(entity, world.get<IbrProxy>(entity), world.get<WorldTransform>(entity).matrix, placed) !=
        ProxyPlacement::placed)
      return;
    due.view = companions.add(proxy_view(placed, captures.proxies.side * GLOAM_RECAPTURE_PIXELS, unit));
  } else if (due.step < kFaces) {
    const WorldTransform* transform = world.try_get<WorldTransform>(captures.probe_entities[due.layer]);
    if (transform == nullptr) return;
    due.view = companions.add(face_view(due.step, dvec3(transform->matrix[3]), captures.probes.side / 2, unit));
  }
  if (due.view.value != 0) world.ensure_resource<CapturedExtras>().views.insert(due.view.value);
  due_of(world, main.id) = due;
}

std::vector<ComputeProgram> recapture_programs() {
  return {{shaders::reflections::recapture_proxy_comp},
          {shaders::reflections::probe_face_comp},
          {shaders::reflections::probe_map_comp}};
}

ImageRef add_proxy_recapture(FrameBuilder& frame, CaptureFactors& factors, ImageRef images) {
  const World& world = frame.world();
  const DueRecapture* due = world.try_view_resource<DueRecapture>(frame.view().id);
  const auto& captures = world.resource<ReflectionCaptures>();
  if (due == nullptr || due->kind != DueRecapture::Kind::proxy || !images ||
      due->layer >= captures.proxy_entities.size())
    return images;
  const CompanionLight::Images* drawn = drawn_images(frame, *due);
  if (drawn == nullptr) return images;
  const Entity entity = captures.proxy_entities[due->layer];
  const WorldTransform* transform = world.try_get<WorldTransform>(entity);
  if (transform == nullptr) return images;
  const bool upside_down = glm::determinant(glm::dmat3(transform->matrix)) < 0.0;
  const shaders::RecaptureConstants constants{captures.light_scale / frame.view().light_scale, upside_down ? 1u : 0u};
  const ImageRef made = add_downsampling(frame, captures.proxies, *drawn, constants);
  frame.on_commit([&factors, layer = due->layer] { factors.note_recapture(layer); });
  return add_copy(frame, captures.proxies, made, images, due->layer);
}

ImageRef add_probe_recapture(FrameBuilder& frame, CaptureFactors& factors, ProbeProgress& progress, ImageRef images) {
  const World& world = frame.world();
  const DueRecapture* due = world.try_view_resource<DueRecapture>(frame.view().id);
  const auto& captures = world.resource<ReflectionCaptures>();
  if (due == nullptr || due->kind != DueRecapture::Kind::probe || !images) return images;
  const auto stop = [&progress] { progress = {}; };
  const ProbeImages own = probe_images(frame, captures);
  const bool begun = due->step == 0 || own.filled;
  if (due->layer >= captures.probe_entities.size() || !begun || !own.faces || !own.map) {
    frame.on_commit(stop);
    return images;
  }
  frame.on_commit([&progress, next = ProbeProgress{true, due->layer, due->step + 1}] { progress = next; });
  if (due->step < kFaces) {
    const CompanionLight::Images* drawn = drawn_images(frame, *due);
    if (drawn == nullptr) {
      frame.on_commit(stop);
      return images;
    }
    const ImageRef faces = add_face(frame, *drawn, own.faces, due->step);
    if (due->step + 1 == kFaces)
      static_cast<void>(add_mip_chain(frame.graph(), blit_chain("reflection_probe_face_mips", faces)));
    return images;
  }
  const std::uint32_t mip = due->step - kFaces;
  const ImageRef map = add_map_mip(frame, captures.probes, own, mip);
  if (mip + 1 < captures.probes.mips) return images;
  const auto row = static_cast<std::size_t>(due->layer) + captures.proxy_entities.size();
  frame.on_commit([&factors, row] { factors.note_recapture(row); });
  frame.on_commit(stop);
  return add_copy(frame, captures.probes, map, images, due->layer);
}

}  // namespace gloam
