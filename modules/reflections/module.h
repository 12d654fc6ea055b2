// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/module.h"

namespace gloam {

[[nodiscard]] std::unique_ptr<Module> make_reflections_module();

/// For hosts that show lamps that change over many frames. A picture then depends on the frames before it.
inline constexpr ChoiceKnob<bool> kReflectionRecapture{
    .name = "reflections.recapture",
    .meaning =
        "whether outdated captures in view are drawn again when lights have changed: never (off), or the most wrong "
        "ones, a proxy or a face of a probe each frame (budget); play sets budget",
    .choices = {{"off", false}, {"budget", true}},
    .only_with = "reflections.mode=tiers|planar"};

/// Writes, for each ray, the distance in metres to the nearest surface; infinity where there is none. origins: world
/// positions. directions: unit length. All spans have the same length.
using SurfaceDistances =
    std::function<void(std::span<const dvec3> origins, std::span<const dvec3> directions, std::span<double> hits_m)>;

struct ProxyFitRequest {
  std::size_t count = 16;       ///< greatest number of proxies
  std::vector<Entity> cameras;  ///< with Camera and WorldTransform; orthographic ones are left out
  bool look_at_cameras = true;  ///< choose by the rays of `cameras` too, not of random eyes alone
  std::uint32_t eyes = 1024;    ///< eyes placed at random for the choice, and as many others for the judgement
};

/// A node that could be added to the scene: an IbrProxy of kind `scene`. In units of the scene.
struct ProposedProxy {
  dvec3 translation = dvec3(0.0);
  dquat rotation = dquat(1.0, 0.0, 0.0, 0.0);
  vec2 size_m = vec2(0.0f);
};

/// Reflected rays that hit a surface, and how many of them the first proxy on the ray catches: it lies within 0.25 m of
/// the surface (SceneUnits).
struct CaughtShares {
  std::string viewers;  ///< "camera court", "eyes"
  std::uint64_t rays = 0;
  std::uint64_t in_rooms = 0;  ///< rays to surfaces in the rooms of their eye: no proxy can catch the others
  std::uint64_t by_proposed = 0;
  std::uint64_t by_existing = 0;  ///< by the world's IbrProxies of kind `scene`
};

struct ProxyProposal {
  std::vector<ProposedProxy> proxies;  ///< the ones that catch the most rays first
  std::size_t existing = 0;            ///< the world's usable proxies of kind `scene`
  std::size_t candidates = 0;          ///< quads that were chosen from
  /// For each camera, and for random eyes. None of these rays took part in the choice.
  std::vector<CaughtShares> shares;
};

/// Fits proxies to the world's unmoving surfaces, in the pose of the last run of the scene systems. Of all fitted quads
/// those are chosen that catch the most reflected rays: rays from cameras and from random eyes, mirrored at the
/// reflective surfaces that face up. A world without such surfaces gets the largest quads. The world's rooms decide
/// which proxies an eye sees; its proxies are only measured. The same request gives the same proposal.
[[nodiscard]] ProxyProposal propose_proxies(const World& world, const ProxyFitRequest& request,
                                            const SurfaceDistances& trace, JobExecutor& jobs);

}  // namespace gloam
