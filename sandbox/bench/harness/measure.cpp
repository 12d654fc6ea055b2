// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/measure.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <chrono>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "sandbox/session/results/summary.h"

namespace gloam {
namespace {

BenchValue value_of(std::vector<double> values, std::uint64_t hash) {
  const Summary summary = summarize(std::move(values));
  return {.value = summary.median, .p10 = summary.p10, .p90 = summary.p90, .hash = hash_text(hash)};
}

double time_once(const TimedCall& side) {
  if (side.prepare) side.prepare();
  const auto begin = std::chrono::steady_clock::now();
  side.run();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::nano>(end - begin).count();
}

}  // namespace

void keep(std::uint64_t value) {
  benchmark::DoNotOptimize(value);
  benchmark::ClobberMemory();
}

std::vector<double> time_ns(int repetitions, const std::function<void()>& prepare, const std::function<void()>& run) {
  const TimedCall side{.prepare = prepare, .run = run};
  std::vector<double> times;
  for (int i = 0; i <= repetitions; ++i) {
    const double time = time_once(side);
    if (i > 0) times.push_back(time);
  }
  return times;
}

PairTimes time_pair_ns(int repetitions, const TimedCall& a, const TimedCall& b) {
  PairTimes times;
  for (int i = 0; i <= repetitions; ++i) {
    const double a_ns = time_once(a);
    const double b_ns = time_once(b);
    if (i == 0) continue;
    times.a_ns.push_back(a_ns);
    times.b_ns.push_back(b_ns);
  }
  return times;
}

BenchValue per_item(std::vector<double> times_ns, double count, std::uint64_t hash) {
  for (double& time : times_ns) time /= count;
  return value_of(std::move(times_ns), hash);
}

BenchValue ratio_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, std::uint64_t hash) {
  GLOAM_ASSERT(a_ns.size() == b_ns.size(), "a ratio is of as many times");
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a_ns.size(); ++i) ratios.push_back(a_ns[i] / std::max(b_ns[i], 1.0));
  return value_of(std::move(ratios), hash);
}

BenchValue excess_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, double count,
                     std::uint64_t hash) {
  GLOAM_ASSERT(a_ns.size() == b_ns.size(), "a difference is of as many times");
  std::vector<double> excess;
  for (std::size_t i = 0; i < a_ns.size(); ++i) excess.push_back((a_ns[i] - b_ns[i]) / count);
  return value_of(std::move(excess), hash);
}

BenchValue single_value(double value, std::uint64_t hash) {
  return {.value = value, .p10 = {}, .p90 = {}, .hash = hash_text(hash)};
}

std::uint64_t hash_of_both(std::uint64_t a, std::uint64_t b) { return Hasher().value(a).value(b).digest(); }

std::uint64_t hash_of_number(double value) { return Hasher().value(std::bit_cast<std::uint64_t>(value)).digest(); }

std::string hash_text(std::uint64_t hash) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t digit = 0; digit < 16; ++digit) text[15 - digit] = kHex[(hash >> (4 * digit)) & 15];
  return text;
}

}  // namespace gloam
