// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/result.h"
#include "engine/render/view.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Chooses ViewSettings::heat_range for the frames of a window. With views.range=fit the scale follows the picture: at
/// once after a change of the view, then now and then, because a fit waits for a frame.
class HeatFollower {
 public:
  /// Before each frame that may have another range. shown: the last frame was shown.
  [[nodiscard]] Status choose(Session& session, ViewSettings& view, bool shown);

  /// The first fit to the present view is still to come, so its picture is not the final one.
  [[nodiscard]] bool is_due() const { return due_; }

 private:
  std::string fitted_view_;  ///< the visualizer that the range was fitted to; empty: none
  std::uint32_t frames_to_fit_ = 0;
  bool due_ = false;
};

}  // namespace gloam
