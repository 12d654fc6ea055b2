// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "modules/shadows/reference/statistics.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Error of drawn shadows against traced shadows, with a hash of both visibilities.
struct JudgedShadows : ShadowError {
  std::uint64_t hash = 0;
};

/// Draws frames of a session from one camera and compares each light's visibility with rays. The destructor restores
/// the knobs that `set` changed. Starts with shadows.mode=monolithic, because most benches time and judge filters.
class ShadowCase {
 public:
  ShadowCase(Session& session, std::uint32_t width, std::uint32_t height);
  ~ShadowCase();
  ShadowCase(const ShadowCase&) = delete;
  ShadowCase& operator=(const ShadowCase&) = delete;

  [[nodiscard]] Session& session() { return session_; }
  /// Sets a knob, for example "shadows.filter" to "hard".
  [[nodiscard]] Status set(const std::string& knob, const std::string& value);
  /// Restores the user's value of a knob.
  void set_back(const std::string& knob);
  [[nodiscard]] Result<FrameSample> draw(const std::string& visualizer = "none");
  /// Traced visibility at the camera's pixels. Traced by the first call only.
  [[nodiscard]] Result<const TracedVisibility*> traced();
  /// Draws the visibility of a light at each pixel with the current knobs. Negative where the light does not reach.
  [[nodiscard]] Result<std::vector<float>> drawn(Entity light);
  /// Error over all traced lights, with the current knobs.
  [[nodiscard]] Result<JudgedShadows> error();
  /// Hash of the last picture that `draw` drew.
  [[nodiscard]] Result<std::uint64_t> picture_hash();
  /// Hash of an image that passes of the last frame exposed; draws that frame once more.
  [[nodiscard]] Result<std::uint64_t> image_hash(std::string_view name);
  /// The last picture that `draw` drew.
  [[nodiscard]] Result<Picture> picture();
  /// Draws all later frames from a pose (world_from_camera, rigid) instead of the camera's pose, with the camera's
  /// lens.
  void look_from(const dmat4& pose);

 private:
  /// A unique name of the light, which is added if it is missing.
  [[nodiscard]] std::string name_of(Entity light);

  Session& session_;
  ViewSettings settings_;
  std::map<std::string, std::string> users_;  ///< values of the changed knobs before the change
  std::optional<TracedVisibility> traced_;
};

/// Sum of the milliseconds of all passes with this name in a frame.
[[nodiscard]] double pass_ms(const FrameSample& sample, std::string_view name);

}  // namespace gloam
