// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/accuracy/metrics/statistics.h"
#include "modules/grass/components.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/growth/blade_types.h"
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

/// Types for a field of nine, beside the built-in five.
constexpr std::string_view kFurtherTypes =
    R"(leaning    0.20   1.00    0.95   0.30       0.10   0,0  0.15,0.35  0.32,0.7  0.5,1
drooping   0.16   1.15    0.80   0.24       0.08   0,0  0.02,0.5  0.1,0.9  0.35,0.95  0.55,0.75
short      0.14   0.60    1.10   0.40       0.20   0,0  0.02,0.5  0.06,1
curled     0.10   0.85    0.90   0.26       0.10   0,0  0.05,0.45  0.25,0.8  0.4,0.75  0.35,0.6
)";
constexpr std::array<std::size_t, 3> kTypeCounts = {3, 5, 9};
constexpr std::size_t kNeighbourPatches = 400;

/// The first lines of the built-in types, and of the further ones, as a file.
std::string types_text(std::size_t types) {
  std::istringstream lines(std::string(builtin_blade_types_text()) + std::string(kFurtherTypes));
  std::string text;
  for (std::string line; types > 0 && std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    text += line + "\n";
    --types;
  }
  return text;
}

/// Share of blades whose nearest neighbour in their patch copies the shape of the same type.
double same_neighbours(const GrassField& field) {
  std::size_t same = 0, all = 0;
  for (std::size_t p = 0; p < std::min(field.patches.size(), kNeighbourPatches); ++p) {
    const std::span<const GrassBlade> blades =
        std::span(field.blades).subspan(p * GLOAM_GRASS_PATCH_BLADES, field.patches[p].blades);
    const auto shape = [&](std::size_t i) { return field.blades[blades[i].master].type; };
    for (std::size_t i = 0; i < blades.size(); ++i) {
      std::size_t nearest = i;
      float least = std::numeric_limits<float>::infinity();
      for (std::size_t k = 0; k < blades.size(); ++k) {
        const float distance = k == i ? least : glm::length(blades[k].root_m - blades[i].root_m);
        if (distance < least) least = distance, nearest = k;
      }
      if (nearest == i) continue;
      ++all;
      same += shape(nearest) == shape(i) ? 1 : 0;
    }
  }
  return all > 0 ? static_cast<double>(same) / static_cast<double>(all) : 0.0;
}

struct TypeCost {
  GrassCost cost;
  double same_neighbours = 0.0;
};

/// The usual frame with this many blade types.
Result<TypeCost> measure_types(BenchContext& context, std::size_t types) {
  const auto grass = GrassCase::open(context, "near", kGrassCostWidth, kGrassCostHeight);
  if (!grass) return grass.error();
  std::error_code fault;
  std::string path = (std::filesystem::temp_directory_path(fault) / "gloam-types-XXXXXX").string();
  const int file = mkstemp(path.data());
  if (file < 0) return Error{ErrorKind::failed, "no temporary file can be made for blade types: " + path};
  close(file);
  std::ofstream(path) << types_text(types);
  World& world = (*grass)->session().world;
  const std::uint32_t name = world.resource<SceneStrings>().intern(path);
  world.view<GrassSurface>().each([&](GrassSurface& surface) { surface.types = name; });
  auto cost = measure_grass_cost(**grass, kGrassCostWarmUp, kGrassCostFrames);
  std::filesystem::remove(path, fault);
  if (!cost) return cost.error();
  const GrassField& field = world.resource<GrassField>();
  if (field.types.size() != types)
    return Error{ErrorKind::failed, "the field has " + std::to_string(field.types.size()) + " blade types"};
  return TypeCost{std::move(*cost), same_neighbours(field)};
}

void add_type_rows(BenchRegistry& registry) {
  for (const std::size_t types : kTypeCounts) {
    const auto shared = std::make_shared<Once<TypeCost>>();
    const std::string id = "grass.types." + std::to_string(types);
    const auto measured = [shared, types](BenchContext& context) {
      return shared->get([&] { return measure_types(context, types); });
    };
    add_cost_rows(registry, id, std::nullopt, [measured](BenchContext& context) -> Result<const GrassCost*> {
      const auto found = measured(context);
      if (!found) return found.error();
      return &(*found)->cost;
    });
    BenchRow row;
    row.id = id + ".same_neighbours";
    row.unit = "share of blades";
    row.run = [measured](BenchContext& context) -> Result<BenchValue> {
      const auto found = measured(context);
      if (!found) return found.error();
      BenchValue value = single_value((*found)->same_neighbours, (*found)->cost.hash);
      value.scene = kMeadow;
      return value;
    };
    registry.add(std::move(row));
  }
}

/// Rows of stems at rest with other numbers of knots: how far their segments are from the curve of the type. The number
/// of knots of the simulation is a constant of its kernels.
constexpr std::array<std::size_t, 3> kKnotCounts = {8, 16, 24};
constexpr std::size_t kCurveKnots = 512;
constexpr double kKnotBlade_mm = 300.0;

/// Distances of a curve from the stem with this many knots, mm, for a blade of kKnotBlade_mm.
std::vector<float> stem_errors_mm(const BladeType& type, std::size_t count) {
  const std::vector<glm::dvec2> stem = stem_knots(type, count);
  std::vector<float> errors;
  for (const glm::dvec2& at : stem_knots(type, kCurveKnots)) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < stem.size(); ++i) {
      const glm::dvec2 way = stem[i] - stem[i - 1];
      const double share = std::clamp(glm::dot(at - stem[i - 1], way) / glm::dot(way, way), 0.0, 1.0);
      least = std::min(least, glm::length(stem[i - 1] + share * way - at));
    }
    errors.push_back(static_cast<float>(kKnotBlade_mm * least));
  }
  return errors;
}

