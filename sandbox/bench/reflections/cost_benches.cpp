// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/gather_yardstick.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

// Cost of the whole reflection chain: against the gather pass, and against drawing the mirrored scene.

namespace gloam {
namespace {

constexpr int kReflectionCostRounds = 15;
constexpr int kReflectionCostWarmUp = 3;
constexpr std::uint32_t kReflectionCostWidth = 640;  // of the frames that are compared with the gather pass
constexpr std::uint32_t kReflectionCostHeight = 360;

/// Steps of the chain that have rows.
enum ChainStep : std::size_t { kScreenSpace, kProxies, kGlossy, kComposite };
constexpr std::size_t kChainSteps = 4;
constexpr std::size_t kFirstPostStep = kGlossy;
constexpr std::array<const char*, kChainSteps> kReflectionStepNames = {"screen_space", "proxies", "glossy",
                                                                       "composite"};

std::optional<ChainStep> reflection_step_of(std::string_view pass) {
  if (pass.starts_with("reflection_screen_space")) return kScreenSpace;
  if (pass.starts_with("reflection_proxies")) return kProxies;
  if (pass.starts_with("reflection_dilate") || pass.starts_with("reflection_blur")) return kGlossy;
  if (pass.starts_with("reflection_composite")) return kComposite;
  return std::nullopt;
}

struct ReflectionCost {
  std::vector<double> with_ns;  ///< GPU time of whole frames
  std::vector<double> without_ns;
  std::vector<double> gather_ns;
  std::array<std::vector<double>, kChainSteps> step_ns;
  std::vector<double> chain_ns;     ///< all passes of the module
  std::vector<double> lighting_ns;  ///< what the passes of the module lighting take more with reflections
  std::uint64_t hash = 0;           ///< of the light with reflections
  std::uint64_t without_hash = 0;
  std::uint64_t gather_hash = 0;
  std::string scene;
};

Result<double> gather_ns(GatherYardstick& yardstick) {
  const auto start = std::chrono::steady_clock::now();
  GLOAM_TRY(yardstick.draw());
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

void add_steps(ReflectionCost& cost, const FrameSample& sample) {
  std::array<double, kChainSteps> ms{};
  for (const PassTime& pass : sample.report.passes)
    if (const auto step = reflection_step_of(pass.name)) ms[*step] += pass.ms;
  for (std::size_t step = 0; step < kChainSteps; ++step) cost.step_ns[step].push_back(ms[step] * kNsPerMs);
  cost.chain_ns.push_back(reflection_ms(sample) * kNsPerMs);
}

double reflected_lighting_ns(const FrameSample& sample) {
  double ms = 0.0;
  for (const PassTime& pass : sample.report.passes) ms += pass.module == "lighting" ? pass.ms : 0.0;
  return ms * kNsPerMs;
}

Result<FrameSample> draw_mode(ReflectionFrames& frames, const char* mode, std::uint64_t& hash) {
  GLOAM_TRY(frames.set("reflections.mode", mode));
  auto sample = frames.draw();
  if (!sample) return sample.error();
  const auto light = frames.hash();
  if (!light) return light.error();
  hash = *light;
  return sample;
}

/// Frames with reflections, frames without them and gather passes, in turn.
Result<ReflectionCost> measure_reflection_cost(BenchContext& context) {
  ReflectionCost cost;
  cost.scene = courtyard_scene(context).value_or(context.scene_or(kWetStreet));
  auto session = context.open_builtin(cost.scene);
  if (!session) return session.error();
  auto yardstick = GatherYardstick::create(*(*session)->device, kReflectionCostWidth, kReflectionCostHeight);
  if (!yardstick) return yardstick.error();
  ReflectionFrames frames(**session, kReflectionCostWidth, kReflectionCostHeight);
  for (int i = -kReflectionCostWarmUp; i < kReflectionCostRounds; ++i) {
    const auto with = draw_mode(frames, "tiers", cost.hash);
    if (!with) return with.error();
    const auto without = draw_mode(frames, "off", cost.without_hash);
    if (!without) return without.error();
    const auto gather = gather_ns(**yardstick);
    if (!gather) return gather.error();
    if (i < 0) continue;
    add_steps(cost, *with);
    cost.lighting_ns.push_back(reflected_lighting_ns(*with) - reflected_lighting_ns(*without));
    cost.with_ns.push_back(with->report.gpu_ms * kNsPerMs);
    cost.without_ns.push_back(without->report.gpu_ms * kNsPerMs);
    cost.gather_ns.push_back(*gather);
  }
  const auto gathered = (*yardstick)->picture_hash();
  if (!gathered) return gathered.error();
  cost.gather_hash = *gathered;
  return cost;
}

/// GPU time of whole frames that reflections add.
std::vector<double> added_ns(const ReflectionCost& cost) {
  std::vector<double> added;
  for (std::size_t i = 0; i < cost.with_ns.size(); ++i) added.push_back(cost.with_ns[i] - cost.without_ns[i]);
  return added;
}

struct Chain {
  std::vector<double> tiers_ns;   ///< all passes of the module reflections
  std::vector<double> mirror_ns;  ///< the mirrored scene's passes; empty if none was drawn
  std::uint64_t hash = 0;
};

/// Takes the puddles away and covers the road before the camera with wet strips at `planes` heights. The covered area
/// does not depend on their number.
void lay_strips(Session& session, int planes) {
  World& world = session.world;
  std::vector<Entity> puddles;
  world.view<const MeshInstance>().each([&](Entity entity, const MeshInstance&) {
    if (world.resource<SceneNames>().name_of(entity).starts_with("puddle")) puddles.push_back(entity);
  });
  for (const Entity puddle : puddles) world.destroy(puddle);
  constexpr int kStrips = 24;
  constexpr double kFirst_m = 3.0, kLength_m = 0.8, kStep_m = 0.06;
  SceneBuilder builder(world, session.info);
  Material wet{
      .name = "wet strip", .base_color = vec4(0.02f, 0.02f, 0.025f, 1.0f), .metallic = 0.0f, .roughness = 0.05f};
  wet.reflectivity = 1.0f;
  const Primitive slab = box_shape({6.0f, 0.005f, static_cast<float>(kLength_m)});
  const std::uint32_t mesh = builder.add_mesh("wet strip", slab, builder.add_material(wet));
  for (int strip = 0; strip < kStrips; ++strip) {
    const double height = 0.002 + kStep_m * (strip % planes);
    builder.add_instance("", mesh, {0.0, height, kFirst_m - kLength_m * strip});
  }
}

Result<Chain> measure_chain(BenchContext& context, int planes) {
  auto session = context.open_builtin(kWetStreet);
  if (!session) return session.error();
  lay_strips(**session, planes);
  ReflectionFrames frames(**session, context.options().width, context.options().height);
  Chain chain;
  for (int i = -kReflectionCostWarmUp; i < kReflectionCostRounds; ++i) {
    std::uint64_t tiers_hash = 0, planar_hash = 0;
    const auto tiers = draw_mode(frames, "tiers", tiers_hash);
    if (!tiers) return tiers.error();
    const auto planar = draw_mode(frames, "planar", planar_hash);
    if (!planar) return planar.error();
    if (companion_ms(*planar) <= 0.0) return Chain{};
    chain.hash = hash_of_both(tiers_hash, planar_hash);
    if (i < 0) continue;
    chain.tiers_ns.push_back(reflection_ms(*tiers) * kNsPerMs);
    chain.mirror_ns.push_back(companion_ms(*planar) * kNsPerMs);
  }
  return chain;
}

void add_chain_rows(BenchRegistry& registry) {
  for (const int planes : {1, 2, 3}) {
    const auto shared = std::make_shared<Once<Chain>>();
    const std::string suffix = planes == 1 ? "" : ".planes" + std::to_string(planes);
    const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
      BenchRow row;
      row.id = "reflections." + id + suffix;
      row.unit = unit;
      row.bar = bar;
      row.run = [=](BenchContext& context) -> Result<BenchValue> {
        const auto chain = shared->get([&] { return measure_chain(context, planes); });
        if (!chain) return chain.error();
        if ((*chain)->mirror_ns.empty())
          return skipped_row("reflections.mode=planar draws no view of the mirrored scene");
        BenchValue result = value(**chain);
        result.scene = kWetStreet;
        return result;
      };
      registry.add(std::move(row));
    };
    add("chain_over_mirrored_scene", "ratio", 0.5,
        [](const Chain& chain) { return ratio_of(chain.tiers_ns, chain.mirror_ns, chain.hash); });
    add("chain_ms", "ms", std::nullopt,
        [](const Chain& chain) { return per_item(chain.tiers_ns, kNsPerMs, chain.hash); });
    add("mirrored_scene_ms", "ms", std::nullopt,
        [](const Chain& chain) { return per_item(chain.mirror_ns, kNsPerMs, chain.hash); });
  }
}

void add_reflection_frame_rows(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<ReflectionCost>>();
  const auto add = [&](const std::string& id, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = "reflections." + id;
    row.unit = unit;
    row.bar = bar;
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto cost = shared->get([&] { return measure_reflection_cost(context); });
      if (!cost) return cost.error();
      BenchValue result = value(**cost);
      result.scene = (*cost)->scene;
      return result;
    };
    registry.add(std::move(row));
  };
  using C = ReflectionCost;
  const auto hash = [](const C& c) { return hash_of_both(c.hash, c.without_hash); };
  // The goal is 1.0.
  add("frame_over_gathers", "ratio", 1.5,
      [=](const C& c) { return ratio_of(added_ns(c), c.gather_ns, hash_of_both(hash(c), c.gather_hash)); });
  add("frame.added_ms", "ms", std::nullopt, [=](const C& c) { return per_item(added_ns(c), kNsPerMs, hash(c)); });
  add("frame.without_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.without_ns, kNsPerMs, c.without_hash); });
  add("frame.gather48_ms", "ms", std::nullopt,
      [](const C& c) { return per_item(c.gather_ns, kNsPerMs, c.gather_hash); });
  add("frame.chain_ms", "ms", std::nullopt, [](const C& c) { return per_item(c.chain_ns, kNsPerMs, c.hash); });
  add("frame.lighting_growth_ms", "ms", std::nullopt,
      [=](const C& c) { return per_item(c.lighting_ns, kNsPerMs, hash(c)); });
  for (std::size_t step = 0; step < kChainSteps; ++step)
    add(std::string("frame.") + kReflectionStepNames[step] + "_ms", "ms", std::nullopt,
        [step](const C& c) { return per_item(c.step_ns[step], kNsPerMs, c.hash); });
  add("frame.post_processing_ms", "ms", std::nullopt, [](const C& c) {
    // Everything after the two searches.
    std::vector<double> ns(c.chain_ns.size(), 0.0);
    for (std::size_t step = kFirstPostStep; step < kChainSteps; ++step)
      for (std::size_t i = 0; i < ns.size(); ++i) ns[i] += c.step_ns[step][i];
    return per_item(ns, kNsPerMs, c.hash);
  });
}

}  // namespace

void add_reflection_cost_benches(BenchRegistry& registry) {
  add_chain_rows(registry);
  add_reflection_frame_rows(registry);
}

}  // namespace gloam
