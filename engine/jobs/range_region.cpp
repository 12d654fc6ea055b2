// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/range_region.h"

#include <algorithm>

#include "engine/jobs/job_graph.h"

namespace gloam {
namespace {

/// A claim should take about this long: claiming and reading the clock are then below one percent.
constexpr float kClaimNs = 10'000.0f;

std::size_t ranges_a_claim(float range_ns, std::size_t last) {
  if (range_ns * static_cast<float>(last) * 8.0f <= kClaimNs) return last * 8;
  return std::max<std::size_t>(1, static_cast<std::size_t>(kClaimNs / range_ns));
}

}  // namespace

RangeRegion::RangeRegion(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body, Crew& crew)
    : count_(count), grain_(grain), ranges_(range_count(count, grain)), body_(body), crew_(crew) {}

bool RangeRegion::has_work() const {
  return next_.load(std::memory_order_relaxed) < std::min(ranges_, failure_.index());
}

RangeRegion::Claim RangeRegion::claim(std::size_t wanted) {
  std::size_t begin = next_.load(std::memory_order_relaxed);
  while (begin < std::min(ranges_, failure_.index())) {
    const std::size_t fair = (ranges_ - begin) / (2 * std::size_t{crew_.threads()});
    const std::size_t end = begin + std::max<std::size_t>(1, std::min(wanted, fair));
    if (next_.compare_exchange_weak(begin, end, std::memory_order_relaxed)) return {begin, end};
  }
  return {};
}

void RangeRegion::run(Claim claim) {
  // Ranges below the lowest failure always run, so the exception that the caller sees does not depend on timing.
  for (std::size_t i = claim.begin; i < claim.end && i < failure_.index(); ++i) {
    try {
      body_(job_range(i, count_, grain_));
    } catch (...) {
      failure_.record(i, std::current_exception());
    }
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

void RangeRegion::offer_rest(std::size_t claimed_end, float range_ns) {
  const std::size_t rest = ranges_ - std::min(claimed_end, ranges_);
  if (rest == 0) return;
  const float rest_ns = range_ns * static_cast<float>(rest);
  const float worthwhile_ns = crew_.worthwhile_ns();
  if (rest_ns < worthwhile_ns) return;
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
  for (Claim c = claim(wanted); c.begin != c.end; c = claim(wanted)) {
    offer_rest(c.end, range_ns);
    run(c);
    const auto after = Clock::now();
    range_ns = nanoseconds_between(before, after) / static_cast<float>(c.end - c.begin);
    wanted = ranges_a_claim(range_ns, wanted);
    before = after;
    ran += c.end - c.begin;
  }
  crew_.close(*this);
  failure_.rethrow_if_any();
  return ran == 0 ? 0.0f : nanoseconds_between(start, before) / static_cast<float>(ran);
}

}  // namespace gloam
