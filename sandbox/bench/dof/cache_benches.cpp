// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/dof/case.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"

// Thief, section 1.5.2: the blur without workgroup memory, with an array of vectors, and with an array for each
// channel. Everything is behind the focus and has the greatest circle of each dof.radius. Times are of the passes that
// find sprites and gather.

namespace gloam {
namespace {

constexpr int kDofCacheRounds = 9;
constexpr int kDofCacheWarmUp = 1;
constexpr std::array<const char*, 3> kForms = {"none", "vec4", "channels"};  // values of dof.cache
constexpr std::size_t kPlainForm = 0, kChannelsForm = 2;
constexpr std::array<const char*, 5> kRadii = {"3", "7", "15", "23", "31"};

struct FormCosts {
  std::array<std::vector<double>, kForms.size()> blur_ns;
  std::array<std::uint64_t, kForms.size()> hashes{};
  bool measured = false;         ///< false: no camera has a focus
  bool threads_in_turn = false;  ///< of the device
};

/// The forms must give one picture, to the bit.
Status check_forms(Bokeh bokeh, const std::string& radius, const FormCosts& costs) {
  for (std::size_t form = 1; form < kForms.size(); ++form)
    if (costs.hashes[form] != costs.hashes[kPlainForm])
      return Error{ErrorKind::failed, std::string("dof.cache=") + kForms[form] + " and " + kForms[kPlainForm] +
                                          " give different pictures with the " + bokeh_name(bokeh) +
                                          " bokeh and radius " + radius};
  return {};
}

/// Frames of all forms in turn.
Result<FormCosts> measure_forms(BenchContext& context, DofFramesPool& pool, Bokeh bokeh, const std::string& radius) {
  const auto frames = pool.get(context, bokeh);
  if (!frames) return frames.error();
  FormCosts costs;
  if (*frames == nullptr) return costs;
  costs.measured = true;
  costs.threads_in_turn = (*frames)->session().device->info().threads_in_turn;
  (*frames)->blur_everything();
  GLOAM_TRY((*frames)->set("dof.resolution", "full"));
  GLOAM_TRY((*frames)->set("dof.radius", radius));
  for (int i = -kDofCacheWarmUp; i < kDofCacheRounds; ++i) {
    for (std::size_t form = 0; form < kForms.size(); ++form) {
      GLOAM_TRY((*frames)->set("dof.cache", kForms[form]));
      const auto sample = (*frames)->draw();
      if (!sample) return sample.error();
      if (i >= 0) costs.blur_ns[form].push_back(dof_times(*sample).blur_ns);
      if (i + 1 < kDofCacheRounds) continue;
      const auto light = (*frames)->linear();
      if (!light) return light.error();
      costs.hashes[form] = hash_of_dof_light(*light);
    }
  }
  GLOAM_TRY(check_forms(bokeh, radius, costs));
  return costs;
}

using SharedForms = std::shared_ptr<Once<FormCosts>>;

template <class Value>
void add_form_row(BenchRegistry& registry, BenchRow row, const SharedForms& shared,
                  const std::shared_ptr<DofFramesPool>& pool, Bokeh bokeh, const std::string& radius, Value value) {
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    const auto costs = shared->get([&] { return measure_forms(context, *pool, bokeh, radius); });
    if (!costs) return costs.error();
    if (!(*costs)->measured) return skipped_row(kNoFocus);
    BenchValue result = value(**costs);
    result.scene = context.scene_or(kLensScene);
    return result;
  };
  registry.add(std::move(row));
}

}  // namespace

void add_dof_cache_benches(BenchRegistry& registry) {
  const auto pool = std::make_shared<DofFramesPool>();
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    const std::string prefix = bokeh == Bokeh::round ? "dof." : "dof.hexagonal.";
    for (const std::string radius : kRadii) {
      const auto shared = std::make_shared<Once<FormCosts>>();
      for (std::size_t form = 0; form < kForms.size(); ++form)
        add_form_row(registry, {.id = prefix + "radius" + radius + "." + kForms[form], .unit = "ms"}, shared, pool,
                     bokeh, radius,
                     [form](const FormCosts& c) { return per_item(c.blur_ns[form], kNsPerMs, c.hashes[form]); });
      if (radius != "15") continue;
      // The paper's gain is one of a GPU: a CPU's cores have no workgroup memory.
      add_form_row(registry, {.id = prefix + "channels_over_none", .unit = "ratio", .bar = 0.67}, shared, pool, bokeh,
                   radius, [](const FormCosts& c) {
                     BenchValue ratio = ratio_of(c.blur_ns[kChannelsForm], c.blur_ns[kPlainForm],
                                                 hash_of_both(c.hashes[kChannelsForm], c.hashes[kPlainForm]));
                     ratio.informs = c.threads_in_turn;
                     return ratio;
                   });
    }
  }
}

}  // namespace gloam
