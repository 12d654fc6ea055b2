// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/render/kept_frames/digest_commands.h"
#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// What is kept of the last frame as a whole.
enum class FrameReuse : std::uint8_t {
  off,    ///< nothing: the GPU draws every frame
  exact,  ///< all of it while nothing changes; the picture is the same to the bit
};
constexpr std::string_view name_of(FrameReuse reuse) {
  switch (reuse) {
    case FrameReuse::off:
      return "off";
    case FrameReuse::exact:
      return "exact";
  }
  return {};
}

inline constexpr EnumKnob<FrameReuse> kFrameReuse{
    .name = "scene.reuse",
    .meaning =
        "frames that are not drawn again: none, or those whose commands and data are the same as in the frames before "
        "them (exact: the picture is the same to the bit); only views with pictures of their own, in worlds without "
        "simulations, while shadows.reuse and lighting.reuse are not off; cost and bench set off, so that what they "
        "measure at rest is what a moving camera pays",
    .default_value = FrameReuse::exact,
    .exact = FrameReuse::off,
    .same_picture = true};

/// Finds frames that would only write what is there already. Their commands are recorded and hashed (DigestCommands),
/// but not given to the GPU. The inputs must be those of the last four frames, so that decisions which are made from
/// results of earlier frames have settled. Resources and notes may swap their roles from frame to frame, so the places
/// are compared with those of the frame two before, which has left its results there.
class KeptFrames {
 public:
  /// Whether a frame with this digest repeats the frames before it.
  [[nodiscard]] bool repeats(const FrameDigest& digest) const {
    return count_ >= last_.size() && digest == last_[1] && last_[0] == last_[2] && last_[1] == last_[3] &&
           last_[0].inputs == last_[1].inputs;
  }
  /// Notes a committed frame, kept or drawn.
  void add(const FrameDigest& digest) {
    std::shift_right(last_.begin(), last_.end(), 1);
    last_.front() = digest;
    count_ = std::min(count_ + 1, last_.size());
  }
  /// Notes a frame of which nothing is known.
  void restart() { count_ = 0; }

 private:
  std::array<FrameDigest, 4> last_{};  ///< newest first
  std::size_t count_ = 0;
};

}  // namespace gloam
