// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/comparison.h"

#include <vector>

#include "modules/accuracy/cost/error_pictures.h"
#include "modules/accuracy/cost/frame_identity.h"

namespace gloam {

Status compare(const NoisyReference& reference, const FramePictures& frame, CostProgress& progress, LedgerRow& row) {
  progress.phase(CostPhase::comparison);
  std::vector<float> flip;
  GLOAM_TRY(reference.judge.judge(frame, row, &flip));
  row.picture = hash_of(frame);
  GLOAM_TRY(progress.picture(row.picture, frame.picture));
  const Picture& right = reference.judge.reference().picture;
  if (right.width == 0) return {};
  row.reference_picture = reference.hash;
  GLOAM_TRY(progress.picture(row.reference_picture, right));
  if (row.heat_map().empty()) return {};
  row.worst = worst_areas(flip, right.width, right.height);
  GLOAM_TRY(progress.picture(row.heat_map(), heat_map(flip, right.width, right.height)));
  if (row.worst.empty()) return {};
  return progress.picture(row.worst_areas(), side_by_side(frame.picture, right, row.worst));
}

}  // namespace gloam
