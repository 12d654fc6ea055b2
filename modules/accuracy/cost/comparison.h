// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// A reference, the hash of its picture and light, and its noise (LedgerRow::reference_noise).
struct NoisyReference {
  PictureJudge judge;
  std::string hash;
  double noise = 0.0;
};

/// Sets the row's errors and pictures by a reference, and gives the pictures to progress.
[[nodiscard]] Status compare(const NoisyReference& reference, const FramePictures& frame, CostProgress& progress,
                             LedgerRow& row);

}  // namespace gloam
