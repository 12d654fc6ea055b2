// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Selects and sorts the lights of a view. One pass in floats culls all lights of the world; the rest runs on the
// visible lights only.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "modules/lights/cpu_clones.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {
namespace {

constexpr std::size_t kCullGrain = 512;  // lights per job
constexpr std::size_t kPackGrain = 512;
/// Relative rounding error in floats when a camera-relative position is rounded, rotated and summed, as a share of the
/// lengths involved. Bounds grow by it, so that no pixel the GPU lights is missed.
constexpr float kRounding = 4e-7f;
constexpr float kFarthestPosition = 1e37f;  // metres from the camera: products of larger values overflow a float
constexpr std::uint32_t kLocal = 1;
constexpr std::uint32_t kDirectional = 2;

/// The view's data for the culling loop.
struct CullView {
  double eye[3];
  float forward[3];
  float planes[6][4];
  float plane_rounding;
  float near_m;
};

CullView cull_view(const ViewProjection& view) {
  CullView cull{};
  float reach = 0.0f;
  for (std::size_t p = 0; p < 6; ++p) {
    const Plane& plane = view.frustum.planes[p];
    for (int axis = 0; axis < 3; ++axis) cull.planes[p][axis] = plane.normal[axis];
    cull.planes[p][3] = plane.distance;
    reach = std::max(reach, std::abs(plane.distance));
  }
  for (int axis = 0; axis < 3; ++axis) {
    cull.eye[axis] = view.position[axis];
    cull.forward[axis] = -view.view_from_relative[axis][2];
  }
  cull.plane_rounding = kRounding * reach;
  cull.near_m = view.near_m;
  return cull;
}

/// Input and output columns of the culling loop.
struct CullColumns {
  const double *x, *y, *z;
  const float* radius;
  float *center_x, *center_y, *center_z, *nearest, *farthest;
  std::uint32_t* kind;
};

/// Sets `kind` and the view depths of lights [begin, end). A plain loop over columns, so that the compiler vectorizes
/// it.
GLOAM_CPU_CLONES void cull_lights(CullColumns o, CullView v, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) {
    const auto cx = static_cast<float>(o.x[i] - v.eye[0]);
    const auto cy = static_cast<float>(o.y[i] - v.eye[1]);
    const auto cz = static_cast<float>(o.z[i] - v.eye[2]);
    const float radius = o.radius[i];
    const float spread = std::abs(cx) + std::abs(cy) + std::abs(cz);
    const float reach = radius + kRounding * (spread + radius);
    float inside = v.planes[0][0] * cx + v.planes[0][1] * cy + v.planes[0][2] * cz + v.planes[0][3];
    for (int p = 1; p < 6; ++p) {
      const float distance = v.planes[p][0] * cx + v.planes[p][1] * cy + v.planes[p][2] * cz + v.planes[p][3];
      inside = distance < inside ? distance : inside;
    }
    const float depth = v.forward[0] * cx + v.forward[1] * cy + v.forward[2] * cz;
    const float low = depth - reach > v.near_m ? depth - reach : v.near_m;
    const std::uint32_t seen = inside >= -reach - v.plane_rounding ? kLocal : 0u;
    const std::uint32_t sound = spread < kFarthestPosition ? seen : 0u;  // false for NaN and infinity
    const std::uint32_t local = radius >= 0.0f ? sound : 0u;
    o.center_x[i] = cx;
    o.center_y[i] = cy;
    o.center_z[i] = cz;
    o.nearest[i] = low;
    o.farthest[i] = depth + reach > low ? depth + reach : low;
    o.kind[i] = radius == kDirectionalLight ? kDirectional : local;
  }
}

struct CullJob {
  CullColumns columns;
  CullView view;
  void run(JobRange range) const { cull_lights(columns, view, range.begin, range.end); }
};

void find_visible(const LightTable& table, const ViewProjection& view, JobExecutor& executor,
                  LightSelection& selection) {
  const std::size_t count = table.size();
  for (auto* column : {&selection.x, &selection.y, &selection.z, &selection.nearest, &selection.farthest})
    column->resize(count);
  selection.kind.resize(count);
  const CullJob job{
      {table.x.data(), table.y.data(), table.z.data(), table.radius.data(), selection.x.data(), selection.y.data(),
       selection.z.data(), selection.nearest.data(), selection.farthest.data(), selection.kind.data()},
      cull_view(view)};
  executor.parallel_for(count, kCullGrain, [&job](JobRange range) { job.run(range); });
  selection.local.resize(count);
  selection.directional.clear();
  std::size_t locals = 0;
  std::uint32_t kinds = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    selection.local[locals] = i;
    locals += selection.kind[i] == kLocal ? 1 : 0;
    kinds |= selection.kind[i];
  }
  selection.local.resize(locals);
  if ((kinds & kDirectional) == 0) return;
  for (std::uint32_t i = 0; i < count; ++i)
    if (selection.kind[i] == kDirectional) selection.directional.push_back(i);
}

