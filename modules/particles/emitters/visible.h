// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/view.h"
#include "engine/scene/resources.h"
#include "engine/schedule/parameters.h"
#include "modules/particles/emitters/births.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {

/// An emitter with live particles whose bounds a view may see.
struct VisibleEmitter {
  std::uint32_t emitter = 0;  ///< index in EmitterSet::emitters
  LiveParticles live;
  double near_m = 0.0;  ///< view depths between which its sprites lie: 0 < near_m < far_m
  double far_m = 0.0;
};

/// The emitters that a view draws, by index; a view resource written by system particle_view.
struct VisibleEmitters {
  std::int64_t step = 0;  ///< of the frame's time
  std::vector<VisibleEmitter> emitters;
  std::uint64_t particles = 0;  ///< of these emitters
  std::uint64_t alive = 0;      ///< of all emitters of the world
  std::size_t left_out = 0;     ///< emitters beyond kMostVisibleEmitters, the farthest
};

/// Rows and particles of more emitters might not fit into the buffers that every device can bind.
inline constexpr std::size_t kMostVisibleEmitters = 48000;

/// Drops no emitter that the view sees, unless there are too many.
[[nodiscard]] VisibleEmitters find_visible_emitters(std::span<const PlacedEmitter> emitters, const RenderView& view,
                                                    std::int64_t step);

void particle_view_system(Resource<const EmitterSet> set, Resource<const SceneClock> clock,
                          ViewResource<const RenderView> view, ViewResource<VisibleEmitters> visible);

}  // namespace gloam
