// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <typeinfo>

namespace gloam {

/// What a job costs before anything was measured: so much that helpers are worth their wake-up.
inline constexpr float kUnknownCost = std::numeric_limits<float>::infinity();

/// Remembers what the jobs of a call site cost last time, so that the next call knows before it starts whether helpers
/// pay. A site is told by the type of its lambda. Only speed depends on these numbers: two sites that share an entry,
/// or a site whose work changes, are measured anew while they run.
class SiteCosts {
 public:
  using Site = std::size_t;

  /// `salt` keeps calls with one lambda type but different shapes of work apart.
  [[nodiscard]] static Site site(const std::type_info& type, std::size_t salt);

  /// Nanoseconds a unit of work; kUnknownCost if this site was not seen.
  [[nodiscard]] float recall(Site site) const;

  /// Moves halfway to the new measurement: one preemption is forgotten after a few calls.
  void learn(Site site, float ns);

 private:
  struct Entry {
    std::atomic<Site> site = 0;
    std::atomic<float> ns = kUnknownCost;
  };
  std::array<Entry, 256> entries_;
};

}  // namespace gloam
