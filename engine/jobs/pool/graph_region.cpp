// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/graph_region.h"

#include <algorithm>

#include "engine/jobs/job_graph.h"
#include "engine/jobs/pool/site_costs.h"

namespace gloam {
namespace {

constexpr std::uint32_t kLongestSamplePeriod = 8;

}  // namespace

GraphRegion::GraphRegion(std::span<JobNode> nodes, Crew& crew, float node_ns)
    : nodes_(nodes), crew_(crew), pending_(pending_counts(nodes)), node_ns_(node_ns), remaining_(nodes.size()) {}

float GraphRegion::lead() {
  const InsideRegion inside(*this);
  Lane lane;
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // backward, so that the first node is on top of the stack
    if (pending_[i] == 0) lane.ready.push_back(static_cast<std::uint32_t>(i));
  }
  drain(lane);
  while (remaining_.load(std::memory_order_acquire) > 0) {
    crew_.wait(*this, [&] { return has_work() || remaining_.load(std::memory_order_acquire) == 0; });
    lane.sampled_at = Clock::now();
    drain(lane);
  }
  crew_.close(*this);
  failure_.rethrow_if_any();
  return node_ns_.load(std::memory_order_relaxed);
}

void GraphRegion::help() {
  Lane lane;
  drain(lane);
}

void GraphRegion::drain(Lane& lane) {
  do {
    while (!lane.ready.empty()) {
      const std::uint32_t node = lane.ready.back();
      lane.ready.pop_back();
      run_chain(lane, node);
    }
  } while (take_shared(lane));
  remaining_.fetch_sub(lane.done, std::memory_order_acq_rel);
  lane.done = 0;
}

void GraphRegion::run_chain(Lane& lane, std::uint32_t node) {
  while (node != kNone) {
    share(lane);
    node = finish_node(lane, node, run_node(node));
    ++lane.done;
    if (++lane.since_sample >= lane.sample_period) sample(lane);
  }
}

bool GraphRegion::run_node(std::uint32_t node) {
  const std::uint32_t pending = std::atomic_ref(pending_[node]).load(std::memory_order_relaxed);
  if ((pending & kSkipNode) != 0) return false;
  try {
    nodes_[node].work();
    return true;
  } catch (...) {
    failure_.record(node, std::current_exception());
    return false;
  }
}

std::uint32_t GraphRegion::finish_node(Lane& lane, std::uint32_t node, bool succeeded) {
  std::uint32_t next = kNone;
  for (const std::uint32_t successor : nodes_[node].successors) {
    const std::atomic_ref pending(pending_[successor]);
    if (!succeeded) pending.fetch_or(kSkipNode, std::memory_order_relaxed);
    if ((pending.fetch_sub(1, std::memory_order_acq_rel) & ~kSkipNode) != 1) continue;
    if (next == kNone) {
      next = successor;
    } else {
      lane.ready.push_back(successor);
    }
  }
  return next;
}

void GraphRegion::sample(Lane& lane) {
  const auto now = Clock::now();
  const float measured = nanoseconds_between(lane.sampled_at, now) / static_cast<float>(lane.since_sample);
  const float believed = node_ns_.load(std::memory_order_relaxed);
  node_ns_.store(believed == kUnknownCost ? measured : (believed + measured) * 0.5f, std::memory_order_relaxed);
  lane.sampled_at = now;
  lane.since_sample = 0;
  lane.sample_period = std::min(lane.sample_period * 2, kLongestSamplePeriod);
}

void GraphRegion::share(Lane& lane) {
  if (lane.ready.empty() || crew_.threads() == 1 || shared_count_.load(std::memory_order_relaxed) > 0) return;
  const float ready_ns = node_ns_.load(std::memory_order_relaxed) * static_cast<float>(lane.ready.size());
  const float worthwhile_ns = crew_.worthwhile_ns();
  if (ready_ns < worthwhile_ns) return;
  const std::size_t given = (lane.ready.size() + 1) / 2;  // bottom of the stack: nodes that this thread would run last
  {
    const std::lock_guard lock(shared_mutex_);
    const auto begin = lane.ready.begin();
    shared_.insert(shared_.end(), begin, begin + static_cast<std::ptrdiff_t>(given));
    lane.ready.erase(begin, begin + static_cast<std::ptrdiff_t>(given));
    shared_count_.store(shared_.size(), std::memory_order_release);
  }
  const float limit = static_cast<float>(std::min<std::size_t>(given, crew_.threads() - 1));
  crew_.offer(*this, static_cast<std::uint32_t>(std::min(limit, ready_ns / worthwhile_ns)));
}

bool GraphRegion::take_shared(Lane& lane) {
  if (!has_work()) return false;
  const std::lock_guard lock(shared_mutex_);
  if (shared_.empty()) return false;
  const std::size_t taken = (shared_.size() + crew_.threads() - 1) / crew_.threads();
  for (std::size_t i = 0; i < taken; ++i) {
    lane.ready.push_back(shared_.back());
    shared_.pop_back();
  }
  shared_count_.store(shared_.size(), std::memory_order_release);
  return true;
}

}  // namespace gloam
