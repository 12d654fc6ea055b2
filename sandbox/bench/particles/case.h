// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr const char* kSmokeScene = "builtin:smoke";

/// A session of builtin:smoke without shadows.
class ParticleCase {
 public:
  /// camera: of the scene.
  [[nodiscard]] static Result<std::unique_ptr<ParticleCase>> open(BenchContext& context, const std::string& camera);

  /// Replaces all emitters by one cloud of dust between the lamps with this many sprites, each at most 8 pixels wide
  /// for the camera "far".
  void use_dust(double particles);
  /// Sets a knob.
  [[nodiscard]] Status set(std::string_view knob, std::string_view value);
  /// Draws the frame of the next 60th of a second and waits for it.
  [[nodiscard]] Result<FrameSample> draw();
  /// Hash of the linear light of the last frame.
  [[nodiscard]] Result<std::uint64_t> hash();

 private:
  explicit ParticleCase(std::unique_ptr<Session> session) : session_(std::move(session)) {}

  std::unique_ptr<Session> session_;
  ViewSettings settings_;
  double time_s_ = 0.0;
};

/// GPU times of the particles of one frame, nanoseconds.
struct ParticleTimes {
  double simulation_ns = 0.0;
  double sort_ns = 0.0;  ///< with the digits of the keys
  double light_ns = 0.0;
  double drawing_ns = 0.0;
  [[nodiscard]] double all_ns() const { return simulation_ns + sort_ns + light_ns + drawing_ns; }
};
[[nodiscard]] ParticleTimes particle_times(const FrameSample& sample);

}  // namespace gloam
