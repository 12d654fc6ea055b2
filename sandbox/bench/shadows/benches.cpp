// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"

namespace gloam {
namespace {

constexpr const char* kShadowScene = "builtin:shadows";  // unless the user names one
// Size of the pictures that are compared with rays for every light and pixel. It does not depend on the size of timed
// frames.
constexpr std::uint32_t kErrorWidth = 320;
constexpr std::uint32_t kErrorHeight = 180;
constexpr int kShadowPairs = 9;
constexpr int kShadowWarmUp = 2;

/// A shadow filter and its knobs.
struct Lookup {
  const char* name;
  const char* filter;
  const char* mips;
};
constexpr std::array<Lookup, 5> kLookups = {{{"hard", "hard", "on"},
                                             {"pcf", "pcf", "on"},
                                             {"pcss", "pcss", "on"},
                                             {"chs", "chs", "on"},
                                             {"chs_without_mips", "chs", "off"}}};

struct LookupCost {
  std::vector<double> shadows_ns;  ///< shading time beyond that without shadows
  std::vector<double> shading_ns;
  JudgedShadows error;
  std::uint64_t hash = 0;          ///< of the picture with shadows
  std::uint64_t without_hash = 0;  ///< of the picture without
};
using LookupCosts = std::array<LookupCost, kLookups.size()>;

Result<double> shading_ns(ShadowCase& shadows) {
  const auto sample = shadows.draw();
  if (!sample) return sample.error();
  return pass_ms(*sample, "deferred") * kNsPerMs;
}

/// Times frames with one filter and without shadows, alternately.
Status time_lookup(ShadowCase& shadows, LookupCost& cost) {
  for (int i = -kShadowWarmUp; i < kShadowPairs; ++i) {
    GLOAM_TRY(shadows.set("shadows.mode", "monolithic"));
    const auto with = shading_ns(shadows);
    if (!with) return with.error();
    const auto hash = shadows.picture_hash();
    if (!hash) return hash.error();
    cost.hash = *hash;
    GLOAM_TRY(shadows.set("shadows.mode", "off"));
    const auto without = shading_ns(shadows);
    if (!without) return without.error();
    const auto without_hash = shadows.picture_hash();
    if (!without_hash) return without_hash.error();
    cost.without_hash = *without_hash;
    if (i < 0) continue;
    cost.shadows_ns.push_back(*with - *without);
    cost.shading_ns.push_back(*with);
  }
  return shadows.set("shadows.mode", "monolithic");
}

Result<LookupCosts> measure_lookups(Session& session, const Options& options) {
  LookupCosts costs;
  ShadowCase timed(session, options.width, options.height);
  for (std::size_t i = 0; i < kLookups.size(); ++i) {
    GLOAM_TRY(timed.set("shadows.filter", kLookups[i].filter));
    GLOAM_TRY(timed.set("shadows.mips", kLookups[i].mips));
    GLOAM_TRY(time_lookup(timed, costs[i]));
  }
  ShadowCase judged(session, kErrorWidth, kErrorHeight);
  for (std::size_t i = 0; i < kLookups.size(); ++i) {
    GLOAM_TRY(judged.set("shadows.filter", kLookups[i].filter));
    GLOAM_TRY(judged.set("shadows.mips", kLookups[i].mips));
    const auto error = judged.error();
    if (!error) return error.error();
    costs[i].error = *error;
  }
  return costs;
}

Result<JudgedShadows> measure_default(Session& session) {
  ShadowCase judged(session, kErrorWidth, kErrorHeight);
  return judged.error();
}

struct SharedShadows {
  Once<LookupCosts> lookups;
  Once<JudgedShadows> standard;
};

template <class T, class Measure, class Value>
BenchRow shadow_row_of(std::string id, std::string unit, Measure measure, Value value) {
  BenchRow row;
  row.id = "shadows." + std::move(id);
  row.unit = std::move(unit);
  row.run = [measure, value](BenchContext& context) -> Result<BenchValue> {
    const Result<const T*> measured = measure(context);
    if (!measured) return measured.error();
    BenchValue result = value(**measured);
    result.scene = context.scene_or(kShadowScene);
    return result;
  };
  return row;
}

void add_error_rows(BenchRegistry& registry, const std::shared_ptr<SharedShadows>& shared) {
  const auto measure = [shared](BenchContext& context) {
    return shared->standard.get([&]() -> Result<JudgedShadows> {
      auto session = context.session_or(kShadowScene);
      if (!session) return session.error();
      return measure_default(**session);
    });
  };
  BenchRow mean = shadow_row_of<JudgedShadows>("error_traced_mean", "visibility", measure,
                                               [](const JudgedShadows& e) { return single_value(e.mean(), e.hash); });
  mean.bar = 0.02;
  registry.add(std::move(mean));
  BenchRow penumbra =
      shadow_row_of<JudgedShadows>("error_traced_penumbra_mean", "visibility", measure,
                                   [](const JudgedShadows& e) { return single_value(e.penumbra_mean(), e.hash); });
  penumbra.bar = 0.08;
  registry.add(std::move(penumbra));
  registry.add(shadow_row_of<JudgedShadows>("error_traced_off", "share of pairs", measure, [](const JudgedShadows& e) {
    return single_value(e.off_share(), e.hash);
  }));
  registry.add(shadow_row_of<JudgedShadows>(
      "acne", "share of pairs", measure, [](const JudgedShadows& e) { return single_value(e.acne_share(), e.hash); }));
  registry.add(shadow_row_of<JudgedShadows>(
      "leaks", "share of pairs", measure, [](const JudgedShadows& e) { return single_value(e.leak_share(), e.hash); }));
}

void add_lookup_rows(BenchRegistry& registry, const std::shared_ptr<SharedShadows>& shared) {
  const auto measure = [shared](BenchContext& context) {
    return shared->lookups.get([&]() -> Result<LookupCosts> {
      auto session = context.session_or(kShadowScene);
      if (!session) return session.error();
      return measure_lookups(**session, context.options());
    });
  };
  for (std::size_t i = 0; i < kLookups.size(); ++i) {
    const std::string id = std::string("filter.") + kLookups[i].name;
    registry.add(shadow_row_of<LookupCosts>(id + ".ms", "ms", measure, [i](const LookupCosts& costs) {
      return per_item(costs[i].shadows_ns, kNsPerMs, hash_of_both(costs[i].hash, costs[i].without_hash));
    }));
    registry.add(shadow_row_of<LookupCosts>(id + ".error", "visibility", measure, [i](const LookupCosts& costs) {
      return single_value(costs[i].error.mean(), costs[i].error.hash);
    }));
    registry.add(shadow_row_of<LookupCosts>(
        id + ".error_penumbra", "visibility", measure,
        [i](const LookupCosts& costs) { return single_value(costs[i].error.penumbra_mean(), costs[i].error.hash); }));
  }
  // 48 gathers from mips against 128 single fetches without (Thief §1.3.3).
  registry.add(shadow_row_of<LookupCosts>("filter.chs_over_pcss", "ratio", measure, [](const LookupCosts& costs) {
    return ratio_of(costs[3].shadows_ns, costs[2].shadows_ns, hash_of_both(costs[3].hash, costs[2].hash));
  }));
}

}  // namespace

void add_shadow_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<SharedShadows>();
  add_error_rows(registry, shared);
  add_lookup_rows(registry, shared);
  add_shadow_error_benches(registry);
  add_shadow_bias_benches(registry);
  add_shadow_gather_benches(registry);
  add_shadow_penumbra_benches(registry);
}

}  // namespace gloam
