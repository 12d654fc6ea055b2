// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
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

// FF table 2: oriented bias against the rasteriser's constant bias. Each method is swept in its own units with the hard
// filter and compared with traced shadows, and is timed at its best value.

namespace gloam {
namespace {

constexpr const char* kBiasScene = "builtin:shadows";  // unless the user names one
constexpr std::uint32_t kBiasErrorWidth = 640;
constexpr std::uint32_t kBiasErrorHeight = 360;
constexpr int kBiasPairs = 15;
constexpr int kBiasWarmUp = 2;

constexpr std::array<const char*, 8> kMillimetres = {"0", "0.5", "1", "2", "3", "5", "10", "20"};
constexpr std::array<const char*, 10> kUnits = {"0",     "100",   "300",    "1000",   "3000",
                                                "10000", "30000", "100000", "300000", "1000000"};

struct Method {
  const char* name;
  const char* knob;
  std::span<const char* const> values;
};
constexpr std::array<Method, 2> kMethods = {
    {{"oriented", "shadows.bias_mm", kMillimetres}, {"hardware", "shadows.bias_units", kUnits}}};

struct Sweep {
  std::vector<JudgedShadows> errors;  ///< one per value
  std::vector<double> shading_ns;     ///< at the best value
  std::vector<double> plain_ns;       ///< the same without the receiver plane: hardware bias then needs no normals
  std::uint64_t hash = 0;             ///< of the picture at the best value
  std::uint64_t plain_hash = 0;       ///< of the picture without the receiver plane
  [[nodiscard]] std::size_t best() const {
    const auto less = [](const JudgedShadows& a, const JudgedShadows& b) { return a.wrong_share() < b.wrong_share(); };
    return static_cast<std::size_t>(std::min_element(errors.begin(), errors.end(), less) - errors.begin());
  }
  /// The least share of leaks among the values whose share of acne is at most `acne`.
  [[nodiscard]] double least_leak(double acne) const {
    double least = std::numeric_limits<double>::infinity();
    for (const JudgedShadows& error : errors)
      if (error.acne_share() <= acne) least = std::min(least, error.leak_share());
    return least;
  }
};
using Sweeps = std::array<Sweep, kMethods.size()>;

Status choose(ShadowCase& shadows, std::size_t method, std::size_t value) {
  GLOAM_TRY(shadows.set("shadows.bias", kMethods[method].name));
  return shadows.set(kMethods[method].knob, kMethods[method].values[value]);
}

/// Times both methods at their best values alternately, with the user's filter.
Status time_best(Session& session, const Options& options, Sweeps& sweeps) {
  ShadowCase timed(session, options.width, options.height);
  for (int i = -kBiasWarmUp; i < kBiasPairs; ++i) {
    for (std::size_t method = 0; method < kMethods.size(); ++method) {
      GLOAM_TRY(choose(timed, method, sweeps[method].best()));
      if (auto redrawn = timed.draw(); !redrawn) return redrawn.error();  // redraws the maps
      const auto sample = timed.draw();
      if (!sample) return sample.error();
      const auto hash = timed.picture_hash();
      if (!hash) return hash.error();
      sweeps[method].hash = *hash;
      GLOAM_TRY(timed.set("shadows.receiver_plane", "off"));
      const auto without_plane = timed.draw();
      timed.set_back("shadows.receiver_plane");
      if (!without_plane) return without_plane.error();
      const auto plain_hash = timed.picture_hash();
      if (!plain_hash) return plain_hash.error();
      sweeps[method].plain_hash = *plain_hash;
      if (i < 0) continue;
      sweeps[method].shading_ns.push_back(pass_ms(*sample, "deferred") * kNsPerMs);
      sweeps[method].plain_ns.push_back(pass_ms(*without_plane, "deferred") * kNsPerMs);
    }
  }
  return {};
}

Result<Sweeps> measure_sweeps(Session& session, const Options& options) {
  Sweeps sweeps;
  {
    ShadowCase judged(session, kBiasErrorWidth, kBiasErrorHeight);
    GLOAM_TRY(judged.set("shadows.filter", "hard"));
    for (std::size_t method = 0; method < kMethods.size(); ++method) {
      for (std::size_t value = 0; value < kMethods[method].values.size(); ++value) {
        GLOAM_TRY(choose(judged, method, value));
        const auto error = judged.error();
        if (!error) return error.error();
        sweeps[method].errors.push_back(*error);
      }
    }
  }
  GLOAM_TRY(time_best(session, options, sweeps));
  return sweeps;
}

using SharedSweeps = std::shared_ptr<Once<Sweeps>>;

template <class Value>
BenchRow sweep_row(std::string id, std::string unit, SharedSweeps shared, Value value) {
  BenchRow row;
  row.id = "shadows.table2." + std::move(id);
  row.unit = std::move(unit);
  row.run = [shared = std::move(shared), value](BenchContext& context) -> Result<BenchValue> {
    const auto sweeps = shared->get([&]() -> Result<Sweeps> {
      auto session = context.session_or(kBiasScene);
      if (!session) return session.error();
      return measure_sweeps(**session, context.options());
    });
    if (!sweeps) return sweeps.error();
    BenchValue result = value(**sweeps);
    result.scene = context.scene_or(kBiasScene);
    return result;
  };
  return row;
}

/// Hash over all values of both methods, because the choice of the best value depends on all.
std::uint64_t hash_of_visibilities(const Sweeps& sweeps) {
  Hasher hasher;
  for (const Sweep& sweep : sweeps)
    for (const JudgedShadows& judged : sweep.errors) hasher.value(judged.hash);
  return hasher.digest();
}

double best_share(const Sweep& sweep) { return sweep.errors[sweep.best()].wrong_share(); }

/// Least leaks of oriented bias over least leaks of hardware bias, with equally little acne: at most as much as the
/// worse of the two has at its best value.
double leak_ratio(const Sweeps& sweeps) {
  const double acne =
      std::max(sweeps[0].errors[sweeps[0].best()].acne_share(), sweeps[1].errors[sweeps[1].best()].acne_share());
  const double ours = sweeps[0].least_leak(acne);
  const double theirs = sweeps[1].least_leak(acne);
  return theirs > 0.0 ? ours / theirs : 1.0;
}

void add_value_rows(BenchRegistry& registry, const SharedSweeps& shared) {
  struct Column {
    const char* name;
    double (ShadowError::*share)() const;
  };
  constexpr std::array<Column, 3> kColumns = {
      {{"wrong", &ShadowError::wrong_share}, {"acne", &ShadowError::acne_share}, {"leak", &ShadowError::leak_share}}};
  for (std::size_t method = 0; method < kMethods.size(); ++method) {
    for (std::size_t value = 0; value < kMethods[method].values.size(); ++value) {
      for (const Column& column : kColumns) {
        const std::string id =
            std::string(kMethods[method].name) + "." + kMethods[method].values[value] + "." + column.name;
        registry.add(
            sweep_row(id, "share of pairs", shared, [method, value, share = column.share](const Sweeps& sweeps) {
              const JudgedShadows& judged = sweeps[method].errors[value];
              return single_value((judged.*share)(), judged.hash);
            }));
      }
    }
  }
}

}  // namespace

void add_shadow_bias_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<Once<Sweeps>>();
  BenchRow time = sweep_row("oriented_over_hardware_ms", "ratio", shared, [](const Sweeps& sweeps) {
    return ratio_of(sweeps[0].shading_ns, sweeps[1].shading_ns, hash_of_both(sweeps[0].hash, sweeps[1].hash));
  });
  time.bar = 1.03;
  registry.add(std::move(time));
  registry.add(sweep_row("oriented_over_hardware_without_plane_ms", "ratio", shared, [](const Sweeps& sweeps) {
    return ratio_of(sweeps[0].plain_ns, sweeps[1].plain_ns, hash_of_both(sweeps[0].plain_hash, sweeps[1].plain_hash));
  }));
  BenchRow wrong = sweep_row("oriented_over_hardware_wrong_pixels", "ratio", shared, [](const Sweeps& sweeps) {
    return single_value(best_share(sweeps[0]) / std::max(best_share(sweeps[1]), 1e-12), hash_of_visibilities(sweeps));
  });
  wrong.bar = 0.8;
  registry.add(std::move(wrong));
  BenchRow leak = sweep_row("oriented_over_hardware_leaks_at_equal_acne", "ratio", shared, [](const Sweeps& sweeps) {
    return single_value(leak_ratio(sweeps), hash_of_visibilities(sweeps));
  });
  leak.bar = 0.99;  // fewer leaks, not equally many
  registry.add(std::move(leak));
  add_value_rows(registry, shared);
}

}  // namespace gloam
