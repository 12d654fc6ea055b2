// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/render/view.h"
#include "engine/scene/components.h"
#include "engine/schedule/schedule.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/tiles.h"

namespace gloam {

using IbrProxies = View<const IbrProxy, const WorldTransform>;
using IbrRooms = View<const IbrRoom, const WorldTransform, Maybe<const ReflectingHeights>>;

/// Gathers all proxies and rooms of the world.
void ibr_proxies_system(IbrProxies proxies, IbrRooms rooms, Resource<ProxySet> set);

/// Builds the proxy tiles of the view. Does nothing when proxies, rooms, camera and settings are unchanged.
void proxy_tiles_system(Resource<const ProxySet> set, ViewResource<const RenderView> view,
                        ViewResource<const ProxyTileSettings> settings, ViewResource<ProxyTiles> tiles,
                        JobExecutor& jobs);

/// Adds the two systems above: ibr_proxies, proxy_tiles.
void add_proxy_systems(Schedule& schedule);

/// Adds the view resources that the systems need, where they are missing.
void prepare_proxy_view(World& world, ViewId view);

}  // namespace gloam
