// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/zones.h"

#include <algorithm>
#include <functional>
#include <thread>

namespace gloam {

ZoneRecorder::ZoneRecorder() : start_(std::chrono::steady_clock::now()) {}

std::uint64_t ZoneRecorder::now_ns() const {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
}

void ZoneRecorder::record(std::string_view name, std::string_view module, std::uint64_t begin_ns,
                          std::uint64_t end_ns) {
  const std::uint64_t id = std::hash<std::thread::id>{}(std::this_thread::get_id());
  const std::lock_guard lock(mutex_);
  auto known = std::find(threads_.begin(), threads_.end(), id);
  if (known == threads_.end()) known = threads_.insert(threads_.end(), id);
  zones_.push_back(
      {std::string(name), std::string(module), begin_ns, end_ns, static_cast<std::uint32_t>(known - threads_.begin())});
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
