// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/probes/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/packing.h"
#include "engine/scene/components.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {
namespace {

/// Mean of the texels of the last mip, which is prefiltered for roughness 1, about the middle of a probe's map (up) or
/// its corners (down).
vec4 mean_about(const CapturedLayers& probes, std::size_t layer, bool up) {
  const std::uint32_t mip = probes.mips - 1, side = std::max(probes.side >> mip, 1u);
  const std::size_t first = layer * probes.layer_halves() + probes.mip_offset(mip);
  vec4 sum(0.0f);
  for (const std::uint32_t y : {0u, 1u})
    for (const std::uint32_t x : {0u, 1u}) {
      const std::uint32_t row = up ? (side - 1 + y) / 2 : y * (side - 1);
      const std::uint32_t column = up ? (side - 1 + x) / 2 : x * (side - 1);
      const std::size_t texel = first + 4 * (std::size_t{row} * side + column);
      for (int c = 0; c < 3; ++c) sum[c] += 0.25f * half_to_float(probes.texels[texel + static_cast<std::size_t>(c)]);
    }
  return sum;
}

/// Mean of a probe's factors over the upper or the lower half of its directions: inside or outside the square that
/// joins the middles of the map's sides.
vec4 mean_factor(std::span<const vec4> cells, bool up) {
  constexpr int kSide = GLOAM_PROBE_CELLS;
  vec4 sum(0.0f);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int away = std::abs(2 * x + 1 - kSide) + std::abs(2 * y + 1 - kSide);
      if ((away <= kSide) == up) sum += vec4(vec3(cells[static_cast<std::size_t>(y * kSide + x)]), 1.0f);
    }
  return sum / sum.w;
}

void set_means(const CapturedLayers& probes, std::size_t layer, std::span<const vec4> cells, shaders::ProbeRow& row) {
  if (probes.mips == 0) return;  // without images
  for (const bool up : {true, false}) {
    vec4 mean = mean_about(probes, layer, up);
    if (row.factor >= 0.0f) {
      const auto first = static_cast<std::size_t>(row.factor);
      const vec4 unscaled =
          row.emission >= 0.0f ? mean_about(probes, static_cast<std::size_t>(row.emission), up) : vec4(0.0f);
      const vec4 factor = mean_factor(cells.subspan(first, GLOAM_PROBE_CELLS * GLOAM_PROBE_CELLS), up);
      mean = unscaled + factor * glm::max(mean - unscaled, vec4(0.0f));
    }
    (up ? row.above : row.below) = mean;
  }
}

}  // namespace

std::vector<shaders::ProbeRow> probe_rows(const World& world, const RenderView& view,
                                          const ReflectionCaptures& captures, std::span<const CaptureFactor> factors,
                                          std::span<const vec4> cells) {
  struct Ordered {
    double volume = 0.0;
    shaders::ProbeRow row{};
  };
  std::vector<Ordered> found;
  for (std::size_t i = 0; i < captures.probe_entities.size(); ++i) {
    const Entity entity = captures.probe_entities[i];
    const CubeProbe* probe = world.try_get<CubeProbe>(entity);
    const WorldTransform* transform = world.try_get<WorldTransform>(entity);
    if (probe == nullptr || transform == nullptr) continue;
    Ordered next;
    next.row.layer = static_cast<float>(i);
    next.row.fade = kProbeFade;
    next.row.center = view.relative(dvec3(transform->matrix[3]));
    next.row.factor = i < factors.size() ? static_cast<float>(factors[i].first) : -1.0f;
    next.row.emission = i < captures.probe_parts.size() ? static_cast<float>(captures.probe_parts[i].emission) : -1.0f;
    set_means(captures.probes, i, cells, next.row);
    next.row.global = probe->global ? 1.0f : 0.0f;
    next.volume = std::numeric_limits<double>::infinity();
    if (!probe->global) {
      PlacedRoom box;  // a room's box is described in the same way
      if (!place_room(entity, {.size_m = probe->size_m}, nullptr, transform->matrix, box)) continue;
      next.row.to_x = vec3(box.to_face[0]);
      next.row.to_y = vec3(box.to_face[1]);
      next.row.to_z = vec3(box.to_face[2]);
      next.volume = 1.0 / std::abs(glm::dot(box.to_face[0], glm::cross(box.to_face[1], box.to_face[2])));
    }
    found.push_back(next);
  }
  std::stable_sort(found.begin(), found.end(), [](const Ordered& a, const Ordered& b) { return a.volume < b.volume; });
  std::vector<shaders::ProbeRow> rows;
  for (const Ordered& probe : found) rows.push_back(probe.row);
  return rows;
}

}  // namespace gloam
