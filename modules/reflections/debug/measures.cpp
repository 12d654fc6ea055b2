// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/measures.h"

#include <optional>
#include <utility>

#include "engine/ecs/view.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/knobs.h"

namespace gloam {
namespace {

/// The error is that of the picture.
std::optional<double> no_count(const FrameCounters&, const FrameCounters&) { return std::nullopt; }
std::string no_fault(const FrameCounters&) { return {}; }

}  // namespace

std::vector<MeasureInfo> proxy_measures() {
  std::vector<MeasureInfo> measures;
  for (const std::string_view knob :
       {kProxyTiles.name, kProxyTileBound.name, kProxySphereTest.name, kNaiveProxyLoop.name}) {
    MeasureInfo info;
    info.knob = knob;
    info.kind = "brute force";
    info.name = "every proxy at every pixel: " + assignment_of(kNaiveProxyLoop, true) + ", " +
                assignment_of(kProxySphereTest, false);
    info.picture = {override_of(kNaiveProxyLoop, true), override_of(kProxySphereTest, false)};
    info.error = &no_count;
    info.fault = &no_fault;
    measures.push_back(std::move(info));
  }
  return measures;
}

std::string idle_reflection_knob(const World& world, const RenderView& view, std::string_view knob) {
  if (!knob.starts_with("ibr.")) return {};
  if (world.view<const IbrProxy>().size() == 0 && world.view<const FlameProxy>().size() == 0)
    return "the scene has no reflection proxy";
  const ProxyTiles* tiles = world.try_view_resource<ProxyTiles>(view.id);
  const PlacedRoom* room = tiles == nullptr ? nullptr : smallest_room(world.resource<ProxySet>().rooms, tiles->rooms);
  if (room != nullptr && !room->proxies) return "gloam.ibr_room.tiers of the camera's room leaves proxies out";
  if (tiles != nullptr && tiles->proxies.empty()) return "no reflection proxy is in view";
  if (tiles != nullptr && knob == kProxyLayers.name && tiles->proxies.size() == 1) return "one proxy is in view";
  return {};
}

}  // namespace gloam
