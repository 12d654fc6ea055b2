// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/reference/reference.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

inline constexpr const char* kWetStreet = "builtin:wet_street";

/// The courtyard that benches measure: the file that the user named if its name starts with "courtyard", else
/// ../shared/scenes/courtyard/courtyard.gltf. None if that does not exist.
[[nodiscard]] std::optional<std::string> courtyard_scene(const BenchContext& context);
/// The reason for rows that courtyard_scene() leaves without a scene.
[[nodiscard]] std::string no_courtyard();

/// Draws frames of a session's camera with changed knobs. The destructor restores the knobs.
class ReflectionFrames {
 public:
  ReflectionFrames(Session& session, std::uint32_t width, std::uint32_t height);
  ~ReflectionFrames();
  ReflectionFrames(const ReflectionFrames&) = delete;
  ReflectionFrames& operator=(const ReflectionFrames&) = delete;

  [[nodiscard]] Session& session() { return session_; }
  /// Sets a knob, for example "reflections.tiers" to "cube".
  [[nodiscard]] Status set(const std::string& knob, const std::string& value);
  /// Draws a frame and waits for it.
  [[nodiscard]] Result<FrameSample> draw();
  /// Draws all later frames from a pose (world_from_camera, rigid) with the camera's lens.
  void look_from(const dmat4& pose);
  /// The next frame begins with a camera cut.
  void cut() { settings_.camera_cut = true; }
  /// Linear light of the last frame.
  [[nodiscard]] Result<LinearPicture> linear();
  /// Hash of the last frame's linear light, to the bit.
  [[nodiscard]] Result<std::uint64_t> hash();

 private:
  Session& session_;
  ViewSettings settings_;
  std::map<std::string, std::string> users_;  ///< values of the changed knobs before the change
};

/// Draws a frame with this reflections.mode. hash: set to that of its light.
[[nodiscard]] Result<FrameSample> draw_in_mode(ReflectionFrames& frames, const char* mode, std::uint64_t& hash);

/// Milliseconds of all passes of the module reflections in the main view.
[[nodiscard]] double reflection_ms(const FrameSample& sample);
/// Milliseconds of all passes of other views than the main one, without those that draw shadow maps; 0 without other
/// views.
[[nodiscard]] double companion_ms(const FrameSample& sample);

/// A walk of `count` poses (world_from_camera): along the street of builtin:wet_street at eye height, with looks to the
/// facades and onto the ground; in other scenes along a closed path through all cameras. With `down`, every tenth pose
/// looks straight down.
[[nodiscard]] std::vector<dmat4> recorded_walk(const Session& session, const std::string& scene, std::size_t count,
                                               bool down);

/// Hash of a picture's light, to the bit.
[[nodiscard]] std::uint64_t hash_of_light(const LinearPicture& picture);

}  // namespace gloam
