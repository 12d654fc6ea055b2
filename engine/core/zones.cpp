// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/zones.h"

#include <algorithm>
#include <functional>
#include <thread>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {

ZoneRecorder::ZoneRecorder() : start_(std::chrono::steady_clock::now()) {}

std::uint64_t ZoneRecorder::now_ns() const {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
}

std::size_t ZoneRecorder::number_of_this_thread() {
  const std::uint64_t id = std::hash<std::thread::id>{}(std::this_thread::get_id());
  const auto known = std::find(threads_.begin(), threads_.end(), id);
  if (known != threads_.end()) return static_cast<std::size_t>(known - threads_.begin());
  threads_.push_back(id);
  open_.emplace_back();
  return threads_.size() - 1;
}

void ZoneRecorder::begin_zone(std::string_view name, std::string_view module) {
  const std::uint64_t begin_ns = now_ns();
  const std::lock_guard lock(mutex_);
  const std::size_t thread = number_of_this_thread();
  open_[thread].push_back(
      {std::string(name), std::string(module), begin_ns, begin_ns, static_cast<std::uint32_t>(thread)});
}

void ZoneRecorder::end_zone() {
  const std::uint64_t end_ns = now_ns();
  const std::lock_guard lock(mutex_);
  std::vector<Zone>& open = open_[number_of_this_thread()];
  GLOAM_ASSERT(!open.empty(), "ZoneRecorder::end_zone needs begin_zone on the same thread");
  open.back().end_ns = end_ns;
  zones_.push_back(std::move(open.back()));
  open.pop_back();
}

void ZoneRecorder::record(std::string_view name, std::string_view module, std::uint64_t begin_ns,
                          std::uint64_t end_ns) {
  const std::lock_guard lock(mutex_);
  const auto thread = static_cast<std::uint32_t>(number_of_this_thread());
  zones_.push_back({std::string(name), std::string(module), begin_ns, end_ns, thread});
}

std::vector<Zone> ZoneRecorder::take() {
  std::vector<Zone> taken;
  {
    const std::lock_guard lock(mutex_);
    taken.swap(zones_);
  }
  std::stable_sort(taken.begin(), taken.end(), [](const Zone& a, const Zone& b) { return a.begin_ns < b.begin_ns; });
  return taken;
}

}  // namespace gloam
