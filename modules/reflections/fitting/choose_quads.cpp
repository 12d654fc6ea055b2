// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/choose_quads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gloam {
namespace {

/// The rays' first proxies, for a growing set.
class Coverage {
 public:
  Coverage(std::span<const ReflectedRay> rays, std::span<const std::vector<RayMeeting>> meetings)
      : rays_(rays), meetings_(meetings), nearest_(rays.size(), std::numeric_limits<float>::infinity()) {}

  /// Rays caught more, less rays caught no more, if the candidate is added.
  [[nodiscard]] std::int64_t gain(std::size_t candidate) const {
    std::int64_t gain = 0;
    for (const RayMeeting& meeting : meetings_[candidate])
      if (meeting.distance_m < nearest_[meeting.ray])
        gain += worth(meeting.ray, meeting.distance_m) - worth(meeting.ray, nearest_[meeting.ray]);
    return gain;
  }
  void add(std::size_t candidate) {
    for (const RayMeeting& meeting : meetings_[candidate])
      nearest_[meeting.ray] = std::min(nearest_[meeting.ray], meeting.distance_m);
  }

 private:
  /// A misplaced proxy is worse than none: the ray would be answered by a cube map.
  [[nodiscard]] std::int64_t worth(std::uint32_t ray, float distance_m) const {
    if (!std::isfinite(distance_m)) return 0;
    constexpr std::int64_t kCaught = 4;
    return is_caught(rays_[ray], static_cast<double>(distance_m)) ? kCaught : -1;
  }

  std::span<const ReflectedRay> rays_;
  std::span<const std::vector<RayMeeting>> meetings_;
  std::vector<float> nearest_;
};

struct Best {
  std::uint32_t candidate = 0;
  std::int64_t gain = 0;
};

/// The candidate with the largest gain; the first of equals. gain 0: none has any.
Best best_candidate(const Coverage& coverage, std::size_t candidates, JobExecutor& jobs) {
  constexpr std::size_t kGrain = 64;
  std::vector<Best> parts((candidates + kGrain - 1) / kGrain);
  jobs.parallel_for(candidates, kGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (const std::int64_t gain = coverage.gain(i); gain > parts[range.ordinal].gain)
        parts[range.ordinal] = {static_cast<std::uint32_t>(i), gain};
  });
  Best best;
  for (const Best& part : parts)
    if (part.gain > best.gain) best = part;
  return best;
}

}  // namespace

std::vector<std::uint32_t> choose_quads(std::span<const PlacedProxy> candidates, std::size_t count,
                                        std::span<const PlacedRoom> rooms, std::span<const ReflectedRay> rays,
                                        JobExecutor& jobs) {
  const std::vector<std::vector<RayMeeting>> meetings = meet_rays(candidates, rooms, rays, jobs);
  std::vector<std::uint32_t> chosen;
  Coverage coverage(rays, meetings);
  while (chosen.size() < count) {
    const Best best = best_candidate(coverage, candidates.size(), jobs);
    if (best.gain <= 0) break;
    coverage.add(best.candidate);
    chosen.push_back(best.candidate);
  }
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::uint32_t& exchanged : chosen) {
      Coverage others(rays, meetings);
      for (const std::uint32_t kept : chosen)
        if (kept != exchanged) others.add(kept);
      const Best best = best_candidate(others, candidates.size(), jobs);
      if (best.gain <= others.gain(exchanged)) continue;
      exchanged = best.candidate;
      changed = true;
    }
    if (!changed) break;
  }
  return chosen;
}

}  // namespace gloam
