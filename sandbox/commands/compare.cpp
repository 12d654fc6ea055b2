// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/core/text/formatted.h"
#include "engine/scene/decoding/image_file.h"
#include "modules/accuracy/metrics/flip.h"
#include "sandbox/commands/commands.h"

namespace gloam {
namespace {

Result<Image> read_compared(const std::string& path) {
  Result<Image> image = read_image_file(path);
  if (!image) return Error{ErrorKind::input, path + ": " + image.error().message};
  return image;
}

}  // namespace

Status run_compare(const CommandContext& context) {
  const Options& options = context.options;
  const auto picture = read_compared(options.names[0]);
  if (!picture) return picture.error();
  const auto reference = read_compared(options.names[1]);
  if (!reference) return reference.error();
  const EncodedPixels a{picture->width, picture->height, picture->rgba};
  const EncodedPixels b{reference->width, reference->height, reference->rgba};
  if (!a.same_size(b)) {
    return Error{ErrorKind::failed,
                 formatted("the pictures have other sizes: %ux%u and %ux%u", a.width, a.height, b.width, b.height)};
  }
  double flip = 0.0, squares = 0.0;
  int largest = 0;
  for (const float error : flip_error_map(flip_features(b), flip_features(a))) flip += static_cast<double>(error);
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const int difference = std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    squares += static_cast<double>(difference) * difference;
    largest = std::max(largest, difference);
  }
  const auto pixels = static_cast<double>(a.count());
  flip /= pixels;
  context.console.print(formatted("FLIP %.5f, root mean square %.3f of 255, largest difference %d of 255\n", flip,
                                  std::sqrt(squares / (3.0 * pixels)), largest));
  if (flip <= options.most_flip) return {};
  return Error{ErrorKind::failed, formatted("the mean FLIP %.5f is above %g", flip, options.most_flip)};
}

}  // namespace gloam
