// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/picture_difference.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "modules/accuracy/metrics/flip.h"

namespace gloam {

std::optional<PictureDifference> picture_difference(const Image& picture, const Image& reference) {
  const EncodedPixels a{picture.width, picture.height, picture.rgba};
  const EncodedPixels b{reference.width, reference.height, reference.rgba};
  if (!a.same_size(b) || !a.whole() || !b.whole()) return std::nullopt;
  PictureDifference difference;
  const auto pixels = static_cast<double>(a.count());
  for (const float error : flip_error_map(flip_features(b), flip_features(a)))
    difference.flip += static_cast<double>(error) / pixels;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const int own = std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    difference.mean_square += static_cast<double>(own) * own / (3.0 * pixels);
    difference.largest = std::max(difference.largest, own);
  }
  return difference;
}

}  // namespace gloam
