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

/// Frames of a session from one camera, and what of each light they show held against rays. Knobs that it sets it sets
/// back. Shadow maps are looked up where light is added up until shadows.mode is set otherwise: filters are what most
/// benches time and judge.
class ShadowCase {
 public:
  ShadowCase(Session& session, std::uint32_t width, std::uint32_t height);
  ~ShadowCase();
  ShadowCase(const ShadowCase&) = delete;
  ShadowCase& operator=(const ShadowCase&) = delete;

  [[nodiscard]] Session& session() { return session_; }
  /// "shadows.filter", "hard".
  [[nodiscard]] Status set(const std::string& knob, const std::string& value);
  /// As the user had it.
  void set_back(const std::string& knob);
  [[nodiscard]] Result<FrameSample> draw(const std::string& visualizer = "none");
  /// Of the camera's pixels, once.
  [[nodiscard]] Result<const TracedVisibility*> traced();
  /// Visibility of a light at each pixel as shadow maps give it with the knobs as they are; below 0 where it does not
  /// reach.
  [[nodiscard]] Result<std::vector<float>> drawn(Entity light);
  /// All lights that were traced, with the knobs as they are.
  [[nodiscard]] Result<ShadowError> error();
  /// Hash of the last picture that `draw` drew.
  [[nodiscard]] Result<std::uint64_t> picture_hash();
  /// The last picture that `draw` drew.
  [[nodiscard]] Result<Picture> picture();
  /// From here on frames are drawn from a pose (world_from_camera, rigid) instead of the camera's, with its lens.
  void look_from(const dmat4& pose);

 private:
  /// A name of the light that no other has.
  [[nodiscard]] std::string name_of(Entity light);

  Session& session_;
  ViewSettings settings_;
  std::map<std::string, std::string> users_;  ///< knobs as they were
  std::optional<TracedVisibility> traced_;
};

/// Milliseconds of all passes of a frame with a name.
[[nodiscard]] double pass_ms(const FrameSample& sample, std::string_view name);

}  // namespace gloam
