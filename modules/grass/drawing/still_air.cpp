// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/still_air.h"

#include <algorithm>
#include <span>

#include "engine/core/hash.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/simulation/colliders.h"
#include "modules/grass/simulation/steps.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {
namespace {

/// Far blades step once in so many steps; one that was made in between has not moved yet.
constexpr std::uint32_t kLeastSteps = 2 * GLOAM_GRASS_MOST_STRIDE;

bool wind_blows(const World& world) {
  bool blows = false;
  world.view<const Wind>().each([&](const Wind& wind) { blows = blows || wind.velocity != vec3(0.0f); });
  return blows;
}

}  // namespace

std::uint64_t rest_inputs(FrameBuilder& frame, const VisiblePatches& visible) {
  const World& world = frame.world();
  if (wind_blows(world)) return 0;
  const RenderView& view = frame.view();
  // Neither the blades that cast nor their shadows depend on the jitter.
  const ViewCamera camera = view.steady_camera();
  const GrassField& field = world.resource<GrassField>();
  Hasher hasher;
  hasher.bytes_of(camera.position).bytes_of(camera.clip_from_relative);
  hasher.value(view.width).value(view.height).value(frame.knobs().version());
  hasher.value(field.version).value(field.moves).value(world.resource<StepClock>().restarts());
  for (const VisiblePatch& one : visible.patches) hasher.value(one.patch);
  for (const PlacedCollider& one : world.resource<GrassColliders>().colliders) {
    hasher.bytes_of(one.from).bytes_of(one.to).bytes_of(one.from_previous).bytes_of(one.to_previous);
    hasher.bytes_of(one.half_size).bytes_of(one.radius_m);
    for (const dvec3& axis : one.axes) hasher.bytes_of(axis);
  }
  return std::max<std::uint64_t>(hasher.digest(), 1);
}

RestNote rest_note(FrameBuilder& frame, const VisiblePatches& visible) {
  const StepClock& clock = frame.world().resource<StepClock>();
  return {rest_inputs(frame, visible), clock.moves() ? clock.frame_steps() : 0};
}

GrassRest counted_rest(const GrassRest& rest, const RestNote& note, std::uint32_t moved) {
  if (note.inputs == 0 || moved > 0) return {};
  const std::uint32_t before = rest.inputs == note.inputs ? rest.steps : 0;
  return {note.inputs, std::min(before + note.steps, kLeastSteps)};
}

bool casters_rest(const GrassRest* rest, std::uint64_t inputs) {
  return rest != nullptr && inputs != 0 && rest->inputs == inputs && rest->steps >= kLeastSteps;
}

}  // namespace gloam
