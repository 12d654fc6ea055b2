// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sandbox/bench/harness/registry.h"

namespace gloam {

/// Makes the compiler believe that somebody reads the value, and that anybody may have touched memory.
void keep(std::uint64_t value);

/// Nanoseconds of each of `repetitions` calls of `run`; `prepare` (may be empty) runs untimed before each. One further
/// call first warms up.
[[nodiscard]] std::vector<double> time_ns(int repetitions, const std::function<void()>& prepare,
                                          const std::function<void()>& run);

/// One of two ways to do the same work; `prepare` (may be empty) runs untimed before each `run`.
struct TimedSide {
  std::function<void()> prepare;
  std::function<void()> run;
};
/// Times of two sides, repetition by repetition.
struct PairTimes {
  std::vector<double> a_ns;
  std::vector<double> b_ns;
};
/// Times two sides turn about (a b a b …), so that a change of clock speed or load meets both and each finds the caches
/// as the other left them. One further turn first warms up.
[[nodiscard]] PairTimes time_pair_ns(int repetitions, const TimedSide& a, const TimedSide& b);

/// Median and spread of times, each divided by `count`.
[[nodiscard]] BenchValue per_item(std::vector<double> times_ns, double count, std::uint64_t hash);

/// a over b, repetition by repetition as they were measured.
[[nodiscard]] BenchValue ratio_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, std::uint64_t hash);

/// a minus b, repetition by repetition as they were measured, each divided by `count`.
[[nodiscard]] BenchValue excess_of(const std::vector<double>& a_ns, const std::vector<double>& b_ns, double count,
                                   std::uint64_t hash);

/// 16 hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace gloam
