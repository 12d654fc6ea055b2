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

constexpr const char* kScene = "builtin:shadows";  // unless the user names one
// Rays for every light and pixel: pictures of this size, whatever the size that frames are timed at.
constexpr std::uint32_t kErrorWidth = 320;
constexpr std::uint32_t kErrorHeight = 180;
constexpr int kPairs = 9;
constexpr int kWarmUp = 2;
constexpr double kNsPerMs = 1e6;

/// A way to look maps up, and the knobs that choose it.
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
  std::vector<double> shadows_ns;  ///< what shading takes more than without shadows
  std::vector<double> shading_ns;
  ShadowError error;
  std::uint64_t hash = 0;
};
using LookupCosts = std::array<LookupCost, kLookups.size()>;

Result<double> shading_ns(ShadowCase& shadows) {
  const auto sample = shadows.draw();
  if (!sample) return sample.error();
  return pass_ms(*sample, "deferred") * kNsPerMs;
}

/// Frames by one way of looking up and without shadows, turn about.
Status time_lookup(ShadowCase& shadows, LookupCost& cost) {
  for (int i = -kWarmUp; i < kPairs; ++i) {
    GLOAM_TRY(shadows.set("shadows.mode", "monolithic"));
    const auto with = shading_ns(shadows);
    if (!with) return with.error();
    const auto hash = shadows.picture_hash();
    if (!hash) return hash.error();
    cost.hash = *hash;
    GLOAM_TRY(shadows.set("shadows.mode", "off"));
    const auto without = shading_ns(shadows);
    if (!without) return without.error();
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

Result<ShadowError> measure_default(Session& session) {
  ShadowCase judged(session, kErrorWidth, kErrorHeight);
  return judged.error();
}

struct Shared {
  Once<LookupCosts> lookups;
  Once<ShadowError> standard;
};

BenchValue plain(double value) {
  BenchValue result;
  result.value = value;
  return result;
}

template <class T, class Measure, class Value>
BenchRow row_of(std::string id, std::string unit, Measure measure, Value value) {
  BenchRow row;
  row.id = "shadows." + std::move(id);
  row.unit = std::move(unit);
  row.run = [measure, value](BenchContext& context) -> Result<BenchValue> {
    const Result<const T*> measured = measure(context);
    if (!measured) return measured.error();
    BenchValue result = value(**measured);
    result.scene = context.scene_or(kScene);
    return result;
  };
  return row;
}

void add_error_rows(BenchRegistry& registry, const std::shared_ptr<Shared>& shared) {
  const auto measure = [shared](BenchContext& context) {
    return shared->standard.get([&]() -> Result<ShadowError> {
      auto session = context.session_or(kScene);
      if (!session) return session.error();
      return measure_default(**session);
    });
  };
  BenchRow mean = row_of<ShadowError>("error_traced_mean", "visibility", measure,
                                      [](const ShadowError& e) { return plain(e.mean()); });
  mean.bar = 0.02;
  registry.add(std::move(mean));
  BenchRow penumbra = row_of<ShadowError>("error_traced_penumbra_mean", "visibility", measure,
                                          [](const ShadowError& e) { return plain(e.penumbra_mean()); });
  penumbra.bar = 0.08;
  registry.add(std::move(penumbra));
  registry.add(row_of<ShadowError>("acne", "share of pairs", measure,
                                   [](const ShadowError& e) { return plain(e.acne_share()); }));
  registry.add(row_of<ShadowError>("leaks", "share of pairs", measure,
                                   [](const ShadowError& e) { return plain(e.leak_share()); }));
}

void add_lookup_rows(BenchRegistry& registry, const std::shared_ptr<Shared>& shared) {
  const auto measure = [shared](BenchContext& context) {
    return shared->lookups.get([&]() -> Result<LookupCosts> {
      auto session = context.session_or(kScene);
      if (!session) return session.error();
      return measure_lookups(**session, context.options());
    });
  };
  for (std::size_t i = 0; i < kLookups.size(); ++i) {
    const std::string id = std::string("filter.") + kLookups[i].name;
    registry.add(row_of<LookupCosts>(id + ".ms", "ms", measure, [i](const LookupCosts& costs) {
      return per_item(costs[i].shadows_ns, kNsPerMs, costs[i].hash);
    }));
    registry.add(row_of<LookupCosts>(id + ".error", "visibility", measure,
                                     [i](const LookupCosts& costs) { return plain(costs[i].error.mean()); }));
    registry.add(row_of<LookupCosts>(id + ".error_penumbra", "visibility", measure,
                                     [i](const LookupCosts& costs) { return plain(costs[i].error.penumbra_mean()); }));
  }
  // 48 gathers from mips against 128 single fetches without (Thief §1.3.3).
  registry.add(row_of<LookupCosts>("filter.chs_over_pcss", "ratio", measure, [](const LookupCosts& costs) {
    return ratio_of(costs[3].shadows_ns, costs[2].shadows_ns, costs[3].hash);
  }));
}

}  // namespace

void add_shadow_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Shared>();
  add_error_rows(registry, shared);
  add_lookup_rows(registry, shared);
  add_shadow_bias_benches(registry);
  add_shadow_gather_benches(registry);
  add_shadow_penumbra_benches(registry);
}

}  // namespace gloam
