// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/world.h"
#include "engine/math/types.h"

namespace gloam {

/// A fire that is drawn without triangles, such as that of particles, in the frame of its node: it stands upright above
/// the node's origin.
struct Flame {
  Entity entity = kNoEntity;  ///< the node
  vec2 size_m = vec2(0.0f);   ///< width and height of a rectangle that holds it, seen from any side
  float middle_m = 0.0f;      ///< height of the rectangle's middle above the origin
};

/// The flames of a world, for modules that show them where they are not drawn. A world resource; the module that draws
/// flames replaces it in Module::register_components. Both functions may be empty: there are no flames.
struct FlameSource {
  /// All flames, by entity index. Reads components only, so that it can be called before systems have run.
  std::function<std::vector<Flame>(const World& world)> find;
  /// Mean light of the flame in its rectangle, seen from the side: side × side texels, rows from the top; rgb in cd/m²,
  /// premultiplied by alpha.
  std::function<std::vector<vec4>(const World& world, Entity flame, std::uint32_t side)> picture;
};

/// What captures of the static scene depend on beside meshes, lights and sky: a world resource. A module that draws
/// something static without meshes adds its function in Module::register_components, under its name.
struct CapturedExtras {
  /// By module: a hash of all that decides what the module draws into a capture. Reads components only.
  std::map<std::string, std::function<std::uint64_t(const World& world)>> content;
  /// Ids of views (ViewId) that show it although they are ViewSettings::static_only: those that draw captures.
  std::set<std::uint32_t> views;
};

}  // namespace gloam
