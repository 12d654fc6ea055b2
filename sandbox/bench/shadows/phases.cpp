// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/phases.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace gloam {
namespace {

constexpr std::uint32_t kTile = 8;  // pixels
constexpr double kFixedLights = 32.0;

struct NamedPhase {
  std::string_view pass;
  ShadowPhase phase;
};
constexpr NamedPhase kPasses[] = {
    {"depth_bounds", ShadowPhase::prepare},      {"results", ShadowPhase::prepare},
    {"find_lights_approx", ShadowPhase::approx}, {"find_lights_accurate", ShadowPhase::accurate},
    {"list_tile_lights", ShadowPhase::classify}, {"classify_shadows", ShadowPhase::classify},
    {"generate_shadows", ShadowPhase::generate}, {"finish_lists", ShadowPhase::finish},
    {"deferred", ShadowPhase::lighting}};

double tile_count(std::uint32_t width, std::uint32_t height) {
  return static_cast<double>((width + kTile - 1) / kTile) * ((height + kTile - 1) / kTile);
}

}  // namespace

std::optional<ShadowPhase> shadow_phase_of(const PassTime& pass) {
  if (makes_shadow_maps(pass)) return std::nullopt;
  const auto* const found = std::ranges::find(kPasses, std::string_view(pass.name), &NamedPhase::pass);
  if (found != std::end(kPasses)) return found->phase;
  if (pass.module == "closeups") return ShadowPhase::closeups;
  if (pass.module == "lights" || pass.module == "shadows") return ShadowPhase::prepare;
  return std::nullopt;
}

bool makes_shadow_maps(const PassTime& pass) {
  return pass.name.starts_with("shadow_map") || pass.name == "shadow_planes";
}

double closeup_map_ms(const FrameReport& report) {
  double ms = 0.0;
  for (const PassTime& pass : report.passes) ms += pass.name.starts_with("shadow_map_closeup") ? pass.ms : 0.0;
  return ms;
}

double PhaseTimes::total() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }

PhaseTimes phase_times(const FrameReport& report) {
  PhaseTimes times;
  for (const PassTime& pass : report.passes)
    if (const auto phase = shadow_phase_of(pass)) times.ms[static_cast<std::size_t>(*phase)] += pass.ms;
  return times;
}

double counter_of(const FrameReport& report, std::string_view name) {
  const auto found = report.counters.find(std::string(name));
  return found == report.counters.end() ? 0.0 : found->second;
}

bool lists_had_room(const FrameReport& report) {
  return counter_of(report, "shadows.fallback_tiles") + counter_of(report, "lights.overflow_tiles") <= 0.0;
}

double fixed_list_bytes(std::uint32_t width, std::uint32_t height) {
  return tile_count(width, height) * kFixedLights * (4.0 / 3.0 + 4.0);
}

double fixed_visibility_bytes(std::uint32_t width, std::uint32_t height) {
  return tile_count(width, height) * kFixedLights * kTile * kTile;
}

}  // namespace gloam
