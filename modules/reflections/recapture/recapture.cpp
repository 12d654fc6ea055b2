// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/recapture/recapture.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/frame/mip_chain_passes.h"
#include "engine/scene/components.h"
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

/// The layer of the most outdated proxy in view; −1: none is outdated.
std::int64_t most_outdated(const World& world, ViewId view, const CaptureFactors& factors) {
  const ProxySet* set = world.try_resource<ProxySet>();
  const ProxyTiles* tiles = world.try_view_resource<ProxyTiles>(view);
  const auto& captures = world.resource<ReflectionCaptures>();
  std::int64_t chosen = -1;
  float most = kMostCaptureError;
  if (set == nullptr || tiles == nullptr) return chosen;
  for (const std::uint32_t index : tiles->proxies) {
    if (index >= set->proxies.size()) continue;
    const Entity proxy = set->proxies[index].entity;
    const auto& entities = captures.proxy_entities;
    const auto found =
        std::lower_bound(entities.begin(), entities.end(), proxy, [](Entity a, Entity b) { return a.index < b.index; });
    if (found == entities.end() || *found != proxy) continue;
    const auto layer = static_cast<std::size_t>(found - entities.begin());
    if (layer >= factors.proxies().size() || !(factors.proxies()[layer].error > most)) continue;
    const IbrProxy* component = world.try_get<IbrProxy>(proxy);
    if (component == nullptr || component->texture != 0 || component->kind == IbrProxyKind::fire) continue;
    most = factors.proxies()[layer].error;
    chosen = static_cast<std::int64_t>(layer);
  }
  return chosen;
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
  ComputePass pass(frame, "reflection_recapture", recapture_program());
  pass.read("light_image", drawn.light);
  pass.read("depth_image", drawn.depth);
  pass.push(constants);
  const ImageRef image =
      pass.write("captured_image", frame.graph().create_image(desc), gpu::ImageRange{.first_mip = 0, .mip_count = 1});
  pass.dispatch_over(uvec2(layers.side));
  return add_mip_chain(frame.graph(), {.name = "reflection_recapture_mips",
                                       .module = "reflections",
                                       .image = image,
                                       .filter = MipFilter::blit,
                                       .pipeline = {},
                                       .sampler = {}});
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

void leave_recapture(World& world, ViewId main) {
  if (DueRecapture* found = world.try_view_resource<DueRecapture>(main)) found->due = false;
}

void add_recapture_view(World& world, const ViewSettings& main, const CaptureFactors* factors,
                        CompanionViews& companions) {
  leave_recapture(world, main.id);
  const auto& captures = world.resource<ReflectionCaptures>();
  if (factors == nullptr || factors->outdated() == 0 || captures.proxies.side == 0) return;
  const std::int64_t layer = most_outdated(world, main.id, *factors);
  if (layer < 0) return;
  const Entity entity = captures.proxy_entities[static_cast<std::size_t>(layer)];
  PlacedProxy placed;
  if (place_proxy(entity, world.get<IbrProxy>(entity), world.get<WorldTransform>(entity).matrix, placed) !=
      ProxyPlacement::placed)
    return;
  const std::uint32_t pixels = captures.proxies.side * GLOAM_RECAPTURE_PIXELS;
  DueRecapture& due = due_of(world, main.id);
  due.due = true;
  due.layer = static_cast<std::uint32_t>(layer);
  due.view = companions.add(proxy_view(placed, pixels, scene_unit(world)));
}

ComputeProgram recapture_program() { return {shaders::reflections::recapture_proxy_comp}; }

ImageRef add_recapture_passes(FrameBuilder& frame, CaptureFactors& factors, ImageRef images) {
  const World& world = frame.world();
  const DueRecapture* due = world.try_view_resource<DueRecapture>(frame.view().id);
  const auto& captures = world.resource<ReflectionCaptures>();
  if (due == nullptr || !due->due || !images || due->layer >= captures.proxy_entities.size()) return images;
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

}  // namespace gloam
