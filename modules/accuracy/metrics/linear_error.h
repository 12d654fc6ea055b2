// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/metrics/pixels.h"
#include "modules/accuracy/metrics/statistics.h"

namespace gloam {

struct RmsError {
  double rmse = 0.0;       ///< root of the mean square over all pixels and the three channels
  ErrorStatistics pixels;  ///< of `map`
  std::vector<float> map;  ///< a pixel's root of the mean square over its three channels
};

/// Error in linear light, in its unit. Pictures of one size. Error that names the place when a channel is not a finite
/// number.
[[nodiscard]] Result<RmsError> rms_error(const LinearPixels& reference, const LinearPixels& test);

/// Change from frame to frame that the reference does not have (flicker, popping): of |(test_i+1 − test_i) −
/// (reference_i+1 − reference_i)|, root mean square over the three channels, over all pixels and all pairs of
/// neighbouring frames. As many frames of each, all of one size; fewer than two have no change. Errors as rms_error.
[[nodiscard]] Result<ErrorStatistics> temporal_error(std::span<const LinearPixels> reference,
                                                     std::span<const LinearPixels> test);

/// Ratio of peak signal to noise of encoded pictures of one size, in decibels; infinity when they are the same.
[[nodiscard]] double psnr_db(const EncodedPixels& reference, const EncodedPixels& test);

}  // namespace gloam
