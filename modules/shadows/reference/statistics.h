// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "modules/shadows/filter/traced_visibility.h"

namespace gloam {

/// How drawn visibilities differ from traced ones. Counts are pairs of a light and a pixel that it reaches; layers are
/// summed with +=.
///
/// Silhouette: where traced visibility crosses one half between two pixels. A pixel with a silhouette to one of its
/// eight neighbours may show either side, as the edge is at most a pixel away.
struct ShadowError {
  std::uint64_t pairs = 0;
  std::uint64_t penumbra_pairs = 0;  ///< traced visibility 0.05…0.95
  double difference = 0.0;           ///< sum of absolute differences over `pairs`
  double penumbra_difference = 0.0;  ///< the same over `penumbra_pairs`
  std::uint64_t off = 0;             ///< off by more than 0.1
  std::uint64_t wrong = 0;           ///< off by more than 0.5, away from silhouettes
  std::uint64_t acne = 0;            ///< traced fully lit, drawn below 0.5, away from silhouettes
  std::uint64_t leaks = 0;           ///< traced unlit, drawn above 0.5, away from silhouettes
  std::uint64_t faint_leaks = 0;     ///< traced unlit, drawn above 0.1, away from silhouettes
  /// Pixels with traced rays that shading finds out of the light's reach, because floats round differently from
  /// doubles. They are in no pair.
  std::uint64_t unreached = 0;

  [[nodiscard]] double mean() const { return share(difference, pairs); }
  [[nodiscard]] double penumbra_mean() const { return share(penumbra_difference, penumbra_pairs); }
  [[nodiscard]] double off_share() const { return share(static_cast<double>(off), pairs); }
  [[nodiscard]] double faint_leak_share() const { return share(static_cast<double>(faint_leaks), pairs); }
  [[nodiscard]] double wrong_share() const { return share(static_cast<double>(wrong), pairs); }
  [[nodiscard]] double acne_share() const { return share(static_cast<double>(acne), pairs); }
  [[nodiscard]] double leak_share() const { return share(static_cast<double>(leaks), pairs); }
  ShadowError& operator+=(const ShadowError& other);

 private:
  [[nodiscard]] static double share(double sum, std::uint64_t count) {
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  }
};

/// Compares one layer. drawn: visibility 0 … 1 of the layer's light at each pixel, or negative where shading finds that
/// the light does not reach the pixel. A pixel counts as a pair only if both tracing and shading find it within the
/// light's reach.
[[nodiscard]] ShadowError compare_visibility(const TracedVisibility& traced, std::uint32_t layer,
                                             std::span<const float> drawn);

}  // namespace gloam
