// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/render/knobs/measure.h"
#include "sandbox/bench/harness/camera_path.h"
#include "sandbox/session/session.h"

namespace gloam::test {

struct FlightSize {
  std::uint32_t width = 96;
  std::uint32_t height = 54;
  std::size_t frames = 300;
  std::size_t check_every = 5;  ///< frames from one check of the lists, pixel by pixel, to the next
};

/// Draws one frame after another along a path, as in play: no extra frames settle buffers first.
class Flight {
 public:
  Flight(Session& session, std::span<const PathKey> keys, const FlightSize& size)
      : session_(session),
        keys_(keys),
        frames_(size.frames),
        request_{session.view_settings(size.width, size.height, "none"), {}} {
    request_.settings.follow_camera = false;
  }

  [[nodiscard]] Result<Picture> draw(std::size_t frame) {
    request_.settings.world_from_camera = path_pose(keys_, frame, frames_);
    session_.set_clock(static_cast<double>(frame) / 60.0, 1.0 / 60.0);
    const auto sample = session_.render_frame(request_);
    if (!sample) return sample.error();
    counters_ = sample->report.counters;
    return session_.renderer->read_picture(request_.settings.id);
  }
  /// Counter of the last frame; 0 if it was not counted.
  [[nodiscard]] double counter(const char* name) const {
    const auto found = counters_.find(name);
    return found == counters_.end() ? 0.0 : found->second;
  }
  [[nodiscard]] bool counts(const char* name) const { return counters_.contains(name); }

 private:
  Session& session_;
  std::span<const PathKey> keys_;
  std::size_t frames_;
  ViewRequest request_;
  FrameCounters counters_;
};

}  // namespace gloam::test
