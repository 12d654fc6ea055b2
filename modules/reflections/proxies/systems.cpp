// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/systems.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gloam {
namespace {

bool same_view(const ViewProjection& a, const ViewProjection& b) {
  return a.width == b.width && a.height == b.height && a.position == b.position && a.near_m == b.near_m &&
         a.view_from_relative == b.view_from_relative && a.clip_from_view == b.clip_from_view;
}

bool by_entity(const auto& a, const auto& b) { return a.entity.index < b.entity.index; }

}  // namespace

void ibr_proxies_system(IbrProxies proxies, IbrRooms rooms, Resource<ProxySet> set) {
  ProxySet found;
  found.unit = set->unit;
  proxies.each([&](Entity entity, const IbrProxy& proxy, const WorldTransform& transform) {
    PlacedProxy placed;
    switch (place_proxy(entity, proxy, transform.matrix, placed)) {
      case ProxyPlacement::placed:
        found.proxies.push_back(placed);
        break;
      case ProxyPlacement::not_finite:
        ++found.not_finite;
        break;
      case ProxyPlacement::no_area:
        ++found.no_area;
        break;
    }
  });
  rooms.each(
      [&](Entity entity, const IbrRoom& room, const WorldTransform& transform, const ReflectingHeights* heights) {
        PlacedRoom placed;
        if (place_room(entity, room, heights, transform.matrix, placed))
          found.rooms.push_back(std::move(placed));
        else
          ++found.unusable_rooms;
      });
  std::ranges::sort(found.proxies, [](const auto& a, const auto& b) { return by_entity(a, b); });
  std::ranges::sort(found.rooms, [](const auto& a, const auto& b) { return by_entity(a, b); });
  const bool changed = set->version == 0 || found.proxies != set->proxies || found.rooms != set->rooms;
  found.version = set->version + (changed ? 1 : 0);
  *set = std::move(found);
}

void proxy_tiles_system(Resource<const ProxySet> set, ViewResource<const RenderView> view,
                        ViewResource<const ProxyTileSettings> settings, ViewResource<ProxyTiles> tiles,
                        JobExecutor& jobs) {
  if (tiles->version != 0 && tiles->set_version == set->version && tiles->settings == *settings &&
      same_view(tiles->view, *view))
    return;
  build_proxy_tiles(*set, *view, *settings, jobs, *tiles);
  tiles->set_version = set->version;
  tiles->view = *view;
  ++tiles->version;
}

void add_proxy_systems(Schedule& schedule) {
  schedule.add_system("ibr_proxies", "reflections", Stage::world, &ibr_proxies_system);
  schedule.add_system("proxy_tiles", "reflections", Stage::view, &proxy_tiles_system);
}

void prepare_proxy_view(World& world, ViewId view) {
  if (world.try_view_resource<ProxyTileSettings>(view) == nullptr) world.set_view_resource(view, ProxyTileSettings{});
  if (world.try_view_resource<ProxyTiles>(view) == nullptr) world.set_view_resource(view, ProxyTiles{});
}

}  // namespace gloam
