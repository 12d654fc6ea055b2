// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/particles/case.h"

// Times of the passes of particles: lit against unlit ones, by the number of particles and by the rate of lighting.

namespace gloam {
namespace {

constexpr double kLitParticles = 2e4;

struct ParticleCost {
  std::vector<double> simulation_ns, simulate_and_sort_ns, light_ns, drawing_ns, all_ns;
  std::uint64_t hash = 0;  ///< of the last picture

  void add(const ParticleTimes& times) {
    simulation_ns.push_back(times.simulation_ns);
    simulate_and_sort_ns.push_back(times.simulation_ns + times.sort_ns);
    light_ns.push_back(times.light_ns);
    drawing_ns.push_back(times.drawing_ns);
    all_ns.push_back(times.all_ns());
  }
};

/// Adds one frame's times to `cost`, if it counts.
Status measure_once(ParticleCase& particles, bool counts, ParticleCost& cost) {
  const auto sample = particles.draw();
  if (!sample) return sample.error();
  if (counts) cost.add(particle_times(*sample));
  const auto hash = particles.hash();
  if (!hash) return hash.error();
  cost.hash = *hash;
  return {};
}

Result<ParticleCost> measure_frames(ParticleCase& particles, int warm_up, int frames) {
  ParticleCost cost;
  for (int i = -warm_up; i < frames; ++i) GLOAM_TRY(measure_once(particles, i >= 0, cost));
  return cost;
}

/// Lit and unlit frames in turn.
Result<BenchValue> measure_lit_over_unlit(BenchContext& context) {
  constexpr int kPairs = 15, kWarmUp = 2;
  const auto particles = ParticleCase::open(context, "far");
  if (!particles) return particles.error();
  (*particles)->use_dust(kLitParticles);
  GLOAM_TRY((*particles)->set("particles.lighting", "vertex"));
  ParticleCost lit, unlit;
  for (int i = -kWarmUp; i < kPairs; ++i) {
    GLOAM_TRY((*particles)->set("particles.light", "on"));
    GLOAM_TRY(measure_once(**particles, i >= 0, lit));
    GLOAM_TRY((*particles)->set("particles.light", "off"));
    GLOAM_TRY(measure_once(**particles, i >= 0, unlit));
  }
  BenchValue value = ratio_of(lit.all_ns, unlit.all_ns, hash_of_both(lit.hash, unlit.hash));
  value.scene = kSmokeScene;
  return value;
}

using SharedCost = std::shared_ptr<Once<ParticleCost>>;
using Times = std::vector<double> ParticleCost::*;

template <class Measure>
void add_particle_row(BenchRegistry& registry, const std::string& id, std::optional<double> bar,
                      const SharedCost& shared, Times times, Measure measure) {
  BenchRow row;
  row.id = id;
  row.unit = "ms";
  row.bar = bar;
  row.run = [shared, times, measure](BenchContext& context) -> Result<BenchValue> {
    const auto cost = shared->get([&] { return measure(context); });
    if (!cost) return cost.error();
    BenchValue value = per_item((*cost)->*times, kNsPerMs, (*cost)->hash);
    value.scene = kSmokeScene;
    return value;
  };
  registry.add(std::move(row));
}

void add_number_rows(BenchRegistry& registry) {
  struct Number {
    const char* name;
    double particles;
    int frames;
  };
  for (const Number& number : {Number{"1e3", 1e3, 9}, {"1e4", 1e4, 9}, {"1e5", 1e5, 9}, {"1e6", 1e6, 3}}) {
    const auto shared = std::make_shared<Once<ParticleCost>>();
    const auto measure = [number](BenchContext& context) -> Result<ParticleCost> {
      const auto particles = ParticleCase::open(context, "far");
      if (!particles) return particles.error();
      (*particles)->use_dust(number.particles);
      return measure_frames(**particles, 1, number.frames);
    };
    const std::string name = number.name;
    const auto bar = name == "1e5" ? std::optional(8.0) : std::nullopt;
    add_particle_row(registry, "particles.simulate_and_sort_" + name + ".ms", bar, shared,
                     &ParticleCost::simulate_and_sort_ns, measure);
    add_particle_row(registry, "particles.cost." + name + ".simulation_ms", std::nullopt, shared,
                     &ParticleCost::simulation_ns, measure);
    add_particle_row(registry, "particles.cost." + name + ".light_ms", std::nullopt, shared, &ParticleCost::light_ns,
                     measure);
    add_particle_row(registry, "particles.cost." + name + ".drawing_ms", std::nullopt, shared,
                     &ParticleCost::drawing_ns, measure);
  }
}

void add_rate_rows(BenchRegistry& registry) {
  for (const char* rate : {"sprite", "vertex", "pixel"}) {
    const auto measure = [rate](BenchContext& context) -> Result<ParticleCost> {
      const auto particles = ParticleCase::open(context, "near");
      if (!particles) return particles.error();
      GLOAM_TRY((*particles)->set("particles.lighting", rate));
      return measure_frames(**particles, 2, 9);
    };
    add_particle_row(registry, std::string("particles.cost.") + rate + ".ms", std::nullopt,
                     std::make_shared<Once<ParticleCost>>(), &ParticleCost::all_ns, measure);
  }
}

}  // namespace

void add_particle_cost_benches(BenchRegistry& registry) {
  registry.add({.id = "particles.lit_over_unlit", .unit = "ratio", .bar = 1.5, .run = &measure_lit_over_unlit});
  add_number_rows(registry);
  add_rate_rows(registry);
}

}  // namespace gloam
