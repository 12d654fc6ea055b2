// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/indirect_light.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/ecs/view.h"
#include "modules/reflections/bake/capture_view.h"
#include "modules/reflections/components.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/override.h"
#include "modules/reflections/passes/uploads.h"
#include "modules/reflections/probes/rows.h"
#include "modules/reflections/relighting/light_states.h"

namespace gloam {
namespace {

constexpr std::size_t kMapCells = std::size_t{kProbeCells} * kProbeCells;

/// Factor of the light that lamps cause.
vec3 lamp_factor(const ReflectionCaptures& captures, std::size_t layer, std::span<const CaptureFactor> factors,
                 std::span<const vec4> cells) {
  if (layer >= factors.size() || factors[layer].first < 0) return vec3(1.0f);
  const auto first = static_cast<std::size_t>(factors[layer].first);
  if (first + kMapCells > cells.size() || layer >= captures.probe_parts.size()) return vec3(1.0f);
  const std::vector<vec3>& lux = captures.probe_parts[layer].lamps_lux;
  dvec3 sum(0.0), even(0.0), weights(0.0);
  for (std::size_t i = 0; i < kMapCells; ++i) {
    const dvec3 factor(cells[first + i]), weight(lux.size() == kMapCells ? lux[i] : vec3(0.0f));
    sum += weight * factor;
    weights += weight;
    even += factor / static_cast<double>(kMapCells);
  }
  vec3 mean(0.0f);
  for (int c = 0; c < 3; ++c) mean[c] = static_cast<float>(weights[c] > 0.0 ? sum[c] / weights[c] : even[c]);
  return mean;
}

void set_terms(shaders::DiffuseProbe& probe, const ProbeDiffuse& diffuse, const vec3& lamp_factor, float scale) {
  for (std::size_t k = 0; k < kDiffuseTerms; ++k)
    probe.terms[k] = vec4(scale * (diffuse.unlit[k] + lamp_factor * diffuse.lamps[k]), 0.0f);
}

shaders::ProbeRow upright_row(const RenderView& view, const dvec3& center, const dvec3& half, float fade) {
  shaders::ProbeRow row{};
  row.center = view.relative(center);
  row.to_x.x = static_cast<float>(1.0 / half.x);
  row.to_y.y = static_cast<float>(1.0 / half.y);
  row.to_z.z = static_cast<float>(1.0 / half.z);
  row.fade = fade;
  row.emission = row.factor = -1.0f;
  return row;
}

/// The grid's cells, and a box around all of them with their mean.
std::vector<shaders::DiffuseProbe> grid_probes(const World& world, const RenderView& view,
                                               const ReflectionCaptures& captures, const LampFactors& lamps) {
  constexpr double kBeyond = 1.5;  // of a cell's half size
  constexpr auto kFade = static_cast<float>(1.0 - 1.0 / kBeyond);
  std::vector<shaders::DiffuseProbe> probes;
  if (captures.grid.empty()) return probes;
  const bool follow = lamps.factors.data() != nullptr;
  const std::vector<CapturedLightState> now = follow ? light_states(world) : captures.lights;
  const bool changed = now != captures.lights;
  dvec3 least(captures.grid.front().center), most(least);
  shaders::DiffuseProbe mean{};
  for (const GridProbe& cell : captures.grid) {
    vec3 factor(lamps.lamps ? 1.0f : 0.0f);
    const vec3 lux = changed ? surrounding_lux(now, cell.center) : cell.lamps_lux;
    for (int c = 0; c < 3; ++c)
      if (cell.lamps_lux[c] > 0.0f) factor[c] = std::min(lux[c] / cell.lamps_lux[c], kMostCaptureFactor);
    shaders::DiffuseProbe& probe = probes.emplace_back();
    probe.row = upright_row(view, cell.center, kBeyond * dvec3(cell.half), kFade);
    set_terms(probe, cell.diffuse, factor, view.light_scale);
    for (std::size_t k = 0; k < kDiffuseTerms; ++k)
      mean.terms[k] += probe.terms[k] / static_cast<float>(captures.grid.size());
    least = glm::min(least, cell.center - dvec3(cell.half));
    most = glm::max(most, cell.center + dvec3(cell.half));
  }
  mean.row = upright_row(view, 0.5 * (least + most), 0.5 * kBeyond * (most - least), kFade);
  probes.push_back(mean);
  return probes;
}

const TracedIndirect* traced_indirect_of(const World& world, const RenderView& view) {
  const auto* traced = world.try_resource<TracedIndirect>();
  const bool fits = traced != nullptr && traced->width == view.width && traced->height == view.height;
  return fits ? traced : nullptr;
}

}  // namespace

vec3 surrounding_lux(std::span<const CapturedLightState> lights, const dvec3& point) {
  constexpr double kHalf = 1e-3;
  std::array<LitPatch, 6> sides;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    LitPatch& patch = sides[static_cast<std::size_t>(side)];
    patch.center = point;
    patch.normal = dvec3(0.0);
    patch.normal[axis] = side % 2 == 0 ? 1.0 : -1.0;
    patch.half_u[(axis + 1) % 3] = kHalf;
    patch.half_v[(axis + 2) % 3] = kHalf;
  }
  vec3 sum(0.0f);
  for (const vec3& lux : illuminances(lights, sides)) sum += lux;
  return sum;
}

