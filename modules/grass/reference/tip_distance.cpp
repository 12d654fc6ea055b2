// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/tip_distance.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/components.h"
#include "engine/scene/units.h"
#include "modules/grass/knobs.h"
#include "modules/grass/lod/visible_patches.h"
#include "modules/grass/reference/slave_pose.h"
#include "modules/grass/simulation/steps.h"
#include "modules/grass/simulation/wind.h"

namespace gloam {
namespace {

constexpr std::size_t kLastKnot = kGrassKnots - 1;

/// The slots of the compared blades, ascending.
std::vector<std::uint32_t> compared_blades(const GrassField& field, std::span<const std::uint32_t> patches,
                                           std::uint32_t most) {
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t patch : patches)
    for (std::uint32_t i = 0; i < field.patches[patch].blades; ++i)
      slots.push_back(patch * GLOAM_GRASS_PATCH_BLADES + i);
  if (slots.size() <= most) return slots;
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(slots[i * slots.size() / most]);
  return chosen;
}

SlaveStem stem_of(const GrassBlade& blade) {
  return {dvec3(blade.ground_normal), static_cast<double>(blade.yaw), static_cast<double>(blade.length_m)};
}

/// The blades of one field under the same conditions.
class TipComparison {
 public:
  TipComparison(const GrassField& field, const TipConditions& conditions) : field_(field), conditions_(conditions) {}

  [[nodiscard]] double distance(std::uint32_t slot, std::uint32_t iterations) const {
    const GrassBlade& blade = field_.blades[slot];
    const GrassPatch& patch = field_.patches[slot / GLOAM_GRASS_PATCH_BLADES];
    std::vector<shaders::GrassCollider> colliders;
    colliders_near(patch, conditions_.colliders, colliders);
    for (shaders::GrassCollider& collider : colliders) {
      collider.from_previous = collider.from;
      collider.to_previous = collider.to;
    }
    const BladeSteps fine = steps_of(patch, colliders, kTrueStepParts, kTrueIterations);
    const BladeSteps coarse = steps_of(patch, colliders, 1, iterations);
    return glm::length(tip(blade, coarse) - moved(blade, fine).at[kLastKnot]);
  }

 private:
  [[nodiscard]] BladeSteps steps_of(const GrassPatch& patch, std::span<const shaders::GrassCollider> colliders,
                                    std::uint32_t parts, std::uint32_t iterations) const {
    return {.wind = wind_at_step(conditions_.wind, conditions_.first_step, kGrassStep),
            .wind_at = wind_position(patch.origin - conditions_.wind_origin),
            .step_s = kGrassStep / parts,
            .frame_steps = conditions_.steps * parts,
            .iterations = iterations,
            .colliders = colliders};
  }
  [[nodiscard]] BladeState moved(const GrassBlade& blade, const BladeSteps& steps) const {
    const BladeModel model = blade_model(blade, field_.types);
    BladeState state = rest_state(model);
    advance_blade(model, steps, steps.frame_steps, state);
    return state;
  }
  /// As frames show it: of a master, its own; of a slave, that which its master's knots give it.
  [[nodiscard]] dvec3 tip(const GrassBlade& blade, const BladeSteps& steps) const {
    const GrassBlade& master = field_.blades[blade.master];
    const BladeState state = moved(master, steps);
    if (blade.master == blade.slot) return state.at[kLastKnot];
    const double speed = glm::length(state.at[kLastKnot] - state.before[kLastKnot]) / steps.step_s;
    const SlaveTurn turn = slave_turn(stem_of(master), stem_of(blade), blade.slot % GLOAM_GRASS_PATCH_BLADES,
                                      state.at[kLastKnot], blade_model(master, field_.types).rest[kLastKnot], speed);
    return slave_knot(turn, state.at[kLastKnot]);
  }

  const GrassField& field_;
  const TipConditions& conditions_;
};

}  // namespace

std::vector<double> tip_distances(const GrassField& field, std::span<const std::uint32_t> patches,
                                  const TipConditions& conditions, std::uint32_t iterations, JobExecutor& executor) {
  const std::vector<std::uint32_t> slots = compared_blades(field, patches, conditions.most_blades);
  std::vector<double> distances(slots.size());
  const TipComparison comparison(field, conditions);
  executor.parallel_for(slots.size(), 4, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) distances[i] = comparison.distance(slots[i], iterations);
  });
  return distances;
}

Result<std::optional<MovedDistance>> measure_tips(const ReferenceInput& input) {
  const World& world = input.world;
  const auto* visible = world.try_view_resource<VisiblePatches>(input.view.id);
  const GrassField& field = world.resource<GrassField>();
  std::vector<std::uint32_t> patches;
  if (visible != nullptr)
    for (const VisiblePatch& patch : visible->patches) patches.push_back(patch.patch);
  std::ranges::sort(patches);
  TipConditions conditions;
  conditions.most_blades = std::clamp(2 * input.samples, 64u, 512u);
  conditions.first_step = world.resource<StepClock>().first_step();
  conditions.colliders = world.resource<GrassColliders>().colliders;
  world.view<const Wind, const WorldTransform>().each([&](const Wind& wind, const WorldTransform& transform) {
    const dvec3 at(transform.matrix[3]);
    conditions.wind = &wind;
    conditions.wind_origin = is_finite(at) ? at * metres_per_unit(world) : dvec3(0.0);
  });
  std::vector<double> distances =
      tip_distances(field, patches, conditions, grass_knobs(input.knobs).iterations, input.executor);
  if (distances.empty()) return std::optional<MovedDistance>();
  std::ranges::sort(distances);
  double sum = 0.0;
  for (const double distance : distances) sum += distance;
  const auto count = static_cast<double>(distances.size());
  const auto at = static_cast<std::size_t>(std::ceil(0.99 * count)) - 1;
  return std::optional(MovedDistance{1e3 * sum / count, 1e3 * distances[at]});
}

std::vector<ReferenceInfo> tip_references() {
  std::vector<ReferenceInfo> references;
  for (const std::string_view knob : {kGrassSlaves.name, kGrassIterations.name})
    references.push_back({.knob = std::string(knob),
                          .kind = "double precision",
                          .name = "each blade by itself for a second, 64 iterations in steps an eighth as long",
                          .distance = &measure_tips,
                          .unit = "mm at the tip"});
  return references;
}

}  // namespace gloam
