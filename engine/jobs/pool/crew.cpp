// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/crew.h"

#include <algorithm>
#include <thread>

namespace gloam {
namespace {

constexpr std::chrono::microseconds kSpinTime{25};
constexpr int kPausesBeforeYield = 128;

thread_local std::uint32_t t_depth = 0;  // depth of the innermost region on the thread's stack, across all executors

void pause_core() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

Region::Region() : depth_(t_depth + 1) {}

InsideRegion::InsideRegion(const Region& region) : outer_depth_(t_depth) { t_depth = region.depth(); }
InsideRegion::~InsideRegion() { t_depth = outer_depth_; }

CrewState::CrewState(std::uint32_t threads) : crowded(threads > Crew::core_count()) {}

void CrewState::release() {
  if (holders.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
}

bool CrewState::help_deeper_than(std::uint32_t depth, bool was_idle) {
  // A thread that has seen the epoch of an offer sees the offered region here.
  if (first.load(std::memory_order_acquire) == nullptr) return false;
  Region* region = nullptr;
  {
    const std::lock_guard lock(mutex);
    region = first.load(std::memory_order_relaxed);
    while (region != nullptr && (region->depth_ <= depth || !region->has_work())) region = region->next_;
    if (region == nullptr) return false;
    region->helpers_.fetch_add(1, std::memory_order_relaxed);
  }
  if (was_idle) idle.fetch_sub(1, std::memory_order_relaxed);
  {
    const InsideRegion inside(*region);
    region->help();
  }
  if (was_idle) idle.fetch_add(1, std::memory_order_relaxed);
  region->helpers_.fetch_sub(1, std::memory_order_release);  // the region may be destroyed from here on
  announce();
  return true;
}

bool CrewState::spin(std::uint32_t seen) const {
  for (int i = 0; i < kPausesBeforeYield && !crowded; ++i) {
    if (epoch.now(std::memory_order_acquire) != seen) return true;
    pause_core();
  }
  const auto deadline = Clock::now() + kSpinTime;
  while (epoch.now(std::memory_order_acquire) == seen) {
    std::this_thread::yield();
    if (Clock::now() >= deadline) return false;
  }
  return true;
}

void CrewState::visit() {
  while (!closing.load(std::memory_order_relaxed)) {
    const std::uint32_t seen = epoch.now(std::memory_order_seq_cst);
    if (help_deeper_than(0, true) || spin(seen)) continue;
    // An offer that still counted this helper as idle had advanced the epoch before it read `idle`.
    idle.fetch_sub(1, std::memory_order_seq_cst);
    if (epoch.now(std::memory_order_seq_cst) == seen) return;
    idle.fetch_add(1, std::memory_order_relaxed);
  }
  idle.fetch_sub(1, std::memory_order_relaxed);
}

namespace {

/// One visit of a helper.
void run_visit(void* of) {
  auto* state = static_cast<CrewState*>(of);
  (void)state->holders.load(std::memory_order_acquire);  // pairs with the increment in call_helpers
  state->visit();
  state->release();
}

}  // namespace

std::uint32_t Crew::core_count() { return SharedWorkers::core_count(); }

std::unique_ptr<OwnThreads> Crew::scarce_threads(std::uint32_t helpers) {
  if (helpers == 0) return nullptr;
  if (!SharedWorkers::exist()) return std::make_unique<OwnThreads>(helpers);
  // oneTBB may start more threads than it needs: where a thread is to work and has not gone to sleep yet, it starts
  // one.
  const std::uint32_t plenty = 2 * helpers + 8;
  auto started = std::make_unique<OwnThreads>(plenty);
  const bool scarce = started->count() < plenty;
  started->keep(scarce ? std::min(helpers, started->count() / 2) : 0);  // other libraries need threads, too
  return scarce ? std::move(started) : nullptr;
}

Crew::Crew(std::uint32_t threads)
    : own_threads_(scarce_threads(threads - 1)),
      threads_(own_threads_ == nullptr ? threads : own_threads_->count() + 1),
      state_(new CrewState(threads_)),
      workers_(threads_ > 1 && own_threads_ == nullptr ? SharedWorkers::create(threads_) : nullptr) {}

Crew::~Crew() {
  state_->closing.store(true, std::memory_order_relaxed);
  state_->announce();
  // Runs the visits that are still enqueued; they leave at once. A visit that never runs would keep the state alive
  // forever.
  workers_.reset();
  own_threads_.reset();
  state_->release();
}

void Crew::call_helpers(std::uint32_t wanted) {
  wanted = std::min(wanted, threads_ - 1);
  std::uint32_t holders = state_->holders.load(std::memory_order_relaxed);
  while (state_->idle.load(std::memory_order_seq_cst) < wanted && holders < threads_) {
    if (!state_->holders.compare_exchange_weak(holders, holders + 1, std::memory_order_release,
                                               std::memory_order_relaxed)) {
      continue;
    }
    ++holders;
    state_->idle.fetch_add(1, std::memory_order_relaxed);
    if (own_threads_ != nullptr)
      own_threads_->enqueue([state = state_] { run_visit(state); });
    else
      workers_->enqueue(run_visit, state_);
  }
}

void Crew::offer(Region& region, std::uint32_t wanted) {
  if (!region.open_) {
    region.open_ = true;
    const std::lock_guard lock(state_->mutex);
    region.next_ = state_->first.load(std::memory_order_relaxed);
    state_->first.store(&region, std::memory_order_release);
  }
  state_->announce();
  call_helpers(wanted);
}

void Crew::wait(const Region& region, const std::function<bool()>& done) {
  while (true) {
    const std::uint32_t seen = state_->epoch.now(std::memory_order_seq_cst);
    if (done()) return;
    if (state_->help_deeper_than(region.depth_, false) || state_->spin(seen)) continue;
    state_->epoch.sleep(seen);
  }
}

void Crew::close(Region& region) {
  if (!region.open_) return;
  {
    const std::lock_guard lock(state_->mutex);
    Region* before = state_->first.load(std::memory_order_relaxed);
    if (before == &region) {
      state_->first.store(region.next_, std::memory_order_release);
    } else {
      while (before->next_ != &region) before = before->next_;
      before->next_ = region.next_;
    }
  }
  region.open_ = false;
  wait(region, [&] { return region.helpers_.load(std::memory_order_acquire) == 0; });
}

}  // namespace gloam
