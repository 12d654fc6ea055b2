// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/readback/picture.h"
#include "sandbox/bench/grass/probe.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr const char* kMeadow = "builtin:meadow";
inline constexpr double kGrassFrame_s = 1.0 / 60.0;

/// A session of builtin:meadow without shadows, whose frames' grass can be read. Its clock starts at 0.
class GrassCase {
 public:
  /// camera: of the scene. Size in pixels.
  [[nodiscard]] static Result<std::unique_ptr<GrassCase>> open(BenchContext& context, const std::string& camera,
                                                               std::uint32_t width, std::uint32_t height);

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] GrassProbe& probe() { return *probe_; }
  /// Sets a knob, for example "grass.masters" to "1:4".
  [[nodiscard]] Status set(std::string_view knob, std::string_view value);
  void set_size(std::uint32_t width, std::uint32_t height);
  /// The scene's time before the next frame.
  void set_time(double time_s) { time_s_ = time_s; }
  /// Destroys all components that move grass apart from the wind.
  void remove_colliders();
  /// Lets the next frame begin with all blades at rest, at time 0 and step 0.
  void restart();
  /// Advances the clock, draws a frame and waits for it.
  [[nodiscard]] Result<FrameSample> draw(double dt_s);
  /// The same, and reads the frame's grass.
  [[nodiscard]] Result<GrassReading> draw_and_read(double dt_s);
  /// Linear light and picture of the last frame.
  [[nodiscard]] Result<LinearPicture> linear();
  [[nodiscard]] Result<Picture> picture();
  /// Share of the last frame's pixels that show grass.
  [[nodiscard]] Result<double> coverage();

 private:
  GrassCase(std::unique_ptr<Session> session, GrassProbe* probe) : session_(std::move(session)), probe_(probe) {}

  std::unique_ptr<Session> session_;
  GrassProbe* probe_;
  ViewSettings settings_;
  double time_s_ = 0.0;
};

/// GPU times of the grass of one frame, nanoseconds.
struct GrassTimes {
  double sort_ns = 0.0;
  double lod_ns = 0.0;  ///< keys, counts of live blades, list of masters; without the sort
  double simulation_ns = 0.0;
  double drawing_ns = 0.0;  ///< poses and the draws into the geometry buffer
  [[nodiscard]] double all_ns() const { return sort_ns + lod_ns + simulation_ns + drawing_ns; }
};
[[nodiscard]] GrassTimes grass_times(const FrameSample& sample);

/// A counter of the frame ("grass.live"); 0 if it is missing.
[[nodiscard]] double counter_of(const FrameSample& sample, const std::string& name);

/// Hash of the poses and knots of the live blades, to the bit. It does not depend on their places in the buffers.
[[nodiscard]] std::uint64_t hash_of_poses(const GrassReading& reading);

/// The means of squares of side × side pixels. The picture's size must be a multiple of `side`.
[[nodiscard]] LinearPicture averaged(const LinearPicture& picture, std::uint32_t side);

/// Largest distance within which at most `live` blades were live. bins: GrassReading::bins. range_m: distance of key
/// 255.
[[nodiscard]] double distance_of_live(std::span<const std::uint32_t> bins, double range_m, std::uint32_t live);

}  // namespace gloam
