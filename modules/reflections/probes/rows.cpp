// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/probes/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/components.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {

std::vector<shaders::ProbeRow> probe_rows(const World& world, const RenderView& view,
                                          const ReflectionCaptures& captures, std::span<const CaptureFactor> factors) {
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
