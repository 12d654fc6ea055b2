// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Whole frames of a scene and the yardstick (one full-screen pass of 48 gathers a pixel), alternating: times in
/// nanoseconds, pair by pair.
struct FrameTimes {
  std::vector<double> scene_ns;
  std::vector<double> gather_ns;
  std::uint64_t scene_hash = 0;
  std::uint64_t gather_hash = 0;
};

/// Draws without shadows while it lives: what is held against bars of frames and of light lists has none.
class WithoutShadows {
 public:
  explicit WithoutShadows(Session& session);
  ~WithoutShadows();
  WithoutShadows(const WithoutShadows&) = delete;
  WithoutShadows& operator=(const WithoutShadows&) = delete;

 private:
  KnobRegistry& knobs_;
  std::string users_;
};

/// Of the session's camera at the size of the options, without shadows.
[[nodiscard]] Result<FrameTimes> measure_frames(Session& session, const Options& options);

}  // namespace gloam
