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

/// Assumed cost of a job that was never measured: infinite, so that calling helpers always seems worthwhile.
inline constexpr float kUnknownCost = std::numeric_limits<float>::infinity();

/// Remembers the cost of the jobs of each call site, so that the next call knows at its start whether helpers pay off.
/// A site is identified by the type of its lambda. Costs affect speed only: jobs are measured again while they run, so
/// it does no harm if two sites share an entry or the work of a site changes.
class SiteCosts {
 public:
  using Site = std::size_t;

  /// `salt` distinguishes calls that have the same lambda type but different shapes of work.
  [[nodiscard]] static Site site(const std::type_info& type, std::size_t salt);

  /// Nanoseconds per unit of work; kUnknownCost if the site is not known.
  [[nodiscard]] float recall(Site site) const;

  /// Moves the remembered cost halfway to `ns` (nanoseconds per unit of work), so that the effect of one preemption
  /// fades within a few calls.
  void learn(Site site, float ns);

 private:
  struct Entry {
    std::atomic<Site> site = 0;
    std::atomic<float> ns = kUnknownCost;
  };
  std::array<Entry, 256> entries_;
};

}  // namespace gloam
