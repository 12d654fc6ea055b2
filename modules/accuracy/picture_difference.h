// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/scene/assets.h"

namespace gloam {

/// How much a picture differs from a reference of the same size.
struct PictureDifference {
  double flip = 0.0;         ///< mean over the pixels, 0…1 (modules/accuracy/metrics/flip.h)
  double mean_square = 0.0;  ///< of the encoded channels, 0…255²
  int largest = 0;           ///< of a channel, 0…255
};

/// None if the sizes differ or a picture has no pixel. Alpha does not count.
[[nodiscard]] std::optional<PictureDifference> picture_difference(const Image& picture, const Image& reference);

}  // namespace gloam
