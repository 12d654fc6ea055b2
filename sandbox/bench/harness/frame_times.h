// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "modules/shadows/outputs.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Times of whole frames of a scene and of the gather pass (48 gathers per pixel), measured alternately, in
/// nanoseconds. Item i of both vectors is a pair.
struct MeasuredFrames {
  std::vector<double> scene_ns;
  std::vector<double> gather_ns;
  std::uint64_t scene_hash = 0;
  std::uint64_t gather_hash = 0;
};

/// Turns shadows off during its lifetime: the bars of frames and light lists are for frames without shadows.
class WithoutShadows {
 public:
  explicit WithoutShadows(Session& session);
  ~WithoutShadows();
  WithoutShadows(const WithoutShadows&) = delete;
  WithoutShadows& operator=(const WithoutShadows&) = delete;

 private:
  KnobRegistry& knobs_;
  ShadowMode users_;
};

/// Measures frames of the session's camera at the size of the options, without shadows.
[[nodiscard]] Result<MeasuredFrames> measure_frames(Session& session, const Options& options);

}  // namespace gloam
