// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/profiler.h"

namespace gloam {

/// One timed span of work on one thread. Times are nanoseconds since the recorder was constructed.
struct Zone {
  std::string name;
  std::string module;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint32_t thread = 0;  ///< small number, assigned in order of first appearance
};

/// Collects zones from any thread.
class ZoneRecorder final : public Profiler {
 public:
  ZoneRecorder();
  [[nodiscard]] std::uint64_t now_ns() const;
  void begin_zone(std::string_view name, std::string_view module) override;
  void end_zone() override;
  void record(std::string_view name, std::string_view module, std::uint64_t begin_ns, std::uint64_t end_ns);
  /// Returns and removes the zones recorded since the last call, sorted by begin time.
  [[nodiscard]] std::vector<Zone> take();

 private:
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  [[nodiscard]] std::size_t number_of_this_thread();

  std::vector<Zone> zones_;
  std::vector<std::uint64_t> threads_;
  std::vector<std::vector<Zone>> open_;  ///< by thread: zones that have not ended, outermost first
};

}  // namespace gloam
