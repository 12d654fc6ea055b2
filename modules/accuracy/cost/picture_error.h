// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/readback/picture.h"
#include "engine/render/reference/reference.h"
#include "modules/accuracy/metrics/flip.h"
#include "modules/accuracy/metrics/pixels.h"
#include "modules/accuracy/outputs.h"

namespace gloam {

[[nodiscard]] inline EncodedPixels pixels_of(const Picture& picture) {
  return {picture.width, picture.height, picture.rgba};
}
[[nodiscard]] inline LinearPixels pixels_of(const LinearPicture& picture) {
  return {picture.width, picture.height, picture.rgba};
}

/// A reference that pictures are compared with.
class PictureJudge {
 public:
  /// The reference must have at least one side (linear light or picture).
  explicit PictureJudge(FramePictures reference);

  /// Sets flip, psnr_db and edges of the row if the reference has a picture, rmse and rmse_p99 if it has linear light.
  /// `frame`: linear light and picture, of the reference's size. flip_map: gets the FLIP of each pixel if not null and
  /// the reference has a picture.
  [[nodiscard]] Status judge(const FramePictures& frame, LedgerRow& row, std::vector<float>* flip_map = nullptr) const;
  [[nodiscard]] const FramePictures& reference() const { return reference_; }

 private:
  FramePictures reference_;
  std::optional<FlipFeatures> features_;
  std::vector<bool> near_edges_;  // of the reference's picture
};

/// Sets row.temporal from consecutive frames; the same number on both sides.
[[nodiscard]] Status judge_sequence(const std::vector<LinearPicture>& reference,
                                    const std::vector<LinearPicture>& frames, LedgerRow& row);

}  // namespace gloam