/// The directions of a spot's light: all unit vectors whose dot product with `axis` is at least `cosine`.
struct SpotDirections {
  vec3 axis;
  float cosine;
};

/// Greatest dot product of the directions with a unit vector.
float farthest_along(const SpotDirections& spot, vec3 forward) {
  const float cosine = glm::dot(spot.axis, forward);
  if (cosine >= spot.cosine) return 1.0f;
  // The cross product is exact where both vectors are almost parallel, unlike √(1 − cosine²).
  const float sine = glm::length(glm::cross(spot.axis, forward));
  return cosine * spot.cosine + sine * std::sqrt(std::max(1.0f - spot.cosine * spot.cosine, 0.0f));
}

/// Narrows the view depths of a spot from those of its sphere to those of its cone: a spherical sector extends from its
/// apex to the points of its cap that are nearest and farthest along the view.
void narrow_to_cone(const LightRecord& record, const PlacedLight& placed, const ViewProjection& view, float& nearest,
                    float& farthest) {
  // Shading rounds the cosine of the angle to the axis, so that it lights a slightly wider cone.
  constexpr float kCosineRounding = 1e-6f;
  const vec3 forward =
      -vec3(view.view_from_relative[0][2], view.view_from_relative[1][2], view.view_from_relative[2][2]);
  const vec3 apex = view.relative(placed.position);
  const SpotDirections spot{placed.direction, record.cos_outer - kCosineRounding};
  const float depth = glm::dot(forward, apex), range = record.range_m;
  const float rounding = 3.0f * kRounding * (std::abs(apex.x) + std::abs(apex.y) + std::abs(apex.z) + range);
  const float ahead = range * std::max(farthest_along(spot, forward), 0.0f);
  const float behind = range * std::max(farthest_along(spot, -forward), 0.0f);
  const float low = depth - behind - rounding, high = depth + ahead + rounding;
  if (low > nearest) nearest = low;
  if (high < farthest) farthest = high;
  farthest = std::max(farthest, nearest);
}

/// Keeps the `capacity` indices of greatest importance (ties: lower index), in ascending order. Returns the number of
/// dropped indices.
template <class Importance>
std::uint32_t keep_most_important(std::vector<std::uint32_t>& lights, std::size_t capacity,
                                  std::vector<std::uint64_t>& keys, Importance&& importance) {
  if (lights.size() <= capacity) return 0;
  keys.clear();
  // The bits of positive floats sort like the floats. Inverted bits put the greatest importance first; ties sort by
  // index.
  for (const std::uint32_t i : lights)
    keys.push_back(std::uint64_t{~std::bit_cast<std::uint32_t>(importance(i))} << 32 | i);
  std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(capacity), keys.end());
  const auto dropped = static_cast<std::uint32_t>(lights.size() - capacity);
  lights.resize(capacity);
  for (std::size_t i = 0; i < capacity; ++i) lights[i] = static_cast<std::uint32_t>(keys[i]);
  std::sort(lights.begin(), lights.end());
  return dropped;
}

/// Solid angle of the light's bound as seen from the camera, up to a constant factor, times its brightness.
float importance_of(const LightTable& table, const ViewProjection& view, std::uint32_t i) {
  const vec3 center = view.relative(dvec3(table.x[i], table.y[i], table.z[i]));
  const float radius = table.radius[i];
  const float distance = std::max(glm::length(center), radius);
  return radius * radius / (distance * distance) * table.records[i].brightness;
}

/// Bits that sort like the floats.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

/// Stable radix sort by the high 32 bits; the result is in `keys`. After the least depth is subtracted, a view's depths
/// usually need three counting passes, rarely four. No pass has most of its keys in one bucket, where each increment
/// would wait for the one before.
void sort_by_depth(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& other) {
  constexpr std::size_t kPlain =
      64;  // below this, std::sort is faster; the low bits also ascend, so the order is the same
  constexpr std::uint32_t kMostDigitBits = 9;
  constexpr std::uint32_t kMostPasses = 4;
  if (keys.size() < kPlain) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  auto least = ~std::uint32_t{0};
  std::uint32_t greatest = 0;
  for (const std::uint64_t key : keys) {
    least = std::min(least, static_cast<std::uint32_t>(key >> 32));
    greatest = std::max(greatest, static_cast<std::uint32_t>(key >> 32));
  }
  const auto bits = static_cast<std::uint32_t>(std::bit_width(greatest - least));
  if (bits == 0) return;
  const std::uint32_t passes = (bits + kMostDigitBits - 1) / kMostDigitBits;
  const std::uint32_t digit_bits = (bits + passes - 1) / passes;
  const std::uint32_t mask = (1u << digit_bits) - 1;
  std::array<std::array<std::uint32_t, std::size_t{1} << kMostDigitBits>, kMostPasses> counts;
  for (std::uint32_t pass = 0; pass < passes; ++pass) std::fill_n(counts[pass].begin(), mask + 1, 0u);
  for (const std::uint64_t key : keys) {
    std::uint32_t depth = static_cast<std::uint32_t>(key >> 32) - least;
    for (std::uint32_t pass = 0; pass < passes; ++pass, depth >>= digit_bits) ++counts[pass][depth & mask];
  }
  other.resize(keys.size());
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    std::uint32_t* const places = counts[pass].data();
    std::uint32_t begin = 0;
    for (std::uint32_t digit = 0; digit <= mask; ++digit) {
      const std::uint32_t size = places[digit];
      places[digit] = begin;
      begin += size;
    }
    const std::uint32_t shift = pass * digit_bits;
    std::uint64_t* const to = other.data();
    for (const std::uint64_t key : keys)
      to[places[(static_cast<std::uint32_t>(key >> 32) - least) >> shift & mask]++] = key;
    keys.swap(other);
  }
}

