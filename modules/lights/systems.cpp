// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/systems.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "modules/lights/lists/uploads.h"
#include "modules/lights/outputs.h"

namespace gloam {
namespace {

constexpr std::size_t kBoundsGrain = 128;  // lights per job

std::uint64_t different_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b);
}

/// Compares bits, so that NaN equals itself. The padding after `kind` is ignored.
bool same_light(const Light& a, const Light& b) {
  constexpr std::size_t kFirst = offsetof(Light, color);
  using Words = std::array<std::uint32_t, (sizeof(Light) - kFirst) / sizeof(std::uint32_t)>;
  static_assert(sizeof(Words) + kFirst == sizeof(Light));
  Words x;
  Words y;
  std::memcpy(x.data(), reinterpret_cast<const std::byte*>(&a) + kFirst, sizeof(Words));
  std::memcpy(y.data(), reinterpret_cast<const std::byte*>(&b) + kFirst, sizeof(Words));
  std::uint32_t different = static_cast<std::uint32_t>(a.kind) ^ static_cast<std::uint32_t>(b.kind);
  for (std::size_t i = 0; i < x.size(); ++i) different |= x[i] ^ y[i];
  return different == 0;
}

bool same_bits(const dvec3& a, const dvec3& b) {
  return (different_bits(a.x, b.x) | different_bits(a.y, b.y) | different_bits(a.z, b.z)) == 0;
}

LightBounds bounds_of(const LightTable& table, std::size_t slot) {
  return {dvec3(table.x[slot], table.y[slot], table.z[slot]), std::max(table.radius[slot], 0.0f)};
}

/// Called when the set of entities changed: assigns slots in entity order and keeps the data of lights that remain.
void place_rows(std::span<const LightRows> chunks, std::size_t count, LightSet& set) {
  set.rows.clear();
  for (const LightRows& chunk : chunks) set.rows.insert(set.rows.end(), chunk.entities.begin(), chunk.entities.end());
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return set.rows[a].index < set.rows[b].index; });

  const std::vector<PlacedLight> old_lights = std::move(set.lights);
  const LightTable old_table = std::move(set.table);
  set.lights = std::vector<PlacedLight>(count);
  set.table = LightTable{};
  set.table.resize(count);
  set.slot_of_row.resize(count);
  std::size_t old = 0;
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const Entity entity = set.rows[order[slot]];
    set.slot_of_row[order[slot]] = slot;
    while (old < old_lights.size() && old_lights[old].entity.index < entity.index) ++old;
    if (old < old_lights.size() && old_lights[old].entity == entity) {
      set.lights[slot] = old_lights[old];
      set.table.copy(slot, old_table, old);
    } else {
      set.lights[slot].entity = kNoEntity;  // filled by update_light
    }
  }
}

bool same_rows(std::span<const LightRows> chunks, std::size_t count, const LightSet& set) {
  if (set.rows.size() != count) return false;
  return std::ranges::all_of(chunks, [&](const LightRows& chunk) {
    static_assert(std::has_unique_object_representations_v<Entity>);
    return chunk.entities.empty() ||
           std::memcmp(chunk.entities.data(), set.rows.data() + chunk.first, chunk.entities.size_bytes()) == 0;
  });
}

/// Updates one light. Returns whether anything changed.
bool update_light(Entity entity, const Light& light, const dmat4& world_from_node, std::size_t slot, LightSet& set) {
  PlacedLight& placed = set.lights[slot];
  const dvec3 node_z(world_from_node[2]);
  const dvec3 position(world_from_node[3]);
  const bool known = placed.entity == entity;
  const bool turned = !known || !same_bits(node_z, placed.node_z);
  const bool moved = turned || !same_bits(position, placed.position);
  const bool changed = !known || !same_light(light, placed.light);
  if (!moved && !changed) return false;
  placed.entity = entity;
  if (changed) {
    placed.light = light;
    set.table.set_light(slot, placed);
  }
  if (turned) {
    placed.node_z = node_z;
    placed.direction = light_direction(node_z);
  }
  placed.position = position;
  set.table.set_place(slot, placed);
  return true;
}

