// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/view.h"
#include "sandbox/session/session.h"

namespace gloam {

/// What a picture shows, apart from the knobs that budgets set: pictures of equal moments can be compared.
struct PictureMoment {
  std::vector<double> numbers;  ///< of camera, time, lights, knobs
  std::string visualizer;
  bool operator==(const PictureMoment&) const = default;
};

/// The moment of the session's next frame. time_s: simulated, or any constant if the time changes nothing in the scene.
[[nodiscard]] PictureMoment picture_moment(const Session& session, const ViewSettings& view, double time_s);

/// Whether pictures of the scene change with time: something is animated, or a module that was demanded by the last
/// frame changes the picture by itself (Module::changes_at_rest).
[[nodiscard]] bool scene_moves(const Session& session);

}  // namespace gloam
