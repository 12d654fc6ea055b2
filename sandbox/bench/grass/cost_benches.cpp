// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/grass/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Times of the passes of grass in a usual frame of builtin:meadow, and by number of live blades.

namespace gloam {
namespace {

constexpr std::uint32_t kGrassCostWidth = 640;
constexpr std::uint32_t kGrassCostHeight = 360;
constexpr int kGrassCostFrames = 9;
constexpr int kGrassCostWarmUp = 3;

struct GrassCost {
  std::vector<double> sort_ns, lod_ns, simulation_ns, drawing_ns, all_ns;
  double live = 0.0;
  double masters = 0.0;
  std::uint64_t hash = 0;  ///< of the poses of the live blades
};

Result<GrassCost> measure_grass_cost(GrassCase& grass, int warm_up, int frames) {
  GrassCost cost;
  for (int i = -warm_up; i < frames; ++i) {
    const auto sample = grass.draw(kGrassFrame_s);
    if (!sample) return sample.error();
    if (i < 0) continue;
    const GrassTimes times = grass_times(*sample);
    cost.sort_ns.push_back(times.sort_ns);
    cost.lod_ns.push_back(times.lod_ns);
    cost.simulation_ns.push_back(times.simulation_ns);
    cost.drawing_ns.push_back(times.drawing_ns);
    cost.all_ns.push_back(times.all_ns());
    cost.live = counter_of(*sample, "grass.live");
    cost.masters = counter_of(*sample, "grass.masters_simulated");
  }
  const auto reading = grass.draw_and_read(kGrassFrame_s);
  if (!reading) return reading.error();
  cost.hash = hash_of_poses(*reading);
  return cost;
}

template <class Get>
void add_cost_rows(BenchRegistry& registry, const std::string& id, std::optional<double> bar, Get get) {
  const auto add = [&](const char* what, const char* unit, std::optional<double> row_bar, auto value) {
    BenchRow row;
    row.id = id + what;
    row.unit = unit;
    row.bar = row_bar;
    row.run = [get, value](BenchContext& context) -> Result<BenchValue> {
      const auto cost = get(context);
      if (!cost) return cost.error();
      BenchValue result = value(**cost);
      result.scene = kMeadow;
      return result;
    };
    registry.add(std::move(row));
  };
  using Times = std::vector<double> GrassCost::*;
  const auto add_ms = [&](const char* what, std::optional<double> row_bar, Times times) {
    add(what, "ms", row_bar, [times](const GrassCost& c) { return per_item(c.*times, kNsPerMs, c.hash); });
  };
  add_ms(".ms", bar, &GrassCost::all_ns);
  add_ms(".sort_ms", std::nullopt, &GrassCost::sort_ns);
  add_ms(".lod_ms", std::nullopt, &GrassCost::lod_ns);
  add_ms(".simulation_ms", std::nullopt, &GrassCost::simulation_ns);
  add_ms(".drawing_ms", std::nullopt, &GrassCost::drawing_ns);
  add(".live", "blades", std::nullopt, [](const GrassCost& c) { return single_value(c.live, c.hash); });
  add(".masters", "blades", std::nullopt, [](const GrassCost& c) { return single_value(c.masters, c.hash); });
}

Result<GrassCost> measure_frame(BenchContext& context) {
  const auto grass = GrassCase::open(context, "near", kGrassCostWidth, kGrassCostHeight);
  if (!grass) return grass.error();
  return measure_grass_cost(**grass, kGrassCostWarmUp, kGrassCostFrames);
}

void add_grass_frame_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<GrassCost>>();
  add_cost_rows(registry, "grass.frame", 60.0,
                [shared](BenchContext& context) { return shared->get([&] { return measure_frame(context); }); });
}

struct LiveCount {
  const char* name;
  double blades;
};
constexpr std::array<LiveCount, 4> kLiveCounts = {{{"1k", 1e3}, {"10k", 1e4}, {"100k", 1e5}, {"1m", 1e6}}};
constexpr int kLiveFrames = 5;
constexpr int kLiveWarmUp = 1;
constexpr double kMostMiss = 0.05;

/// The meadow from afar, all blades in view drawn, with the density that gives so many live blades.
Result<GrassCost> measure_live(BenchContext& context, double blades) {
  const auto grass = GrassCase::open(context, "far", kGrassCostWidth, kGrassCostHeight);
  if (!grass) return grass.error();
  GLOAM_TRY((*grass)->set("grass.lod_pixels", "0"));
  const auto usual = (*grass)->draw_and_read(0.0);
  if (!usual) return usual.error();
  GLOAM_TRY((*grass)->set("grass.density_scale", std::to_string(blades / usual->draws.live)));
  auto cost = measure_grass_cost(**grass, kLiveWarmUp, kLiveFrames);
  if (!cost) return cost.error();
  if (std::abs(cost->live / blades - 1.0) > kMostMiss)
    return Error{ErrorKind::failed, std::to_string(cost->live) + " blades are live, not " + std::to_string(blades)};
  return cost;
}

void add_live_rows(BenchRegistry& registry) {
  for (const LiveCount& count : kLiveCounts) {
    const auto shared = std::make_shared<Once<GrassCost>>();
    add_cost_rows(registry, std::string("grass.cost.live_") + count.name, std::nullopt,
                  [shared, blades = count.blades](BenchContext& context) {
                    return shared->get([&] { return measure_live(context, blades); });
                  });
  }
}

}  // namespace

void add_grass_cost_benches(BenchRegistry& registry) {
  add_grass_frame_rows(registry);
  add_live_rows(registry);
}

}  // namespace gloam
