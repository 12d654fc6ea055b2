// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

// The reflection chain with tiers against planar reflections, over the number of reflecting planes.
// - chain_over_mirrored_scene: all passes of the module over the passes that draw the mirrored scene alone.
// - tiers_over_planar: whole against whole. The yardstick is what planar reflections of all planes would cost: the
//   passes of the module in the main view, once, and a mirrored view for each plane. The renderer mirrors at one plane
//   only, so both are those of the scene with one plane, whose strips cover the same area, and the mirrored view counts
//   once for each plane.

namespace gloam {
namespace {

constexpr int kChainRounds = 15;
constexpr int kChainWarmUp = 3;
constexpr int kMostPlanes = 3;
/// Of tiers_over_planar, for one, two and three planes: the chain should not depend on their number.
constexpr std::array<double, kMostPlanes> kTiersBars = {0.5, 0.3, 0.2};

struct Chain {
  std::vector<double> tiers_ns;       ///< all passes of the module reflections
  std::vector<double> planar_ns;      ///< the same with reflections.mode=planar, without the mirrored scene
  std::vector<double> mirror_ns;      ///< the mirrored scene's passes; empty if none was drawn
  std::vector<double> all_planes_ns;  ///< planar reflections of all planes
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

Result<std::unique_ptr<Session>> open_strips(BenchContext& context, int planes) {
  auto session = context.open_builtin(kWetStreet);
  if (session) lay_strips(**session, planes);
  return session;
}

/// Frames with tiers, frames with one plane's planar reflections, and those of the scene with one plane, in turn.
Result<Chain> measure_chain(BenchContext& context, int planes) {
  const auto session = open_strips(context, planes);
  if (!session) return session.error();
  ReflectionFrames frames(**session, context.options().width, context.options().height);
  std::unique_ptr<Session> one_plane;
  std::optional<ReflectionFrames> one_frames;
  if (planes > 1) {
    auto opened = open_strips(context, 1);
    if (!opened) return opened.error();
    one_plane = std::move(opened).value();
    one_frames.emplace(*one_plane, context.options().width, context.options().height);
  }
  Chain chain;
  for (int i = -kChainWarmUp; i < kChainRounds; ++i) {
    std::uint64_t tiers_hash = 0, planar_hash = 0, one_hash = 0;
    const auto tiers = draw_in_mode(frames, "tiers", tiers_hash);
    if (!tiers) return tiers.error();
    const auto planar = draw_in_mode(frames, "planar", planar_hash);
    if (!planar) return planar.error();
    const auto one = one_frames ? draw_in_mode(*one_frames, "planar", one_hash) : planar;
    if (!one) return one.error();
    if (companion_ms(*planar) <= 0.0 || companion_ms(*one) <= 0.0) return Chain{};
    chain.hash = hash_of_both(tiers_hash, hash_of_both(planar_hash, one_hash));
    if (i < 0) continue;
    chain.tiers_ns.push_back(reflection_ms(*tiers) * kNsPerMs);
    chain.planar_ns.push_back(reflection_ms(*planar) * kNsPerMs);
    chain.mirror_ns.push_back(companion_ms(*planar) * kNsPerMs);
    chain.all_planes_ns.push_back((reflection_ms(*one) + planes * companion_ms(*one)) * kNsPerMs);
  }
  return chain;
}

void add_chain_rows(BenchRegistry& registry, int planes) {
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
  add("tiers_over_planar", "ratio", kTiersBars[static_cast<std::size_t>(planes - 1)],
      [](const Chain& chain) { return ratio_of(chain.tiers_ns, chain.all_planes_ns, chain.hash); });
  add("chain_over_mirrored_scene", "ratio", 0.5,
      [](const Chain& chain) { return ratio_of(chain.tiers_ns, chain.mirror_ns, chain.hash); });
  add("chain_ms", "ms", std::nullopt,
      [](const Chain& chain) { return per_item(chain.tiers_ns, kNsPerMs, chain.hash); });
  add("planar_chain_ms", "ms", std::nullopt,
      [](const Chain& chain) { return per_item(chain.planar_ns, kNsPerMs, chain.hash); });
  add("mirrored_scene_ms", "ms", std::nullopt,
      [](const Chain& chain) { return per_item(chain.mirror_ns, kNsPerMs, chain.hash); });
}

}  // namespace

void add_reflection_chain_benches(BenchRegistry& registry) {
  for (int planes = 1; planes <= kMostPlanes; ++planes) add_chain_rows(registry, planes);
}

}  // namespace gloam
