// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/range_region.h"

#include <algorithm>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// A claim should take about this long: claiming and reading the clock are then below one percent.
constexpr float kClaimNs = 10'000.0f;

/// Of a shorter claim, the clock measures mostly itself: it may only lower what a range is believed to cost.
constexpr float kTrustedNs = 1'000.0f;

std::size_t ranges_a_claim(float range_ns, std::size_t last) {
  if (range_ns * static_cast<float>(last) * 8.0f <= kClaimNs) return last * 8;
  return std::max<std::size_t>(1, static_cast<std::size_t>(kClaimNs / range_ns));
}

constexpr std::size_t kMostRanges = 0xFFFF'FFFF;

std::uint64_t packed(std::size_t begin, std::size_t end) { return std::uint64_t{end} << 32 | begin; }

}  // namespace

RangeRegion::RangeRegion(std::size_t ranges, const RangeWork& work, Crew& crew)
    : work_(work), crew_(crew), left_(packed(0, ranges)) {
  GLOAM_ASSERT(ranges <= kMostRanges, "a parallel loop has fewer than 2^32 ranges");
}

bool RangeRegion::has_work() const { return unclaimed().size() > 0; }

RangeRegion::Claim RangeRegion::unclaimed() const {
  const std::uint64_t left = left_.load(std::memory_order_relaxed);
  const std::size_t begin = left & kMostRanges;
  return {begin, std::max(begin, std::min<std::size_t>(left >> 32, failure_.index()))};
}

RangeRegion::Claim RangeRegion::claim(Side side, std::size_t wanted) {
  std::uint64_t left = left_.load(std::memory_order_relaxed);
  while (true) {
    const std::size_t begin = left & kMostRanges;
    const std::size_t end = std::min<std::size_t>(left >> 32, failure_.index());
    if (begin >= end) return {};
    // An even end is not worth claims much shorter than wanted.
    const std::size_t fair = std::max((end - begin) / (2 * std::size_t{crew_.threads()}), wanted / 16);
    const std::size_t count = std::clamp<std::size_t>(std::min(wanted, fair), 1, end - begin);
    const Claim claim = side == Side::front ? Claim{begin, begin + count} : Claim{end - count, end};
    const std::uint64_t rest = side == Side::front ? packed(claim.end, end) : packed(begin, claim.begin);
    if (left_.compare_exchange_weak(left, rest, std::memory_order_relaxed)) return claim;
  }
}

void RangeRegion::run(Claim claim) {
  // Claims end at their own first failure only, and only ranges behind a failure are left unclaimed, so every range below the lowest
  // failure runs: the exception that the caller sees does not depend on timing.
  std::size_t i = claim.begin;
  try {
    work_.run(i, claim.end);
  } catch (...) {
    failure_.record(i, std::current_exception());
  }
}

void RangeRegion::help() {
  std::size_t wanted = 1;
  auto before = Clock::now();
  for (Claim c = claim(Side::back, wanted); c.size() > 0; c = claim(Side::back, wanted)) {
    run(c);
    const auto after = Clock::now();
    wanted = ranges_a_claim(nanoseconds_between(before, after) / static_cast<float>(c.size()), wanted);
    before = after;
  }
}

void RangeRegion::offer_rest(float range_ns) {
  const std::size_t rest = unclaimed().size();
  if (rest == 0) return;
  const float rest_ns = range_ns * static_cast<float>(rest);
  const float saved_ns = rest == 1 ? rest_ns : rest_ns * 0.5f;  // at least: this thread goes on too
  const float worthwhile_ns = crew_.worthwhile_ns();
  if (saved_ns < worthwhile_ns) return;
  const float limit = static_cast<float>(std::min<std::size_t>(rest, crew_.threads() - 1));
  const auto wanted = static_cast<std::uint32_t>(std::min(limit, rest_ns / worthwhile_ns));
  if (helpers() < wanted) crew_.offer(*this, wanted - helpers());
}

float RangeRegion::lead(float range_ns) {
  const InsideRegion inside(*this);
  std::size_t wanted = 1;  // whatever the last call cost: this one may be longer
  std::size_t ran = 0;
  const auto start = Clock::now();
  auto before = start;
  for (Claim c = claim(Side::front, wanted); c.size() > 0; c = claim(Side::front, wanted)) {
    offer_rest(range_ns);
    run(c);
    const auto after = Clock::now();
    const float claim_ns = nanoseconds_between(before, after);
    const float measured = claim_ns / static_cast<float>(c.size());
    if (claim_ns >= kTrustedNs || measured < range_ns) range_ns = measured;
    wanted = ranges_a_claim(range_ns, wanted);
    before = after;
    ran += c.size();
  }
  crew_.close(*this);
  failure_.rethrow_if_any();
  return ran == 0 ? 0.0f : nanoseconds_between(start, before) / static_cast<float>(ran);
}

}  // namespace gloam
