// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sandbox/bench/harness/registry.h"

namespace gloam {

inline constexpr double kNsPerMs = 1e6;

/// Makes the compiler assume that the value is read and that all memory may have changed, so that it removes no work.
void keep(std::uint64_t value);

/// Nanoseconds of each of `repetitions` calls of `run`; `prepare` (may be empty) runs untimed before each. An extra
/// call first warms up.
[[nodiscard]] std::vector<double> time_ns(int repetitions, const std::function<void()>& prepare,
                                          const std::function<void()>& run);

/// One of two ways to do the same work; `prepare` (may be empty) runs untimed before each `run`.
struct TimedCall {
  std::function<void()> prepare;
  std::function<void()> run;
};
/// Times of two sides, repetition by repetition.
struct PairTimes {
  std::vector<double> a_ns;
  std::vector<double> b_ns;
};
/// Times two sides alternately (a b a b …), so that a change of clock speed or load affects both, and each side finds
/// the caches as the other left them. An extra round first warms up.
[[nodiscard]] PairTimes time_pair_ns(int repetitions, const TimedCall& a, const TimedCall& b);

/// Median and spread of times, each divided by `count`.
[[nodiscard]] BenchValue per_item(std::vector<double> times_ns, double count, std::uint64_t hash);

/// Median and spread of a / b, which is computed for each repetition. a_ns and b_ns: equally many times.
[[nodiscard]] BenchValue ratio_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, std::uint64_t hash);

/// Median and spread of (a − b) / count, which is computed for each repetition. a_ns and b_ns: equally many times.
[[nodiscard]] BenchValue excess_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, double count,
                                   std::uint64_t hash);

/// One value without a spread, with the hash of its input.
[[nodiscard]] BenchValue single_value(double value, std::uint64_t hash);

/// One hash for the results of two sides: it changes if either hash changes.
[[nodiscard]] std::uint64_t hash_of_both(std::uint64_t a, std::uint64_t b);

/// Hash of the bits of a number.
[[nodiscard]] std::uint64_t hash_of_number(double value);

/// 16 hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace gloam
