// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/core/text/nearest_name.h"
#include "engine/render/redraw/redraw.h"
#include "engine/scene/transmission.h"

namespace gloam {
namespace {

const FrameBuilder::Exposed* find_exposed(const FrameBuilder& frame, std::string_view name) {
  const auto found = std::ranges::find(frame.exposed(), name, &FrameBuilder::Exposed::name);
  return found == frame.exposed().end() ? nullptr : &*found;
}

Error unknown_image(const FrameBuilder& frame, std::string_view name) {
  std::vector<std::string> names;
  for (const FrameBuilder::Exposed& exposed : frame.exposed()) names.emplace_back(exposed.name);
  return {ErrorKind::usage, "the last frame has no image " + std::string(name) + "; " + valid_names(name, names)};
}

/// A finished copy as items of T; empty if there is no copy of that name.
template <class T>
std::vector<T> items_of(const Captures& copies, std::string_view name) {
  const std::span<const std::byte> bytes = copies.bytes(name);
  std::vector<T> items(bytes.size() / sizeof(T));
  if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  return items;
}

}  // namespace

Result<std::vector<ImageBytes>> read_images(RendererParts& parts, World& world, ViewId view,
                                            std::span<const std::string_view> names) {
  std::vector<ImageBytes> images(names.size());
  Status all_there;
  const auto add_copies = [&](FrameBuilder& builder, Captures& copies) -> Status {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const FrameBuilder::Exposed* found = find_exposed(builder, names[i]);
      if (found == nullptr) {
        all_there = unknown_image(builder, names[i]);
        return {};
      }
      const ImageRef newest = builder.graph().newest(found->image);
      const gpu::ImageDesc& desc = builder.graph().desc(newest);
      images[i] = {desc.width, desc.height, desc.format, {}};
      GLOAM_TRY(copies.add(builder.graph(), names[i], newest));
    }
    return {};
  };
  const auto redrawn = redraw(parts, world, view, add_copies);
  if (!redrawn.ok()) return redrawn.error();
  if (!all_there.ok()) return all_there.error();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::span<const std::byte> bytes = redrawn->copies->bytes(names[i]);
    images[i].bytes.assign(bytes.begin(), bytes.end());
  }
  return images;
}

Result<GeometryPicture> read_geometry(RendererParts& parts, World& world, ViewId view) {
  const auto add_copies = [](FrameBuilder& builder, Captures& copies) -> Status {
    for (const std::string_view name : {"depth", "base_color", "normals", "material", "smooth_surfaces", "emissive"}) {
      if (name == "emissive" && !lets_light_through(builder.world())) continue;
      if (const FrameBuilder::Exposed* found = find_exposed(builder, name))
        GLOAM_TRY(copies.add(builder.graph(), name, builder.graph().newest(found->image)));
    }
    return {};
  };
  const auto redrawn = redraw(parts, world, view, add_copies);
  if (!redrawn.ok()) return redrawn.error();
  GeometryPicture picture;
  picture.view = redrawn->builder().view();
  picture.error_share = depth_error_share(parts.options.device->info().subpixel_bits);
  picture.depth = items_of<float>(*redrawn->copies, "depth");
  picture.base_color = items_of<std::uint32_t>(*redrawn->copies, "base_color");
  picture.normals = items_of<uvec2>(*redrawn->copies, "normals");
  picture.material = items_of<std::uint32_t>(*redrawn->copies, "material");
  picture.emissive = items_of<uvec2>(*redrawn->copies, "emissive");
  picture.smooth_surfaces = items_of<uvec2>(*redrawn->copies, "smooth_surfaces");
  return picture;
}

}  // namespace gloam