struct BoundsJob {
  std::span<const LightRows> chunks;
  const KeptLights& kept;
  LightSet& set;
  std::atomic<std::uint32_t>& updated;

  void run(JobRange range) const {
    std::uint32_t count = 0;
    for (const LightRows& chunk : chunks) {
      const std::size_t begin = std::max(range.begin, chunk.first);
      const std::size_t end = std::min(range.end, chunk.first + chunk.entities.size());
      if (begin < end) count += run(chunk, begin - chunk.first, end - chunk.first);
    }
    updated.fetch_add(count, std::memory_order_relaxed);
  }

 private:
  [[nodiscard]] std::uint32_t run(const LightRows& chunk, std::size_t begin, std::size_t end) const {
    std::uint32_t count = 0;
    bool changed = false;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t slot = set.slot_of_row[chunk.first + i];
      if (update_light(chunk.entities[i], chunk.lights[i], chunk.transforms[i].matrix, slot, set)) ++count;
      if (chunk.bounds.empty()) continue;
      LightBounds& bounds = chunk.bounds[i];
      const double x = set.table.x[slot];
      const double y = set.table.y[slot];
      const double z = set.table.z[slot];
      const float radius = std::max(set.table.radius[slot], 0.0f);
      const bool same = (different_bits(x, bounds.center.x) | different_bits(y, bounds.center.y) |
                         different_bits(z, bounds.center.z)) == 0;
      if (same && radius == bounds.radius_m) continue;
      bounds.center.x = x;
      bounds.center.y = y;
      bounds.center.z = z;
      bounds.radius_m = radius;
      changed = true;
    }
    if (changed) kept.mark_changed<LightBounds>(chunk.entities.subspan(begin, end - begin));
    return count;
  }
};

bool same_view(const ViewProjection& a, const ViewProjection& b) {
  return a.width == b.width && a.height == b.height && a.position == b.position && a.near_m == b.near_m &&
         a.view_from_relative == b.view_from_relative && a.clip_from_view == b.clip_from_view;
}

ZBinParams z_bin_params(const VisibleLights& visible, const ZBinSettings& settings, float near_m) {
  ZBinParams params{near_m, near_m, settings.count};
  for (const LightDepth& depth : visible.depths) params.far_m = std::max(params.far_m, depth.farthest);
  if (settings.farthest_opaque_m > 0.0f) params.far_m = std::min(params.far_m, settings.farthest_opaque_m);
  // Keeps far_m above near_m by a margin, so that the scale is finite.
  params.far_m = std::max(params.far_m, near_m + std::max(1e-30f, std::abs(near_m) * 1e-3f));
  return params;
}

bool same_params(const ZBinParams& a, const ZBinParams& b) {
  return a.near_m == b.near_m && a.far_m == b.far_m && a.count == b.count;
}

}  // namespace

float unseen_lux(const SceneEnvironment& environment) {
  // Lights add up, and highlights are brighter than a white surface: a quarter of half of the darkest step.
  constexpr double kShownAsNothing = 1.2e-4;  // 3.14 · 1.5e-4 / 4
  if (!environment.has_exposure) return kUnseenLux;
  const double exposure = std::exp2(-static_cast<double>(environment.exposure_ev100)) / 1.2;
  return static_cast<float>(std::clamp(kShownAsNothing / exposure, 1e-30, 1e30));
}

void light_reach_system(View<Light> lights, Resource<const SceneEnvironment> environment,
                        OptionalResource<const MeteredInEveryFrame> metered) {
  const float unseen = metered ? kUnseenLux : unseen_lux(*environment);
  lights.each([&](Entity entity, Light& light) {
    if (light.range_m > 0.0f || light.unseen_lux == unseen) return;
    light.unseen_lux = unseen;
    lights.mark_changed<Light>(entity);
  });
}

