// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"

namespace gloam {
namespace {

// Scenes unless the user names one: about as many shadowed lights a tile as in the paper, and eight close-up pairs.
constexpr const char* kDeferredScene = "builtin:shadow_grid";
constexpr const char* kSubjectsScene = "builtin:closeups";
constexpr int kDeferredRounds = 11;
constexpr int kDeferredWarmUp = 2;

enum DeferredWay : std::size_t { kMono, kPlain, kTiles, kPairs };
constexpr std::array<ShadowVariant, 4> kDeferredWays = {kMonolithic, kUnclassified, kClassified, kWithCloseups};

struct DeferredWayCost {
  std::vector<double> total_ns;
  std::vector<double> all_ns;  ///< total_ns and the maps of close-up pairs
  std::array<std::vector<double>, kShadowPhases> phase_ns;
  Picture picture;
  std::uint64_t hash = 0;
  FrameReport report;  ///< of the last frame
};
using DeferredWayCosts = std::array<DeferredWayCost, kDeferredWays.size()>;

Status add_deferred_frame(ShadowCase& shadows, const ShadowVariant& way, bool counts, DeferredWayCost& cost) {
  auto sample = draw_settled(shadows, way);
  if (!sample) return sample.error();
  if (!counts) return {};
  const PhaseTimes times = phase_times(sample->report);
  cost.total_ns.push_back(times.total() * kNsPerMs);
  cost.all_ns.push_back((times.total() + closeup_map_ms(sample->report)) * kNsPerMs);
  for (std::size_t i = 0; i < kShadowPhases; ++i) cost.phase_ns[i].push_back(times.ms[i] * kNsPerMs);
  cost.report = std::move(sample->report);
  return {};
}

/// Measures all ways alternately, with one camera at rest: shadow maps are drawn once, before the first counted frame.
Result<DeferredWayCosts> measure_deferred_ways(Session& session, const Options& options) {
  DeferredWayCosts costs;
  ShadowCase shadows(session, options.width, options.height);
  for (int round = -kDeferredWarmUp; round < kDeferredRounds; ++round)
    for (std::size_t way = 0; way < kDeferredWays.size(); ++way)
      GLOAM_TRY(add_deferred_frame(shadows, kDeferredWays[way], round >= 0, costs[way]));
  for (std::size_t way = 0; way < kDeferredWays.size(); ++way) {
    GLOAM_TRY(draw_settled(shadows, kDeferredWays[way]));
    auto picture = shadows.picture();
    if (!picture) return picture.error();
    costs[way].hash = hash_bytes(std::as_bytes(std::span(picture->rgba)));
    costs[way].picture = std::move(*picture);
  }
  return costs;
}

/// Largest difference over all channels, in steps of 1/255.
double largest_difference(const Picture& a, const Picture& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  return largest;
}

/// Share of pixels without any difference.
double equal_share(const Picture& a, const Picture& b) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    equal += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 1 : 0;
  return static_cast<double>(equal) / std::max(1.0, static_cast<double>(a.rgba.size() / 4));
}

/// A scene and what was measured in it.
struct DeferredCase {
  const char* scene;
  Once<DeferredWayCosts> costs;
};
using SharedDeferred = std::shared_ptr<DeferredCase>;

template <class Value>
BenchRow way_row(std::string id, std::string unit, SharedDeferred shared, Value value) {
  BenchRow row;
  row.id = "shadows." + std::move(id);
  row.unit = std::move(unit);
  row.run = [shared = std::move(shared), value](BenchContext& context) -> Result<BenchValue> {
    const auto costs = shared->costs.get([&]() -> Result<DeferredWayCosts> {
      auto session = context.session_or(shared->scene);
      if (!session) return session.error();
      return measure_deferred_ways(**session, context.options());
    });
    if (!costs) return costs.error();
    BenchValue result = value(**costs);
    result.scene = context.scene_or(shared->scene);
    return result;
  };
  return row;
}

/// Hash of the pictures of a way and of the monolithic one.
std::uint64_t hash_beside_monolithic(const DeferredWayCosts& costs, DeferredWay way) {
  return hash_of_both(costs[way].hash, costs[kMono].hash);
}

void add_deferred_ratio(BenchRegistry& registry, const SharedDeferred& shared, const char* id, DeferredWay way,
                        std::optional<double> bar) {
  BenchRow row = way_row(std::string("table1.") + id, "ratio", shared, [way](const DeferredWayCosts& c) {
    return ratio_of(c[way].total_ns, c[kMono].total_ns, hash_beside_monolithic(c, way));
  });
  row.bar = bar;
  registry.add(std::move(row));
}

/// Adds the rows of deferred shadows with close-ups and everything that close-ups take: their maps are drawn and
/// resolved in every frame, and the paper's figure includes that.
void add_rows_with_closeup_maps(BenchRegistry& registry, const SharedDeferred& shared) {
  registry.add(way_row("table1.deferred_8_closeups_all", "ms", shared,
                       [](const DeferredWayCosts& c) { return per_item(c[kPairs].all_ns, kNsPerMs, c[kPairs].hash); }));
  BenchRow ratio =
      way_row("table1.deferred_8_closeups_all_over_monolithic", "ratio", shared, [](const DeferredWayCosts& c) {
        return ratio_of(c[kPairs].all_ns, c[kMono].total_ns, hash_beside_monolithic(c, kPairs));
      });
  ratio.bar = 0.9;
  registry.add(std::move(ratio));
}

/// Adds a figure of the paper, measured on a console: only its ratios can be compared with ours. Nothing is computed,
/// so there is no hash.
void add_paper_row(BenchRegistry& registry, const char* id, const char* unit, double value) {
  BenchRow row;
  row.id = std::string("shadows.table1.paper.") + id;
  row.unit = unit;
  row.run = [value](BenchContext&) -> Result<BenchValue> {
    BenchValue constant;
    constant.value = value;
    return constant;
  };
  registry.add(std::move(row));
}

void add_deferred_table(BenchRegistry& registry, const SharedDeferred& shared) {
  constexpr std::pair<const char*, DeferredWay> kColumns[] = {
      {"monolithic", kMono}, {"deferred_unclassified", kPlain}, {"deferred", kTiles}, {"deferred_8_closeups", kPairs}};
  for (const auto& [name, way] : kColumns)
    registry.add(way_row(std::string("table1.") + name, "ms", shared, [way = way](const DeferredWayCosts& c) {
      return per_item(c[way].total_ns, kNsPerMs, c[way].hash);
    }));
  add_deferred_ratio(registry, shared, "deferred_unclassified_over_monolithic", kPlain, std::nullopt);
  add_deferred_ratio(registry, shared, "deferred_over_monolithic", kTiles, 0.5);
  add_deferred_ratio(registry, shared, "deferred_8_closeups_over_monolithic", kPairs, std::nullopt);
  add_rows_with_closeup_maps(registry, shared);
  add_paper_row(registry, "monolithic", "ms on a console", 5.73);
  add_paper_row(registry, "deferred", "ms on a console", 3.94);
  add_paper_row(registry, "deferred_8_closeups", "ms on a console", 6.29);
  add_paper_row(registry, "deferred_over_monolithic", "ratio on a console", 3.94 / 5.73);
  constexpr std::pair<const char*, DeferredWay> kHeld[] = {{"deferred_unclassified", kPlain}, {"deferred", kTiles}};
  for (const auto& [name, way] : kHeld) {
    BenchRow difference =
        way_row(std::string("table1.") + name + "_difference", "1/255", shared, [way = way](const DeferredWayCosts& c) {
          return single_value(largest_difference(c[kMono].picture, c[way].picture), hash_beside_monolithic(c, way));
        });
    difference.bar = 1.0;
    registry.add(std::move(difference));
    registry.add(way_row(std::string("table1.") + name + "_equal_pixels", "share of pixels", shared,
                         [way = way](const DeferredWayCosts& c) {
                           return single_value(equal_share(c[kMono].picture, c[way].picture),
                                               hash_beside_monolithic(c, way));
                         }));
  }
  registry.add(way_row("table1.closeup_pairs", "pairs", shared, [](const DeferredWayCosts& c) {
    return single_value(counter_of(c[kPairs].report, "closeups.pairs"), c[kPairs].hash);
  }));
  registry.add(way_row("table1.lights_a_tile", "lights", shared, [](const DeferredWayCosts& c) {
    return single_value(counter_of(c[kTiles].report, "lights.per_tile_accurate_mean"), c[kTiles].hash);
  }));
}

/// Columns of FF table 1. Without deferred shadows, filtering is part of lighting.
struct Table1Columns {
  std::vector<double> shadow_ns, closeup_ns, lighting_ns;
};

Table1Columns columns_of(const DeferredWayCost& cost) {
  const auto phase = [&](ShadowPhase of) -> const std::vector<double>& {
    return cost.phase_ns[static_cast<std::size_t>(of)];
  };
  Table1Columns columns = {{}, {}, phase(ShadowPhase::lighting)};
  for (std::size_t i = 0; i < cost.total_ns.size(); ++i) {
    columns.closeup_ns.push_back(phase(ShadowPhase::closeups)[i] + cost.all_ns[i] - cost.total_ns[i]);
    columns.shadow_ns.push_back(cost.all_ns[i] - columns.closeup_ns[i] - columns.lighting_ns[i]);
  }
  return columns;
}

/// stem: ids begin with it.
void add_columns(BenchRegistry& registry, const std::string& stem, const SharedDeferred& shared) {
  constexpr std::pair<const char*, DeferredWay> kRows[] = {
      {"monolithic", kMono}, {"deferred", kTiles}, {"deferred_8_closeups", kPairs}};
  constexpr std::pair<const char*, std::vector<double> Table1Columns::*> kColumns[] = {
      {".shadow", &Table1Columns::shadow_ns},
      {".closeup", &Table1Columns::closeup_ns},
      {".lighting", &Table1Columns::lighting_ns}};
  for (const auto& [name, way] : kRows) {
    const std::string id = stem + name;
    for (const auto& [column, times] : kColumns)
      registry.add(way_row(id + column, "ms", shared, [way = way, times = times](const DeferredWayCosts& c) {
        return per_item(columns_of(c[way]).*times, kNsPerMs, c[way].hash);
      }));
    registry.add(way_row(id + ".total", "ms", shared, [way = way](const DeferredWayCosts& c) {
      return per_item(c[way].all_ns, kNsPerMs, c[way].hash);
    }));
    registry.add(way_row(id + ".over_monolithic", "ratio", shared, [way = way](const DeferredWayCosts& c) {
      return ratio_of(c[way].all_ns, c[kMono].all_ns, hash_beside_monolithic(c, way));
    }));
  }
}

void add_shares(BenchRegistry& registry, const SharedDeferred& shared) {
  for (std::size_t i = 0; i < kShadowPhases; ++i)
    registry.add(way_row(std::string("figure13.") + kShadowPhaseNames[i], "share of deferred", shared,
                         [i](const DeferredWayCosts& c) {
                           return ratio_of(c[kTiles].phase_ns[i], c[kTiles].total_ns, c[kTiles].hash);
                         }));
  constexpr std::array<std::pair<const char*, const char*>, 6> kCounters = {
      {{"unshadowed", "shadows.tile_lights_unshadowed"},
       {"lit_at_once", "shadows.tile_lights_lit"},
       {"unlit_at_once", "shadows.tile_lights_unlit"},
       {"filtered_lit", "shadows.tile_lights_filtered_lit"},
       {"filtered_unlit", "shadows.tile_lights_filtered_unlit"},
       {"slot", "shadows.slots"}}};
  for (const auto& [name, counter] : kCounters)
    registry.add(way_row(std::string("tile_lights.") + name, "share of tiles' lights", shared,
                         [counter = counter](const DeferredWayCosts& c) {
                           const double all = counter_of(c[kTiles].report, "shadows.tile_lights");
                           return single_value(counter_of(c[kTiles].report, counter) / std::max(all, 1.0),
                                               c[kTiles].hash);
                         }));
}

/// The columns of FF table 1 in a scene with close-up subjects.
void add_rows_with_subjects(BenchRegistry& registry) {
  const auto shared = std::make_shared<DeferredCase>(kSubjectsScene);
  add_columns(registry, "table1.subjects.", shared);
  registry.add(
      way_row("table1.subjects.deferred_8_closeups.over_deferred", "ratio", shared, [](const DeferredWayCosts& c) {
        return ratio_of(c[kPairs].all_ns, c[kTiles].all_ns, hash_of_both(c[kPairs].hash, c[kTiles].hash));
      }));
  registry.add(way_row("table1.subjects.closeup_pairs", "pairs", shared, [](const DeferredWayCosts& c) {
    return single_value(counter_of(c[kPairs].report, "closeups.pairs"), c[kPairs].hash);
  }));
  registry.add(way_row("table1.subjects.lights_a_tile", "lights", shared, [](const DeferredWayCosts& c) {
    return single_value(counter_of(c[kTiles].report, "lights.per_tile_accurate_mean"), c[kTiles].hash);
  }));
}

}  // namespace

void add_shadow_deferred_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<DeferredCase>(kDeferredScene);
  add_deferred_table(registry, shared);
  add_columns(registry, "table1.columns.", shared);
  add_shares(registry, shared);
  add_rows_with_subjects(registry);
}

}  // namespace gloam