void add_knot_rows(BenchRegistry& registry) {
  for (const std::size_t knots : kKnotCounts)
    for (const bool greatest : {false, true}) {
      BenchRow row;
      row.id = "grass.knots." + std::to_string(knots) + (greatest ? ".stem_error_max_mm" : ".stem_error_mean_mm");
      row.unit = "mm";
      row.run = [knots, greatest](BenchContext&) -> Result<BenchValue> {
        std::vector<float> errors;
        for (const BladeType& type : builtin_blade_types()) {
          const std::vector<float> some = stem_errors_mm(type, knots);
          errors.insert(errors.end(), some.begin(), some.end());
        }
        const ErrorStatistics error = statistics_of(errors);
        const double value = greatest ? error.max : error.mean;
        return single_value(value, hash_of_number(value));
      };
      registry.add(std::move(row));
    }
}

/// Frames of the usual view with two values of a knob in turn.
struct TwoCosts {
  std::array<std::vector<double>, 2> simulation_ns;
  std::array<std::uint64_t, 2> hashes{};
};

/// Masters by live blades with the level of detail on: the simulation of 1:4 over that of 1:1.
Result<TwoCosts> measure_masters_in_detail(BenchContext& context) {
  const auto grass = GrassCase::open(context, "near", kGrassCostWidth, kGrassCostHeight);
  if (!grass) return grass.error();
  (*grass)->remove_colliders();
  TwoCosts costs;
  constexpr std::array<const char*, 2> kMasters = {"1:4", "1:1"};
  for (int round = -1; round < kGrassCostFrames; ++round)
    for (std::size_t i = 0; i < kMasters.size(); ++i) {
      GLOAM_TRY((*grass)->set("grass.masters", kMasters[i]));
      auto cost = measure_grass_cost(**grass, 2, 2);  // grown anew; then two frames, so that far masters step, too
      if (!cost) return cost.error();
      costs.hashes[i] = cost->hash;
      if (round >= 0) costs.simulation_ns[i].push_back(cost->simulation_ns[0] + cost->simulation_ns[1]);
    }
  return costs;
}

/// The greatest share of masters among the live blades of some views: those that the view simulates.
Result<BenchValue> measure_masters_over_live(BenchContext& context) {
  double greatest = 0.0;
  std::uint64_t hash = 0;
  for (const char* camera : {"near", "far", "ground", "above"}) {
    const auto grass = GrassCase::open(context, camera, kGrassCostWidth, kGrassCostHeight);
    if (!grass) return grass.error();
    const auto reading = (*grass)->draw_and_read(kGrassFrame_s);
    if (!reading) return reading.error();
    const GrassField& field = (*grass)->session().world.resource<GrassField>();
    std::set<std::uint32_t> masters;
    for (const std::uint32_t sorted : reading->blades) {
      const std::uint32_t patch = reading->patches[sorted / GLOAM_GRASS_PATCH_BLADES].patch;
      masters.insert(field.blades[patch * GLOAM_GRASS_PATCH_BLADES + sorted % GLOAM_GRASS_PATCH_BLADES].master);
    }
    const auto live = static_cast<double>(reading->blades.size());
    if (live > 0.0) greatest = std::max(greatest, static_cast<double>(masters.size()) / live);
    hash ^= hash_of_poses(*reading);
  }
  BenchValue value = single_value(greatest, hash);
  value.scene = kMeadow;
  return value;
}

void add_detail_rows(BenchRegistry& registry) {
  BenchRow over;
  over.id = "grass.masters_1_4_over_full.lod";
  over.unit = "ratio";
  over.bar = 0.30;
  over.run = [](BenchContext& context) -> Result<BenchValue> {
    const auto costs = measure_masters_in_detail(context);
    if (!costs) return costs.error();
    BenchValue value = ratio_of(costs->simulation_ns[0], costs->simulation_ns[1], costs->hashes[0]);
    value.scene = kMeadow;
    return value;
  };
  registry.add(std::move(over));
  BenchRow share;
  share.id = "grass.lod.masters_over_live";
  share.unit = "ratio";
  share.bar = 0.25;
  share.run = &measure_masters_over_live;
  registry.add(std::move(share));
}

/// The simulation with one value of a knob, in the usual frame.
void add_setting_row(BenchRegistry& registry, const std::string& knob, const std::string& value) {
  BenchRow row;
  row.id = knob + "." + value + ".simulation_ms";
  row.unit = "ms";
  row.run = [knob, value](BenchContext& context) -> Result<BenchValue> {
    const auto grass = GrassCase::open(context, "near", kGrassCostWidth, kGrassCostHeight);
    if (!grass) return grass.error();
    GLOAM_TRY((*grass)->set(knob, value));
    const auto cost = measure_grass_cost(**grass, kGrassCostWarmUp, kGrassCostFrames);
    if (!cost) return cost.error();
    BenchValue result = per_item(cost->simulation_ns, kNsPerMs, cost->hash);
    result.scene = kMeadow;
    return result;
  };
  registry.add(std::move(row));
}

}  // namespace

void add_grass_cost_benches(BenchRegistry& registry) {
  add_grass_frame_rows(registry);
  add_live_rows(registry);
  add_type_rows(registry);
  add_knot_rows(registry);
  add_detail_rows(registry);
  for (const char* value : {"indirect", "readback"}) add_setting_row(registry, "grass.dispatch", value);
  for (const char* value : {"32", "64", "128", "blade"}) add_setting_row(registry, "grass.group", value);
}

}  // namespace gloam
