// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr std::uint32_t kStreetProxies = 50;

/// Adds `proxies` facades as IbrProxies on both sides of a street along −Z, and one wall at its end. Half of them face
/// away from the street: they are the backs of the houses. The street is as long as they need and is divided into
/// `rooms` blocks of equal length, a room each. proxies: even, ≥ 4.
void add_proxy_street(World& world, SceneInfo& info, std::uint32_t proxies, std::uint32_t rooms);

/// A street of kStreetProxies proxies (add_proxy_street) with captured images of one colour each, over a wet floor that
/// fills the picture. No other mesh, no light but the sky. With one room 25 proxies face the camera. With more, the
/// camera is in the first one.
[[nodiscard]] Result<std::unique_ptr<Session>> open_proxy_street(BenchContext& context, std::uint32_t rooms);

}  // namespace gloam