std::vector<shaders::DiffuseProbe> diffuse_probes(const World& world, const RenderView& view,
                                                  const ReflectionCaptures& captures, const LampFactors& lamps) {
  std::vector<shaders::DiffuseProbe> probes, grid = grid_probes(world, view, captures, lamps);
  for (const shaders::ProbeRow& row : probe_rows(world, view, captures)) {
    const auto layer = static_cast<std::size_t>(row.layer);
    if (layer >= captures.probe_diffuse.size()) continue;
    const ProbeDiffuse& diffuse = captures.probe_diffuse[layer];
    const vec3 factor = lamps.lamps ? lamp_factor(captures, layer, lamps.factors, lamps.cells) : vec3(0.0f);
    if (row.global > 0.0f && !grid.empty()) {
      grid.pop_back();  // the mean
      probes.insert(probes.end(), grid.begin(), grid.end());
      grid.clear();
    }
    shaders::DiffuseProbe& probe = probes.emplace_back();
    probe.row = row;
    set_terms(probe, diffuse, factor, view.light_scale);
    if (row.global > 0.0f && diffuse.open > 0.0f) {
      probe.open = diffuse.open;
      probe.per_square_reach = std::min(1.0f / (diffuse.reach * diffuse.reach), 1e30f);
    }
  }
  probes.insert(probes.end(), grid.begin(), grid.end());
  return probes;
}

bool has_diffuse_light(const World& world) {
  const auto* captures = world.try_resource<ReflectionCaptures>();
  return (captures != nullptr && !(captures->grid.empty() && captures->probe_diffuse.empty())) ||
         world.try_resource<TracedIndirect>() != nullptr;
}

void announce_indirect_light(FrameBuilder& frame, Staging& staging, CaptureFactors& factors) {
  const World& world = frame.world();
  const RenderView& view = frame.view();
  const bool captured = view.purpose == ViewPurpose::capture;
  if (captured && world.try_resource<SurroundingsLeftOut>() != nullptr) return;
  IndirectLight light;
  if (frame.knobs().value(kIndirectLight) == IndirectSource::probes) {
    const auto& captures = world.resource<ReflectionCaptures>();
    const bool unlit = captured && is_unlit_capture(view.id);
    const bool follow = !unlit && frame.knobs().value(kReflectionLightScale);
    if (follow) factors.update(world, captures);
    light.probes = diffuse_probes(world, view, captures,
                                  {.factors = follow ? factors.probes() : std::span<const CaptureFactor>{},
                                   .cells = follow ? factors.cells() : std::span<const vec4>{},
                                   .lamps = !unlit});
  }
  if (const TracedIndirect* traced = captured ? nullptr : traced_indirect_of(world, view))
    light.traced = upload_traced(frame, staging, "indirect_traced", *traced);
  if (!light.probes.empty() || light.traced) frame.put(std::move(light));
}

}  // namespace gloam
