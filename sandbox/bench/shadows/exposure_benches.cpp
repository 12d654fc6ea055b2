// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/shadows/components.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/phases.h"
#include "sandbox/bench/shadows/variant.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/lamps/penumbra.h"

// Thief, section 1.3: the cost of contact hardening depends on the share of the picture that is in shadow, and on the
// size of the shadow map. One wide lamp above a floor; bars between them whose penumbrae overlap cover a part of the
// picture from the left, so that every pixel of that part needs the whole filter. Seen from below the bars. Times are
// of everything from light lists to shaded visibility; drawing the map is left out, as in the paper.

namespace gloam {
namespace {

constexpr const char* kExposureScene = "builtin:penumbra";
constexpr int kExposureRounds = 9;
constexpr int kExposureWarmUp = 1;
constexpr std::array<int, 4> kExposureShares = {0, 25, 50, 100};            // percent of the picture
constexpr std::array<std::uint32_t, 4> kMapSides = {256, 512, 1024, 2048};  // texels of the map's side
constexpr std::uint32_t kMapOfShares = 1024;
constexpr double kEye_m = 0.9, kBars_m = 1.0, kFieldOfView = 0.8;  // heights above the floor; the scene camera's lens

struct Exposure {
  std::vector<double> shadow_ns;
  double shadowed = 0.0;  ///< share of pixels that see less than the whole lamp
  std::uint64_t hash = 0;
};

/// Replaces the scene's sheet by bars over a share of the picture, and narrows the lamp's cone. Returns the lamp.
Entity lay_bars(Session& session, double share, double aspect) {
  constexpr std::uint32_t kSheetMesh = 1;  // after the floor
  Entity sheet = kNoEntity, lamp = kNoEntity;
  session.world.view<const MeshInstance>().each([&](Entity entity, const MeshInstance& mesh) {
    if (mesh.mesh == kSheetMesh) sheet = entity;
  });
  session.world.view<Light>().each([&](Entity entity, Light& light) {
    lamp = entity;
    // Just wider than the picture: a texel of the smallest map is a fifth of a bar.
    light.inner_angle = 0.075f;
    light.outer_angle = 0.08f;
  });
  session.world.destroy(sheet);
  if (share <= 0.0) return lamp;
  SceneBuilder builder(session.world, session.info);
  const std::uint32_t wood = builder.add_material({.name = "bars", .metallic = 0.0f, .roughness = 0.9f});
  const std::uint32_t bar = builder.add_mesh("bar", box_shape({0.02f, 0.01f, 3.0f}), wood);
  // Shadows on the floor are wider than the bars, as both are seen from the lamp. Beyond the picture's sides, a
  // picture's width more.
  const double width = 2.0 * kEye_m * std::tan(0.5 * kFieldOfView) * aspect;
  const double grow = kPenumbraLampHeight_m / (kPenumbraLampHeight_m - kBars_m);
  const double first = -width, last = (share - 0.5) * width / grow + (share < 1.0 ? 0.0 : width);
  for (double x = first; x < last; x += 0.08) builder.add_instance("bar", bar, {x, kBars_m, 0.0});
  return lamp;
}

Result<Exposure> measure_exposure(BenchContext& context, double share, std::uint32_t texels) {
  auto opened = context.open_builtin(kExposureScene);
  if (!opened) return opened.error();
  Session& session = **opened;
  const Options& options = context.options();
  const Entity lamp = lay_bars(session, share, static_cast<double>(options.width) / options.height);
  session.world.add(lamp, ShadowCaster{.resolution = texels});
  ShadowCase shadows(session, options.width, options.height);
  // Straight down: the camera's -Z is the world's -Y.
  const dmat4 down =
      glm::rotate(glm::translate(dmat4(1.0), dvec3(0.0, kEye_m, 0.0)), -0.5 * std::numbers::pi, dvec3(1.0, 0.0, 0.0));
  shadows.look_from(down);
  Exposure exposure;
  for (int round = -kExposureWarmUp; round < kExposureRounds; ++round) {
    const auto sample = draw_settled(shadows, kClassified);
    if (!sample) return sample.error();
    if (round < 0) continue;
    const PhaseTimes times = phase_times(sample->report);
    exposure.shadow_ns.push_back((times.total() - times.of(ShadowPhase::lighting)) * kNsPerMs);
  }
  const auto hash = shadows.picture_hash();
  if (!hash) return hash.error();
  exposure.hash = *hash;
  const auto seen = shadows.drawn(lamp);
  if (!seen) return seen.error();
  const auto in_shadow = std::ranges::count_if(*seen, [](float visibility) { return visibility < 1.0f; });
  exposure.shadowed = static_cast<double>(in_shadow) / std::max(1.0, static_cast<double>(seen->size()));
  return exposure;
}

using SharedExposure = std::shared_ptr<Once<Exposure>>;

/// value: of the exposure. share: 0 to 1.
template <class Value>
void add_exposure_row(BenchRegistry& registry, const SharedExposure& shared, std::string id, const char* unit,
                      double share, std::uint32_t texels, Value value) {
  BenchRow row;
  row.id = "shadows.exposure." + std::move(id);
  row.unit = unit;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    const auto exposure = shared->get([&] { return measure_exposure(context, share, texels); });
    if (!exposure) return exposure.error();
    BenchValue result = value(**exposure);
    result.scene = kExposureScene;
    return result;
  };
  registry.add(std::move(row));
}

void add_time_and_share(BenchRegistry& registry, const SharedExposure& shared, const std::string& id, double share,
                        std::uint32_t texels) {
  add_exposure_row(registry, shared, id + ".ms", "ms", share, texels,
                   [](const Exposure& e) { return per_item(e.shadow_ns, kNsPerMs, e.hash); });
  add_exposure_row(registry, shared, id + ".shadowed", "share of pixels", share, texels,
                   [](const Exposure& e) { return single_value(e.shadowed, e.hash); });
}

}  // namespace

void add_shadow_exposure_benches(BenchRegistry& registry) {
  std::array<SharedExposure, kExposureShares.size()> by_share;
  for (std::size_t i = 0; i < kExposureShares.size(); ++i) {
    by_share[i] = std::make_shared<Once<Exposure>>();
    add_time_and_share(registry, by_share[i], "share." + std::to_string(kExposureShares[i]), 0.01 * kExposureShares[i],
                       kMapOfShares);
  }
  BenchRow ratio;
  ratio.id = "shadows.exposure.share.0_over_100";
  ratio.unit = "ratio";
  ratio.run = [by_share](BenchContext& context) -> Result<BenchValue> {
    const auto none = by_share.front()->get([&] { return measure_exposure(context, 0.0, kMapOfShares); });
    if (!none) return none.error();
    const auto all = by_share.back()->get([&] { return measure_exposure(context, 1.0, kMapOfShares); });
    if (!all) return all.error();
    BenchValue result = ratio_of((*none)->shadow_ns, (*all)->shadow_ns, hash_of_both((*none)->hash, (*all)->hash));
    result.scene = kExposureScene;
    return result;
  };
  registry.add(std::move(ratio));
  for (const std::uint32_t texels : kMapSides)
    add_time_and_share(registry, texels == kMapOfShares ? by_share.back() : std::make_shared<Once<Exposure>>(),
                       "map." + std::to_string(texels), 1.0, texels);
}

}  // namespace gloam
