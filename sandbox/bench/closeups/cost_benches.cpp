// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/assets.h"
#include "sandbox/bench/closeups/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/lamps/closeups.h"

// Cost of close-ups: memory by number of pairs (FF §3), time by step (FF figure 14), and time by number of pairs in a
// batch.

namespace gloam {
namespace {

constexpr int kCloseUpRounds = 11;
constexpr int kCloseUpWarmUp = 2;
/// For the built-in scene: copies of standard maps need as much room again, and a pair whose copies find no room is not
/// drawn.
constexpr const char* kDensity = "1";
constexpr const char* kAtlas = "8192";

enum Step : std::size_t { kDraw, kResolve, kCompose, kTransfer };
constexpr std::size_t kCloseUpSteps = 4;
constexpr std::array<const char*, kCloseUpSteps> kCloseUpStepNames = {"draw", "resolve", "compose", "transfer"};

/// Passes for forward-lit surfaces count as transfer, copies of faces included.
std::optional<Step> close_up_step_of(const PassTime& pass) {
  if (pass.name == "shadow_map_closeup") return kDraw;
  if (pass.name == "shadow_map_closeup_mips") return kResolve;
  if (pass.name == "closeup_compose" || pass.name.starts_with("closeup_tiles")) return kCompose;
  if (pass.module == "closeups" || pass.name.starts_with("shadow_overlay")) return kTransfer;
  return std::nullopt;
}

using StepTimes = std::array<double, kCloseUpSteps>;
StepTimes step_ns(const FrameReport& report) {
  StepTimes ns{};
  for (const PassTime& pass : report.passes)
    if (const auto step = close_up_step_of(pass)) ns[*step] += pass.ms * kNsPerMs;
  return ns;
}

/// Ways to draw eight pairs.
enum CloseUpWay : std::size_t { kBatch1, kBatch2, kBatch4, kStandardDrawn };
struct WayKnobs {
  const char* batch;
  const char* standard;
};
constexpr std::array<WayKnobs, 4> kCloseUpWays = {
    {{"1", "transfer"}, {"2", "transfer"}, {"4", "transfer"}, {"1", "draw"}}};

struct CloseUpWayCost {
  std::vector<double> total_ns;
  std::array<std::vector<double>, kCloseUpSteps> step_ns;
  double pairs = 0.0;      ///< pairs drawn in the last frame
  std::uint64_t hash = 0;  ///< of the picture of the last frame
};
using CloseUpWayCosts = std::array<CloseUpWayCost, kCloseUpWays.size()>;

/// Adds a window pane in front of the scene: a forward-lit surface, for which standard maps must hold the subjects.
void add_pane(Session& session) {
  SceneBuilder builder(session.world, session.info);
  const std::uint32_t glass = builder.add_material({.name = "pane",
                                                    .base_color = vec4(0.8f, 0.9f, 0.9f, 0.2f),
                                                    .metallic = 0.0f,
                                                    .roughness = 0.3f,
                                                    .alpha_mode = AlphaMode::blend});
  builder.add_instance("pane", builder.add_mesh("pane", box_shape({0.8f, 0.8f, 0.01f}), glass), {1.6, 0.0, 2.2});
}

Status leave_room_for_copies(ShadowCase& shadows) {
  GLOAM_TRY(shadows.set("shadows.atlas", kAtlas));
  return shadows.set("shadows.texels_per_pixel", kDensity);
}

Result<FrameSample> draw_way(ShadowCase& shadows, const WayKnobs& way) {
  GLOAM_TRY(shadows.set("closeups.batch", way.batch));
  GLOAM_TRY(shadows.set("closeups.standard", way.standard));
  return draw_settled(shadows, kWithCloseups);
}

/// Measures all ways alternately, with one camera at rest.
Result<CloseUpWayCosts> measure_close_up_ways(Session& session, const Options& options) {
  ShadowCase shadows(session, options.width, options.height);
  if (options.scene_is_default) GLOAM_TRY(leave_room_for_copies(shadows));
  CloseUpWayCosts costs;
  for (int round = -kCloseUpWarmUp; round < kCloseUpRounds; ++round) {
    for (std::size_t way = 0; way < kCloseUpWays.size(); ++way) {
      const auto sample = draw_way(shadows, kCloseUpWays[way]);
      if (!sample) return sample.error();
      if (round < 0) continue;
      const StepTimes ns = step_ns(sample->report);
      for (std::size_t step = 0; step < kCloseUpSteps; ++step) costs[way].step_ns[step].push_back(ns[step]);
      costs[way].total_ns.push_back(std::accumulate(ns.begin(), ns.end(), 0.0));
      costs[way].pairs = counter_of(sample->report, "closeups.pairs");
      if (round + 1 < kCloseUpRounds) continue;
      const auto hash = shadows.picture_hash();
      if (!hash) return hash.error();
      costs[way].hash = *hash;
    }
  }
  return costs;
}

Result<CloseUpWayCosts> measure_close_up_ways(BenchContext& context) {
  auto opened = open_closeups(context, kCloseupFigures);
  if (!opened) return opened.error();
  if (opened->own != nullptr) add_pane(*opened->session);
  return measure_close_up_ways(*opened->session, context.options());
}

using SharedWays = std::shared_ptr<Once<CloseUpWayCosts>>;

template <class Value>
void add_way_row(BenchRegistry& registry, const SharedWays& shared, const std::string& id, const char* unit,
                 Value value) {
  BenchRow row;
  row.id = "closeups." + id;
  row.unit = unit;
  row.run = [shared, value](BenchContext& context) -> Result<BenchValue> {
    const auto costs = shared->get([&] { return measure_close_up_ways(context); });
    if (!costs) return costs.error();
    BenchValue result = value(**costs);
    result.scene = context.scene_or(kCloseupScene);
    return result;
  };
  registry.add(std::move(row));
}

void add_time_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<CloseUpWayCosts>>();
  for (std::size_t i = 0; i < kCloseUpSteps; ++i)
    add_way_row(registry, shared, std::string("figure14.") + kCloseUpStepNames[i], "share of a pair",
                [i](const CloseUpWayCosts& c) {
                  return ratio_of(c[kBatch1].step_ns[i], c[kBatch1].total_ns, c[kBatch1].hash);
                });
  add_way_row(registry, shared, "pair_ms", "ms a pair", [](const CloseUpWayCosts& c) {
    return per_item(c[kBatch1].total_ns, kNsPerMs * std::max(1.0, c[kBatch1].pairs), c[kBatch1].hash);
  });
  add_way_row(registry, shared, "drawn_pairs", "pairs",
              [](const CloseUpWayCosts& c) { return single_value(c[kBatch1].pairs, c[kBatch1].hash); });
  const auto add_way = [&](const std::string& id, CloseUpWay way) {
    add_way_row(registry, shared, id, "ms",
                [way](const CloseUpWayCosts& c) { return per_item(c[way].total_ns, kNsPerMs, c[way].hash); });
  };
  const auto add_ratio = [&](const std::string& id, CloseUpWay way) {
    add_way_row(registry, shared, id, "ratio", [way](const CloseUpWayCosts& c) {
      return ratio_of(c[way].total_ns, c[kBatch1].total_ns, hash_of_both(c[way].hash, c[kBatch1].hash));
    });
  };
  add_way("batch.1", kBatch1);
  add_way("batch.2", kBatch2);
  add_way("batch.4", kBatch4);
  add_ratio("batch.2_over_1", kBatch2);
  add_ratio("batch.4_over_1", kBatch4);
  add_way("standard.transfer", kBatch1);
  add_way("standard.draw", kStandardDrawn);
  add_ratio("standard.draw_over_transfer", kStandardDrawn);
}

struct CloseUpMemory {
  double bytes = 0.0;             ///< GPU memory of module closeups
  double visibility_bytes = 0.0;  ///< memory of visibility slots, of all shadows
  double pairs = 0.0;             ///< pairs drawn
  std::uint64_t hash = 0;         ///< of the picture
};
constexpr std::array<const char*, 3> kMemoryPairs = {"1", "8", "64"};
using Memories = std::array<CloseUpMemory, kMemoryPairs.size()>;

/// Measures settled frames of the built-in scene without forward-lit surfaces, after idle memory has been freed.
Result<CloseUpMemory> measure_close_up_memory(BenchContext& context, const char* pairs) {
  auto session = context.open_builtin(kCloseupScene);
  if (!session) return session.error();
  ShadowCase shadows(**session, context.options().width, context.options().height);
  GLOAM_TRY(leave_room_for_copies(shadows));
  const ShadowVariant variant{"deferred", "on", pairs};
  if (auto frame = draw_settled(shadows, variant); !frame) return frame.error();
  (*session)->renderer->free_idle_memory();
  const auto frame = draw_settled(shadows, variant);
  if (!frame) return frame.error();
  CloseUpMemory memory;
  for (const ModuleState& module : frame->report.modules)
    if (module.name == "closeups") memory.bytes = static_cast<double>(module.gpu_bytes);
  memory.visibility_bytes = counter_of(frame->report, "shadows.visibility_bytes");
  memory.pairs = counter_of(frame->report, "closeups.pairs");
  const auto hash = shadows.picture_hash();
  if (!hash) return hash.error();
  memory.hash = *hash;
  return memory;
}

Result<Memories> measure_memories(BenchContext& context) {
  Memories memories;
  for (std::size_t i = 0; i < memories.size(); ++i) {
    const auto memory = measure_close_up_memory(context, kMemoryPairs[i]);
    if (!memory) return memory.error();
    memories[i] = *memory;
  }
  return memories;
}

void add_memory_rows(BenchRegistry& registry) {
  constexpr double kMiB = 1048576.0;
  constexpr double kEqual = 1.001;
  const auto shared = std::make_shared<Once<Memories>>();
  const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar,
                       std::function<BenchValue(const Memories&)> value) {
    BenchRow row;
    row.id = "closeups." + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [shared, value = std::move(value)](BenchContext& context) -> Result<BenchValue> {
      const auto memories = shared->get([&] { return measure_memories(context); });
      if (!memories) return memories.error();
      BenchValue result = value(**memories);
      result.scene = kCloseupScene;
      return result;
    };
    registry.add(std::move(row));
  };
  const auto add_ratio = [&](const std::string& id, std::size_t i) {
    add(id, "ratio", kEqual, [i](const Memories& m) {
      return single_value(m[i].bytes / std::max(m[0].bytes, 1.0), hash_of_both(m[i].hash, m[0].hash));
    });
  };
  add_ratio("memory_64_over_1", 2);
  add_ratio("memory_8_over_1", 1);
  for (std::size_t i = 0; i < kMemoryPairs.size(); ++i) {
    const std::string pairs = kMemoryPairs[i];
    add("memory_mib." + pairs, "MiB", std::nullopt,
        [i](const Memories& m) { return single_value(m[i].bytes / kMiB, m[i].hash); });
    add("memory_visibility_mib." + pairs, "MiB", std::nullopt,
        [i](const Memories& m) { return single_value(m[i].visibility_bytes / kMiB, m[i].hash); });
    add("memory_pairs." + pairs, "pairs", std::nullopt,
        [i](const Memories& m) { return single_value(m[i].pairs, m[i].hash); });
  }
}

}  // namespace

void add_closeup_cost_benches(BenchRegistry& registry) {
  add_memory_rows(registry);
  add_time_rows(registry);
}

}  // namespace gloam
