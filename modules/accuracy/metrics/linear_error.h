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
  double rmse = 0.0;       ///< root mean square over all pixels and the three channels
  ErrorStatistics pixels;  ///< statistics of `map`
  std::vector<float> map;  ///< per pixel: root mean square over its three channels
};

/// RMS error in linear light, in the unit of the pictures, which must have the same size. Fails with ErrorKind::failed
/// if a channel is not finite; the error names the pixel.
[[nodiscard]] Result<RmsError> rms_error(const LinearPixels& reference, const LinearPixels& test);

/// Change from frame to frame that the reference does not have (flicker, popping): statistics of |(test_i+1 − test_i) −
/// (reference_i+1 − reference_i)|, root mean square over the three channels, over all pixels and all pairs of
/// consecutive frames. The same number of frames on both sides, all of one size; 0 for fewer than two. Errors as
/// rms_error.
[[nodiscard]] Result<ErrorStatistics> temporal_error(std::span<const LinearPixels> reference,
                                                     std::span<const LinearPixels> test);

/// Peak signal-to-noise ratio of encoded pictures of one size, in decibels; infinity if they are identical.
[[nodiscard]] double psnr_db(const EncodedPixels& reference, const EncodedPixels& test);

}  // namespace gloam
