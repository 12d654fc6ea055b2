// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/systems.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "modules/closeups/pairs/frustum.h"
#include "modules/closeups/pairs/pairs.h"
#include "modules/closeups/umbra/light.h"
#include "modules/closeups/umbra/umbra_projection.h"

namespace gloam {
namespace {

WorldBox box_of(const CloseupSubjects::Subject& subject) { return {subject.low, subject.high}; }

std::optional<CloseupLight> placed(const PlacedLights& lights, Entity entity) {
  const auto* light = lights.try_get<Light>(entity);
  const auto* transform = lights.try_get<WorldTransform>(entity);
  return light == nullptr || transform == nullptr ? std::nullopt : closeup_light(*light, transform->matrix);
}

/// Pairs whose subject has a box and whose light is in the view, unordered.
std::vector<CloseupView> candidates(const View<const CloseupPair>& pairs, const CloseupSubjects& subjects,
                                    const VisibleLights& visible) {
  std::vector<CloseupView> found;
  if (pairs.empty()) return found;
  std::unordered_map<Entity, std::uint32_t> local;
  std::unordered_map<Entity, std::uint32_t> directional;
  for (const Entity light : local_lights(visible)) local.emplace(light, static_cast<std::uint32_t>(local.size()));
  for (const Entity light : directional_lights(visible))
    directional.emplace(light, static_cast<std::uint32_t>(directional.size()));
  pairs.each([&](Entity entity, const CloseupPair& pair) {
    const auto subject = std::ranges::lower_bound(subjects.subjects, pair.subject.index, {},
                                                  [](const CloseupSubjects::Subject& s) { return s.entity.index; });
    if (subject == subjects.subjects.end() || subject->entity != pair.subject || !subject->known()) return;
    const auto local_light = local.find(pair.light);
    const auto directional_light = directional.find(pair.light);
    if (local_light == local.end() && directional_light == directional.end()) return;
    CloseupView& to = found.emplace_back();
    to.pair = entity;
    to.subject = pair.subject;
    to.light = pair.light;
    to.subject_index = static_cast<std::uint32_t>(subject - subjects.subjects.begin());
    to.directional = local_light == local.end();
    to.light_index = to.directional ? directional_light->second : local_light->second;
    to.priority = subject->priority;
  });
  return found;
}

std::uint64_t tiles_across(std::uint32_t pixels) { return (pixels + kShadowTile - 1) / kShadowTile; }

/// Drawing order: higher priority first, then greater coverage, then by entities.
bool before(const CloseupView& a, const CloseupView& b) {
  if (a.priority != b.priority) return a.priority > b.priority;
  if (a.coverage != b.coverage) return a.coverage > b.coverage;
  const auto entities = [](const CloseupView& v) {
    return std::array<std::uint32_t, 4>{v.subject.index, v.light.index, v.pair.index, v.pair.generation};
  };
  return entities(a) < entities(b);
}

/// Computes the pair's face and emitter data; false if no face can hold the subject.
bool give_map(const CloseupSettings& settings, const CloseupSubjects::Subject& subject,
              const CloseupReceivers& receivers, const PlacedLights& lights, CloseupView& view) {
  const std::optional<CloseupLight> light = placed(lights, view.light);
  if (!light) return false;
  const std::optional<CloseupFrustum> frustum =
      closeup_frustum(*light, box_of(subject), receivers.box, closeup_size(settings, view.tiles));
  if (!frustum) return false;
  view.face = frustum->face;
  view.face.light = view.light;
  view.tan_inner = frustum->tan_inner;
  view.emitter_diameter_m = static_cast<float>(2.0 * light->emitter_radius_m);
  view.penumbra_m_per_m = static_cast<float>(2.0 * light->spread);
  view.light_position = view.directional ? dvec3(0.0) : light->position;
  return true;
}

}  // namespace

void umbra_projection_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                             ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                             Resource<const CloseupReceivers> receivers, View<const CloseupPair> pairs,
                             PlacedLights lights, ViewResource<CloseupViews> found, JobExecutor& jobs) {
  *found = CloseupViews{};
  if (!settings->enabled) return;
  found->pairs = candidates(pairs, *subjects, *visible);
  const auto all = static_cast<float>(tiles_across(view->width) * tiles_across(view->height));
  jobs.parallel_for(found->pairs.size(), 1, [&](JobRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      CloseupView& pair = found->pairs[p];
      const std::optional<CloseupLight> light = placed(lights, pair.light);
      if (!light) continue;
      pair.tiles = umbra_tiles(*light, box_of(subjects->subjects[pair.subject_index]), receivers->box, *view);
      pair.coverage = static_cast<float>(pair.tiles.tiles()) / all;
    }
  });
  std::erase_if(found->pairs, [](const CloseupView& pair) { return pair.tiles.empty(); });
}

void closeup_views_system(ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                          Resource<const CloseupReceivers> receivers, PlacedLights lights,
                          ViewResource<CloseupViews> found, JobExecutor& jobs) {
  std::vector<CloseupView>& pairs = found->pairs;
  found->in_view = static_cast<std::uint32_t>(pairs.size());
  std::ranges::sort(pairs, before);
  std::vector<std::uint8_t> has_map(pairs.size(), 0);
  jobs.parallel_for(pairs.size(), 1, [&](JobRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p)
      has_map[p] = give_map(*settings, subjects->subjects[pairs[p].subject_index], *receivers, lights, pairs[p]);
  });
  std::size_t kept = 0;
  for (std::size_t p = 0; p < pairs.size() && kept < settings->max_pairs; ++p)
    if (has_map[p] != 0) pairs[kept++] = pairs[p];
  pairs.resize(kept);
  found->skipped = found->in_view - static_cast<std::uint32_t>(kept);
}

void add_closeup_systems(Schedule& schedule) {
  schedule.add_system("closeup_subjects", "closeups", Stage::world, &closeup_subjects_system);
  schedule.add_system("closeup_receivers", "closeups", Stage::world, &closeup_receivers_system);
  schedule.add_system("closeup_pairs", "closeups", Stage::world, &closeup_pairs_system);
  schedule.add_system("umbra_projection", "closeups", Stage::view, &umbra_projection_system);
  schedule.add_system("closeup_views", "closeups", Stage::view, &closeup_views_system);
}

void register_closeup_resources(World& world) {
  world.ensure_resource<CloseupSubjects>();
  world.ensure_resource<CloseupReceivers>();
  world.ensure_resource<CloseupMeshes>();
  world.ensure_resource<CloseupLightNames>();
}

void leave_closeup_world(World& world) {
  std::vector<Entity> pairs;
  world.view<const CloseupPair>().each([&](Entity entity, const CloseupPair&) { pairs.push_back(entity); });
  for (const Entity pair : pairs) world.destroy(pair);
  world.each_view_resource<CloseupViews>([](CloseupViews& views) { views = {}; });
  if (world.resource<CloseupSubjects>().subjects.empty()) return;
  world.set_resource(CloseupSubjects{});
  world.set_resource(CloseupReceivers{});
  world.set_resource(CloseupMeshes{});
  world.set_resource(CloseupLightNames{});
}

void prepare_closeup_view(World& world, ViewId view) {
  if (world.try_view_resource<CloseupSettings>(view) == nullptr) world.set_view_resource(view, CloseupSettings{});
  if (world.try_view_resource<CloseupViews>(view) == nullptr) world.set_view_resource(view, CloseupViews{});
}

}  // namespace gloam