struct PackJob {
  std::span<const PlacedLight> lights;
  const LightTable& table;
  const ViewProjection& view;
  VisibleLights& visible;

  /// Lights are visited in depth order, which the hardware prefetcher cannot predict.
  void prefetch(std::size_t i) const {
    if (i >= visible.selection.keys.size()) return;
    const auto light = static_cast<std::uint32_t>(visible.selection.keys[i]);
    __builtin_prefetch(&table.records[light]);
    __builtin_prefetch(&lights[light].position);
  }

  void run(JobRange range) const {
    constexpr std::size_t kAhead = 12;
    const LightSelection& from = visible.selection;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto light = static_cast<std::uint32_t>(from.keys[i]);
      prefetch(i + kAhead);
      const LightRecord& record = table.records[light];
      const vec3 position = view.relative(lights[light].position);
      const vec3 direction = lights[light].direction;
      visible.block.local[i] = {
          position,     record.inverse_range_squared, record.color * visible.light_scale, record.ramp.x, direction,
          record.ramp.y};
      visible.block.emitter_radius[i / 4][static_cast<int>(i % 4)] =
          visible.wide_highlights ? record.emitter_radius_m : 0.0f;
      visible.mask_lights[i] = {{vec3(from.x[light], from.y[light], from.z[light]), table.radius[light]},
                                position,
                                direction,
                                record.cos_outer,
                                record.range_m};
      visible.depths[i] = {from.nearest[light], from.farthest[light]};
      visible.local_entities[i] = record.entity;
    }
  }
};

void pack_directional(std::span<const PlacedLight> lights, const LightTable& table, VisibleLights& visible) {
  const std::vector<std::uint32_t>& chosen = visible.selection.directional;
  visible.block.directional_count = static_cast<std::uint32_t>(chosen.size());
  visible.directional_entities.clear();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const PlacedLight& placed = lights[chosen[i]];
    const float half_angle = visible.wide_highlights ? table.records[chosen[i]].emitter_radius_m : 0.0f;
    visible.block.directional[i] = {table.records[chosen[i]].color * visible.light_scale, placed.light.apparent_angle,
                                    placed.direction, half_angle};
    visible.directional_entities.push_back(placed.entity);
  }
}

}  // namespace

void select_lights(std::span<const PlacedLight> lights, const LightTable& table, const ViewProjection& view,
                   JobExecutor& executor, VisibleLights& visible) {
  LightSelection& selection = visible.selection;
  visible.total = static_cast<std::uint32_t>(lights.size());
  find_visible(table, view, executor, selection);
  visible.dropped = keep_most_important(selection.local, GLOAM_MAX_LOCAL_LIGHTS, selection.keys,
                                        [&](std::uint32_t i) { return importance_of(table, view, i); });
  visible.dropped += keep_most_important(selection.directional, GLOAM_MAX_DIRECTIONAL_LIGHTS, selection.keys,
                                         [&](std::uint32_t i) { return table.records[i].brightness; });
  for (const std::uint32_t i : selection.local)
    if (table.records[i].cos_outer >= 0.0f)
      narrow_to_cone(table.records[i], lights[i], view, selection.nearest[i], selection.farthest[i]);
  selection.keys.resize(selection.local.size());
  std::uint64_t* const keys = selection.keys.data();
  const float* const nearest = selection.nearest.data();
  for (std::size_t i = 0; i < selection.local.size(); ++i) {
    const std::uint32_t light = selection.local[i];
    keys[i] = std::uint64_t{ordered_bits(nearest[light])} << 32 | light;
  }
  sort_by_depth(selection.keys, selection.sorted);

  const std::size_t count = selection.keys.size();
  visible.block.local_count = static_cast<std::uint32_t>(count);
  visible.local_entities.resize(count);
  visible.depths.resize(count);
  visible.mask_lights.resize(count);
  const PackJob job{lights, table, view, visible};
  executor.parallel_for(count, kPackGrain, [&job](JobRange range) { job.run(range); });
  pack_directional(lights, table, visible);
}

void select_lights(std::span<const PlacedLight> lights, const ViewProjection& view, VisibleLights& visible) {
  LightTable table;
  table.resize(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    table.set_light(i, lights[i]);
    table.set_place(i, lights[i]);
  }
  select_lights(lights, table, view, *make_serial_executor(), visible);
}

}  // namespace gloam
