// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/picture_moment.h"

#include <algorithm>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/depth_of_field/components.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

void add_light(const World& world, Entity entity, const Light& light, std::vector<double>& numbers) {
  for (const float number : {light.color.r, light.color.g, light.color.b, light.intensity, light.range_m, light.width_m,
                             light.apparent_angle, light.outer_angle})
    numbers.push_back(number);
  numbers.push_back(light.cookie);
  const auto* caster = world.try_get<ShadowCaster>(entity);
  numbers.push_back(caster == nullptr || caster->enabled ? 1.0 : 0.0);
  if (const auto* pose = world.try_get<LocalTransform>(entity))
    for (const double number : {pose->translation.x, pose->translation.y, pose->translation.z, pose->rotation.w,
                                pose->rotation.x, pose->rotation.y, pose->rotation.z})
      numbers.push_back(number);
}

}  // namespace

PictureMoment picture_moment(const Session& session, const ViewSettings& view, double time_s) {
  const World& world = session.world;
  ViewSettings seen = view;
  if (seen.follow_camera) follow_camera(world, seen);
  const auto& environment = world.resource<SceneEnvironment>();
  PictureMoment moment = {.numbers = {time_s, static_cast<double>(view.width), static_cast<double>(view.height),
                                      view.heat_range, seen.camera.fov_y, seen.camera.half_height_m,
                                      environment.has_exposure ? 1.0 : 0.0, environment.exposure_ev100},
                          .visualizer = view.visualizer};
  std::vector<double>& numbers = moment.numbers;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) numbers.push_back(seen.world_from_camera[column][row]);
  if (const auto* lens = world.try_get<DepthOfField>(session.camera)) {
    numbers.push_back(lens->focus_m);
    numbers.push_back(lens->f_number);
  }
  world.view<const Light>().each([&](Entity entity, const Light& light) { add_light(world, entity, light, numbers); });
  const std::vector<BudgetState> budgets = session.renderer->budgets();
  const KnobRegistry& knobs = session.renderer->knobs();
  for (const Knob& knob : knobs.knobs()) {
    const bool governed = std::ranges::any_of(budgets, [&](const BudgetState& budget) {
      return std::ranges::find(budget.governed, knob.name) != budget.governed.end();
    });
    if (!governed) numbers.push_back(knobs.number(knob));
  }
  return moment;
}

bool scene_moves(const Session& session) {
  return !session.world.resource<SceneAssets>().clips.empty() || session.renderer->changes_at_rest(session.world);
}

}  // namespace gloam
