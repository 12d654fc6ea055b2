// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// One timed span of work on one thread. Times are nanoseconds since the recorder was constructed.
struct Zone {
  std::string name;
  std::string module;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint32_t thread = 0;  ///< small number, assigned in order of first appearance
};

/// Collects zones from any thread. Code that may be measured takes a pointer to it; a null pointer records nothing.
class ZoneRecorder {
 public:
  ZoneRecorder();
  [[nodiscard]] std::uint64_t now_ns() const;
  void record(std::string_view name, std::string_view module, std::uint64_t begin_ns, std::uint64_t end_ns);
  /// Returns and removes the zones recorded since the last call, sorted by begin time.
  [[nodiscard]] std::vector<Zone> take();

 private:
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  std::vector<Zone> zones_;
  std::vector<std::uint64_t> threads_;
};

/// Records a zone from its construction to its destruction. `recorder` (may be null), `name` and `module` must outlive
/// it.
class ScopedZone {
 public:
  ScopedZone(ZoneRecorder* recorder, std::string_view name, std::string_view module)
      : recorder_(recorder), name_(name), module_(module), begin_ns_(recorder != nullptr ? recorder->now_ns() : 0) {}
  ~ScopedZone() {
    if (recorder_ != nullptr) recorder_->record(name_, module_, begin_ns_, recorder_->now_ns());
  }
  ScopedZone(const ScopedZone&) = delete;
  ScopedZone& operator=(const ScopedZone&) = delete;

 private:
  ZoneRecorder* recorder_;
  std::string_view name_;
  std::string_view module_;
  std::uint64_t begin_ns_;
};

}  // namespace gloam
