// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

enum class IbrProxyKind : std::uint8_t { scene, fire };

/// Proxy: a rectangle in the node's local XY plane, facing +Z, that stands for a part of the scene in reflections.
struct IbrProxy {
  vec2 size_m = vec2(0.0f);
  IbrProxyKind kind = IbrProxyKind::scene;
  std::uint32_t texture = 0;  ///< image file in SceneStrings instead of a capture
  std::uint32_t lights = 0;   ///< comma-separated light names in SceneStrings; 0: the lights that reached it at capture
};

/// A proxy of kind fire that shows a flame without triangles (FlameSource) in place of a capture. Made by
/// add_flame_proxies.
struct FlameProxy {
  Entity flame = kNoEntity;
};

/// The tiers that a room pays for; probes are always among them.
enum class IbrRoomTiers : std::uint8_t { all, ibr_cube, ssr_cube, cube };

/// Room: a box around the node. Proxies whose centre lies in it belong to it.
struct IbrRoom {
  vec3 size_m = vec3(0.0f);
  IbrRoomTiers tiers = IbrRoomTiers::all;  ///< of views whose camera has this room as its smallest
};

/// Heights of the horizontal reflecting surfaces in an IBR room, optional. With it, the room's proxies are reflected at
/// these heights only; without it, at every height from the room's floor up.
struct ReflectingHeights {
  std::array<float, 4> heights_m{};  ///< world height (Y) of each surface; the first `count` are used
  std::uint32_t count = 0;  ///< 0: as without the component; more than 4 counts as 4. NaN and infinity are ignored
};

/// Probe: captured surroundings, inside a box or of the whole scene.
struct CubeProbe {
  vec3 size_m = vec3(0.0f);
  std::uint32_t resolution = 128;  ///< texels of a cube face's side
  bool global = false;
};

}  // namespace gloam
