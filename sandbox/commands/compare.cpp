// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/scene/decoding/image_file.h"
#include "engine/scene/scene_path.h"
#include "modules/accuracy/picture_difference.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/pictures/image_io.h"

namespace gloam {
namespace {

struct Compared {
  Image image;
  std::uint32_t legend_rows = 0;
};

Result<Compared> read_compared(const std::string& path) {
  const auto fault = [&](const Error& error) { return Error{ErrorKind::input, path + ": " + error.message}; };
  const auto file = read_scene_file(path);
  if (!file) return fault(file.error());
  Result<Image> image = decode_image(*file);
  if (!image) return fault(image.error());
  return Compared{std::move(image).value(), legend_rows_of(*file)};
}

/// Without its last rows, at least one of which stays.
void cut_rows(Image& image, std::uint32_t rows) {
  image.height -= std::min(rows, image.height - 1);
  image.rgba.resize(std::size_t{image.width} * image.height * 4);
}

}  // namespace

Status run_compare(const CommandContext& context) {
  const Options& options = context.options;
  auto first = read_compared(options.names[0]);
  if (!first) return first.error();
  auto second = read_compared(options.names[1]);
  if (!second) return second.error();
  Image &picture = first->image, &reference = second->image;
  if (picture.width != reference.width || picture.height != reference.height) {
    return Error{ErrorKind::failed, formatted("the pictures have other sizes: %ux%u and %ux%u", picture.width,
                                              picture.height, reference.width, reference.height)};
  }
  // Legends of views state how to read the colours. Where either picture has one, there is nothing to compare.
  const std::uint32_t legend_rows = std::max(first->legend_rows, second->legend_rows);
  cut_rows(picture, legend_rows);
  cut_rows(reference, legend_rows);
  const auto found = picture_difference(picture, reference);
  if (!found) return Error{ErrorKind::failed, "the pictures have no pixel"};
  context.console.print(formatted("FLIP %.5f, root mean square %.3f of 255, largest difference %d of 255\n",
                                  found->flip, std::sqrt(found->mean_square), found->largest));
  if (found->flip <= options.most_flip) return {};
  return Error{ErrorKind::failed, formatted("the mean FLIP %.5f is above %g", found->flip, options.most_flip)};
}

}  // namespace gloam
