// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/range_region.h"

#include <algorithm>

namespace gloam {
namespace {

/// Target duration of a claim: claiming and reading the clock then cost less than one percent.
constexpr float kClaimNs = 10'000.0f;

/// The measurement of a shorter claim is mostly the cost of the clock: it may only lower the expected cost of a range.
constexpr float kTrustedNs = 1'000.0f;

std::size_t ranges_a_claim(float range_ns, std::size_t last) {
  if (range_ns * static_cast<float>(last) * 8.0f <= kClaimNs) return last * 8;
  return std::max<std::size_t>(1, static_cast<std::size_t>(kClaimNs / range_ns));
}

}  // namespace

bool RangeRegion::has_work() const {
  return next_.load(std::memory_order_relaxed) < std::min(ranges_, failure_.index());
}

RangeRegion::Claim RangeRegion::claim(std::size_t wanted) {
  std::size_t begin = next_.load(std::memory_order_relaxed);
  while (begin < std::min(ranges_, failure_.index())) {
    const std::size_t left = ranges_ - begin;
    // Claims shrink near the end, but not far below `wanted`: finishing together is not worth very short claims.
    const std::size_t fair = std::max(left / (2 * std::size_t{crew_.threads()}), wanted / 8);
    const std::size_t end = begin + std::clamp<std::size_t>(std::min(wanted, fair), 1, left);
    if (next_.compare_exchange_weak(begin, end, std::memory_order_relaxed)) return {begin, end};
  }
  return {};
}

void RangeRegion::run(Claim claim) {
  // Ranges are claimed from the front, and a claim ends only at its own first failure. So every range below the lowest
  // failure runs, and the exception that the caller sees does not depend on timing.
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
  for (Claim c = claim(wanted); c.begin != c.end; c = claim(wanted)) {
    run(c);
    const auto after = Clock::now();
    wanted = ranges_a_claim(nanoseconds_between(before, after) / static_cast<float>(c.end - c.begin), wanted);
    before = after;
  }
}

void RangeRegion::offer_unclaimed(std::size_t claimed_end, float range_ns) {
  const std::size_t unclaimed = ranges_ - std::min(claimed_end, ranges_);
  if (unclaimed == 0) return;
  const float unclaimed_ns = range_ns * static_cast<float>(unclaimed);
  const float saved_ns =
      unclaimed == 1 ? unclaimed_ns : unclaimed_ns * 0.5f;  // lower bound: this thread runs part of the rest too
  const float worthwhile_ns = crew_.worthwhile_ns();
  if (saved_ns < worthwhile_ns) return;
  const float limit = static_cast<float>(std::min<std::size_t>(unclaimed, crew_.threads() - 1));
  const auto wanted = static_cast<std::uint32_t>(std::min(limit, unclaimed_ns / worthwhile_ns));
  if (helpers() < wanted) crew_.offer(*this, wanted - helpers());
}

float RangeRegion::lead(float range_ns) {
  const InsideRegion inside(*this);
  std::size_t wanted = 1;  // one range at first: a range may cost more than in the last call
  std::size_t ran = 0;
  const auto start = Clock::now();
  auto before = start;
  for (Claim c = claim(wanted); c.begin != c.end; c = claim(wanted)) {
    offer_unclaimed(c.end, range_ns);
    run(c);
    const auto after = Clock::now();
    const float claim_ns = nanoseconds_between(before, after);
    const float measured = claim_ns / static_cast<float>(c.end - c.begin);
    if (claim_ns >= kTrustedNs || measured < range_ns) range_ns = measured;
    wanted = ranges_a_claim(range_ns, wanted);
    before = after;
    ran += c.end - c.begin;
  }
  crew_.close(*this);
  failure_.rethrow_if_any();
  return ran == 0 ? 0.0f : nanoseconds_between(start, before) / static_cast<float>(ran);
}

}  // namespace gloam