void light_bounds_system(KeptLights kept, FreshLights fresh, Resource<LightSet> set, JobExecutor& jobs,
                         Commands& commands) {
  std::vector<LightRows>& chunks = set->chunks;
  chunks.clear();
  std::size_t count = 0;
  kept.each_chunk([&](std::span<const Entity> entities, std::span<const Light> lights,
                      std::span<const WorldTransform> transforms, std::span<LightBounds> bounds) {
    chunks.push_back({entities, lights, transforms, bounds, count});
    count += entities.size();
  });
  fresh.each_chunk(
      [&](std::span<const Entity> entities, std::span<const Light> lights, std::span<const WorldTransform> transforms) {
        chunks.push_back({entities, lights, transforms, {}, count});
        count += entities.size();
      });
  const bool regrouped = !same_rows(chunks, count, *set);
  if (regrouped) place_rows(chunks, count, *set);
  std::atomic<std::uint32_t> updated = 0;
  const BoundsJob job{chunks, kept, *set, updated};
  jobs.parallel_for(count, kBoundsGrain, [&job](JobRange range) { job.run(range); });
  for (const LightRows& chunk : chunks) {
    if (!chunk.bounds.empty()) continue;
    for (std::size_t i = 0; i < chunk.entities.size(); ++i)
      commands.add(chunk.entities[i], bounds_of(set->table, set->slot_of_row[chunk.first + i]));
  }
  set->updated = updated;
  if (regrouped || set->updated > 0) ++set->version;
}

void light_sort_system(Resource<const LightSet> set, ViewResource<const RenderView> view,
                       ViewResource<VisibleLights> visible, JobExecutor& jobs) {
  visible->light_scale = view->light_scale;
  const bool same_knobs =
      visible->built_wide_highlights == visible->wide_highlights && visible->built_light_scale == visible->light_scale;
  if (visible->set_version == set->version && same_view(visible->view, *view) && same_knobs) return;
  select_lights(set->lights, set->table, *view, jobs, *visible);
  visible->set_version = set->version;
  visible->built_wide_highlights = visible->wide_highlights;
  visible->built_light_scale = visible->light_scale;
  visible->view = *view;
  ++visible->version;
}

void zbin_build_system(ViewResource<const VisibleLights> visible, ViewResource<const ZBinSettings> settings,
                       ViewResource<ZBins> bins) {
  const ZBinParams params = z_bin_params(*visible, *settings, visible->view.near_m);
  if (bins->lists == visible->version && same_params(bins->params, params)) return;
  bins->lists = visible->version;
  bins->params = params;
  bins->bins.resize(std::size_t{2} * params.count);
  const std::span<ZBin> all(bins->bins);
  build_z_bins(visible->depths, params, bins->scratch, all.first(params.count), all.subspan(params.count));
}

void tile_light_masks_system(ViewResource<const VisibleLights> visible, ViewResource<const TileBound> bound,
                             ViewResource<TileLightMasks> masks, JobExecutor& jobs) {
  if (masks->lists == visible->version && masks->bound == *bound) return;
  masks->lists = visible->version;
  masks->bound = *bound;
  build_tile_light_masks(visible->mask_lights, visible->view, *bound, jobs, *masks);
}

void add_light_systems(Schedule& schedule) {
  schedule.add_system("light_reach", "lights", Stage::world, &light_reach_system);
  schedule.add_system("light_bounds", "lights", Stage::world, &light_bounds_system);
  schedule.add_system("light_sort", "lights", Stage::view, &light_sort_system);
  schedule.add_system("tile_light_masks", "lights", Stage::view, &tile_light_masks_system);
  schedule.add_system("zbin_build", "lights", Stage::view, &zbin_build_system);
}

void prepare_light_view(World& world, ViewId view) {
  if (world.try_view_resource<VisibleLights>(view) == nullptr) world.set_view_resource(view, VisibleLights{});
  if (world.try_view_resource<ZBinSettings>(view) == nullptr) world.set_view_resource(view, ZBinSettings{});
  if (world.try_view_resource<ZBins>(view) == nullptr) world.set_view_resource(view, ZBins{});
  if (world.try_view_resource<TileBound>(view) == nullptr) world.set_view_resource(view, TileBound::cone);
  if (world.try_view_resource<TileLightMasks>(view) == nullptr) world.set_view_resource(view, TileLightMasks{});
  world.set_view_resource(view, ListRoom{});
  if (world.try_view_resource<TileMaskHash>(view) == nullptr) world.set_view_resource(view, TileMaskHash{});
}

}  // namespace gloam
