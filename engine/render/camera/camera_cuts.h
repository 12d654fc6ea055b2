// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>

#include "engine/render/view.h"

namespace gloam {

/// Finds the frames in which a view's camera is cut: its first frame, frames with ViewSettings::camera_cut, and frames
/// with another camera entity or another kind of projection than the view's last committed frame. A cut in a frame
/// that is given up is one of the next frame.
class CameraCuts {
 public:
  /// Call it once per frame, before the first declare. Gives up a frame that was not committed.
  void begin_frame();
  /// The newest frame of the view with a cut, this one included. frame: number among the world's frames; the same as in
  /// the last committed frame if that is drawn again. settings: after follow_camera.
  [[nodiscard]] std::uint64_t declare(std::uint64_t world, const ViewSettings& settings, std::uint64_t frame);
  /// Ends a frame that was submitted.
  void commit();
  void forget_world(std::uint64_t world);
  void forget_view(ViewId view);

 private:
  struct Key {
    std::uint64_t world = 0;
    std::uint32_t view = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Seen {
    Entity camera = kNoEntity;
    bool orthographic = false;
    std::uint64_t frame = 0;
    std::uint64_t cut_frame = 0;
  };
  struct Item {
    std::optional<Seen> last;      ///< the last committed frame's
    std::optional<Seen> declared;  ///< that of the frame being declared
    bool cut_stated = false;       ///< by the caller, since the last committed frame
  };
  std::map<Key, Item> items_;
};

}  // namespace gloam
