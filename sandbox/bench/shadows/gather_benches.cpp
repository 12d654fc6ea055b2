// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/bench/shadows/gathers.h"

namespace gloam {
namespace {

constexpr const char* kGatherScene = "builtin:penumbra";
constexpr const char* kLight = "lamp";  // a spot: one face
constexpr int kGatherPairs = 15;
constexpr int kGatherWarmUp = 2;

struct Rates {
  std::vector<double> bare_ns;
  std::vector<double> filter_ns;
  std::uint64_t bare_hash = 0;    ///< of the sums of the gathers
  std::uint64_t filter_hash = 0;  ///< of the picture of visibilities
};

/// Times frames that show one light with the whole filter (early-outs off) and frames with only its gathers,
/// alternately.
Result<Rates> measure_rates(BenchContext& context) {
  ModuleList more;
  more.push_back(make_shadow_gathers_module());
  auto session = context.open_builtin(kGatherScene, std::move(more));
  if (!session) return session.error();
  ShadowCase shadows(**session, context.options().width, context.options().height);
  for (const auto& [knob, value] :
       {std::pair{"shadows.filter", "chs"}, {"shadows.kernel", "8"}, {"shadows.mips", "on"}})
    GLOAM_TRY(shadows.set(knob, value));
  GLOAM_TRY(shadows.set("shadows.early_outs", "off"));
  Rates rates;
  for (int i = -kGatherWarmUp; i < kGatherPairs; ++i) {
    const auto filter = shadows.draw(std::string("shadow:") + kLight);
    if (!filter) return filter.error();
    const auto hash = shadows.picture_hash();
    if (!hash) return hash.error();
    rates.filter_hash = *hash;
    const auto bare = shadows.draw(std::string(kShadowGathersView) + ":" + kLight);
    if (!bare) return bare.error();
    if (i < 0) continue;
    rates.filter_ns.push_back(pass_ms(*filter, "shadow_view") * kNsPerMs);
    rates.bare_ns.push_back(pass_ms(*bare, "shadow_gathers") * kNsPerMs);
  }
  const auto bare_hash = shadows.image_hash(kShadowGathersView);
  if (!bare_hash) return bare_hash.error();
  rates.bare_hash = *bare_hash;
  return rates;
}

template <class Value>
BenchRow rate_row(std::string id, std::string unit, std::shared_ptr<Once<Rates>> shared, Value value) {
  BenchRow row;
  row.id = "shadows." + std::move(id);
  row.unit = std::move(unit);
  row.run = [shared = std::move(shared), value](BenchContext& context) -> Result<BenchValue> {
    const auto rates = shared->get([&] { return measure_rates(context); });
    if (!rates) return rates.error();
    BenchValue result = value(**rates);
    result.scene = kGatherScene;
    return result;
  };
  return row;
}

}  // namespace

void add_shadow_gather_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Rates>>();
  BenchRow share = rate_row("gather_share", "ratio", shared, [](const Rates& rates) {
    return ratio_of(rates.bare_ns, rates.filter_ns, hash_of_both(rates.bare_hash, rates.filter_hash));
  });
  share.bar = 0.6;
  share.better = Better::higher;
  registry.add(std::move(share));
  registry.add(rate_row("gather_bare_ms", "ms", shared,
                        [](const Rates& rates) { return per_item(rates.bare_ns, kNsPerMs, rates.bare_hash); }));
  registry.add(rate_row("gather_filter_ms", "ms", shared,
                        [](const Rates& rates) { return per_item(rates.filter_ns, kNsPerMs, rates.filter_hash); }));
}

}  // namespace gloam
