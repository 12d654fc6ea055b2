// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/indirect_light.h"

#include <array>
#include <cstddef>

#include "engine/ecs/view.h"
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

const TracedIndirect* traced_indirect_of(const World& world, const RenderView& view) {
  const auto* traced = world.try_resource<TracedIndirect>();
  const bool fits = traced != nullptr && traced->width == view.width && traced->height == view.height;
  return fits ? traced : nullptr;
}

}  // namespace

std::vector<shaders::DiffuseProbe> diffuse_probes(const World& world, const RenderView& view,
                                                  const ReflectionCaptures& captures,
                                                  std::span<const CaptureFactor> factors, std::span<const vec4> cells) {
  std::vector<shaders::DiffuseProbe> probes;
  for (const shaders::ProbeRow& row : probe_rows(world, view, captures)) {
    const auto layer = static_cast<std::size_t>(row.layer);
    if (layer >= captures.probe_diffuse.size()) continue;
    const ProbeDiffuse& diffuse = captures.probe_diffuse[layer];
    const vec3 factor = lamp_factor(captures, layer, factors, cells);
    shaders::DiffuseProbe& probe = probes.emplace_back();
    probe.row = row;
    for (std::size_t k = 0; k < kDiffuseTerms; ++k)
      probe.terms[k] = vec4(view.light_scale * (diffuse.unlit[k] + factor * diffuse.lamps[k]), 0.0f);
  }
  return probes;
}

bool has_diffuse_light(const World& world) {
  return world.view<const CubeProbe>().size() > 0 || world.try_resource<TracedIndirect>() != nullptr;
}

void announce_indirect_light(FrameBuilder& frame, Staging& staging, CaptureFactors& factors) {
  const World& world = frame.world();
  const RenderView& view = frame.view();
  if (view.purpose == ViewPurpose::capture) return;
  IndirectLight light;
  if (frame.knobs().value(kIndirectLight) == IndirectSource::probes) {
    const auto& captures = world.resource<ReflectionCaptures>();
    if (frame.knobs().value(kReflectionLightScale)) factors.update(world, captures);
    const bool follow = frame.knobs().value(kReflectionLightScale);
    light.probes = diffuse_probes(world, view, captures, follow ? factors.probes() : std::span<const CaptureFactor>{},
                                  follow ? factors.cells() : std::span<const vec4>{});
  }
  if (const TracedIndirect* traced = traced_indirect_of(world, view))
    light.traced = upload_traced(frame, staging, "indirect_traced", *traced);
  if (!light.probes.empty() || light.traced) frame.put(std::move(light));
}

}  // namespace gloam
