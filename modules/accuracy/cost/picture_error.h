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

/// A reference that pictures are held against, one by one.
class PictureJudge {
 public:
  /// At least one side of the reference is there.
  explicit PictureJudge(FramePictures reference);

  /// Sets flip, psnr_db, rmse and rmse_p99 of the row, as far as the reference has the side. frame: both sides, of the
  /// reference's size.
  [[nodiscard]] Status judge(const FramePictures& frame, LedgerRow& row) const;

 private:
  FramePictures reference_;
  std::optional<FlipFeatures> features_;
};

/// Sets row.temporal from frames that follow each other. As many of each.
[[nodiscard]] Status judge_sequence(const std::vector<LinearPicture>& reference,
                                    const std::vector<LinearPicture>& frames, LedgerRow& row);

}  // namespace gloam
