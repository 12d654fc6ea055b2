// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"
#include "engine/render/readback/picture.h"
#include "modules/depth_of_field/components.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr const char* kLensScene = "builtin:lens";
/// The reason for rows without a camera to measure.
inline constexpr const char* kNoFocus = "no camera of the scene has a focus";

[[nodiscard]] constexpr const char* bokeh_name(Bokeh bokeh) { return bokeh == Bokeh::round ? "round" : "hexagonal"; }

/// Frames of builtin:lens, or of the scene that the user named, through a camera with a focus.
class DofFrames {
 public:
  /// The camera is the user's, or the first one with a focus. It gets this bokeh. Null if no camera has a focus.
  [[nodiscard]] static Result<std::unique_ptr<DofFrames>> open(BenchContext& context, Bokeh bokeh);

  [[nodiscard]] Session& session() { return *session_; }
  [[nodiscard]] Status set(std::string_view knob, std::string_view value);
  /// Turns depth of field of the camera on or off.
  void turn(bool on);
  /// Opens the lens so far that every circle of confusion has the greatest radius, all behind the focus.
  void blur_everything();
  /// Draws a frame and waits for it.
  [[nodiscard]] Result<FrameSample> draw();
  /// Linear light of the last frame.
  [[nodiscard]] Result<LinearPicture> linear();

 private:
  explicit DofFrames(std::unique_ptr<Session> session) : session_(std::move(session)) {}
  [[nodiscard]] DepthOfField& lens();

  std::unique_ptr<Session> session_;
  ViewSettings settings_;
  float focus_m_ = 0.0f;  ///< of the camera while depth of field is on
};

/// Opened frames by bokeh, for the rows of one file.
class DofFramesPool {
 public:
  /// Null if no camera has a focus.
  [[nodiscard]] Result<DofFrames*> get(BenchContext& context, Bokeh bokeh);

 private:
  std::map<Bokeh, std::unique_ptr<DofFrames>> opened_;
};

/// GPU times of the module's passes in one frame, nanoseconds.
struct DofTimes {
  double tiles_ns = 0.0;
  double prefilter_ns = 0.0;
  double blur_ns = 0.0;
  double compose_ns = 0.0;
  [[nodiscard]] double all_ns() const { return tiles_ns + prefilter_ns + blur_ns + compose_ns; }
};
[[nodiscard]] DofTimes dof_times(const FrameSample& sample);

/// Hash of a picture's light, to the bit.
[[nodiscard]] std::uint64_t hash_of_dof_light(const LinearPicture& picture);

}  // namespace gloam
