// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/lighting/components.h"
#include "modules/reflections/bake.h"
#include "modules/reflections/components.h"

namespace gloam {
namespace {

constexpr int kSides = 4;
constexpr double kQuarterTurn = 1.57079632679489661923;

/// Whether the node, or a child of it, is a fire proxy.
bool has_proxy(const World& world, Entity node) {
  bool found = false;
  world.view<const IbrProxy>().each([&](Entity entity, const IbrProxy& proxy) {
    const Parent* parent = world.try_get<Parent>(entity);
    found = found ||
            (proxy.kind == IbrProxyKind::fire && (entity == node || (parent != nullptr && parent->entity == node)));
  });
  return found;
}

}  // namespace

void add_flame_proxies(World& world) {
  const FlameSource* source = world.try_resource<FlameSource>();
  if (source == nullptr || !source->find) return;
  for (const Flame& flame : source->find(world)) {
    if (has_proxy(world, flame.entity)) continue;
    const Parent* above = world.try_get<Parent>(flame.entity);
    const Parent parent{flame.entity, above == nullptr ? 1 : above->depth + 1};
    for (int i = 0; i < kSides; ++i) {
      const double half_turn = 0.5 * kQuarterTurn * i;
      const LocalTransform place{.translation = dvec3(0.0, static_cast<double>(flame.middle_m), 0.0),
                                 .rotation = dquat(std::cos(half_turn), 0.0, std::sin(half_turn), 0.0)};
      world.create(IbrProxy{.size_m = flame.size_m, .kind = IbrProxyKind::fire}, FlameProxy{flame.entity}, parent,
                   place, WorldTransform{});
    }
  }
}

}  // namespace gloam
