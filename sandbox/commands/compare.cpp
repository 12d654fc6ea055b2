// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "engine/core/text/formatted.h"
#include "engine/scene/decoding/image_file.h"
#include "modules/accuracy/picture_difference.h"
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
  const auto found = picture_difference(*picture, *reference);
  if (!found) {
    return Error{ErrorKind::failed, formatted("the pictures have other sizes: %ux%u and %ux%u", picture->width,
                                              picture->height, reference->width, reference->height)};
  }
  context.console.print(formatted("FLIP %.5f, root mean square %.3f of 255, largest difference %d of 255\n",
                                  found->flip, std::sqrt(found->mean_square), found->largest));
  if (found->flip <= options.most_flip) return {};
  return Error{ErrorKind::failed, formatted("the mean FLIP %.5f is above %g", found->flip, options.most_flip)};
}

}  // namespace gloam
