// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/picture_error.h"

#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/metrics/edge_error.h"
#include "modules/accuracy/metrics/linear_error.h"
#include "modules/accuracy/metrics/statistics.h"

namespace gloam {

PictureJudge::PictureJudge(FramePictures reference) : reference_(std::move(reference)) {
  GLOAM_ASSERT(reference_.linear.width > 0 || reference_.picture.width > 0,
               "a reference has linear light, a picture, or both");
  if (reference_.picture.width == 0) return;
  features_ = flip_features(pixels_of(reference_.picture));
  near_edges_ = near_edges(pixels_of(reference_.picture));
}

Status PictureJudge::judge(const FramePictures& frame, LedgerRow& row, std::vector<float>* flip_map) const {
  if (features_) {
    const EncodedPixels test = pixels_of(frame.picture);
    std::vector<float> map = flip_error_map(*features_, flip_features(test));
    const ErrorStatistics flip = statistics_of(map);
    if (const auto edges = edge_error(near_edges_, map, pixels_of(reference_.picture), test))
      row.edges = {.flip = {edges->flip.mean, edges->flip.p99}, .psnr_db = edges->psnr_db, .share = edges->share};
    if (flip_map != nullptr) *flip_map = std::move(map);
    row.flip = {.mean = flip.mean, .p99 = flip.p99};
    row.psnr_db = psnr_db(pixels_of(reference_.picture), test);
  }
  if (reference_.linear.width > 0) {
    const auto error = rms_error(pixels_of(reference_.linear), pixels_of(frame.linear));
    if (!error) return error.error();
    row.rmse = error->rmse;
    row.rmse_p99 = error->pixels.p99;
  }
  return {};
}

Status judge_sequence(const std::vector<LinearPicture>& reference, const std::vector<LinearPicture>& frames,
                      LedgerRow& row) {
  const auto pixels = [](const std::vector<LinearPicture>& pictures) {
    std::vector<LinearPixels> result;
    for (const LinearPicture& picture : pictures) result.push_back(pixels_of(picture));
    return result;
  };
  const auto error = temporal_error(pixels(reference), pixels(frames));
  if (!error) return error.error();
  row.temporal = {.mean = error->mean, .p99 = error->p99};
  return {};
}

}  // namespace gloam
