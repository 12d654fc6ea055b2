// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include "engine/core/nearest_name.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/renderer_state.h"

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

template <class T>
std::vector<T> items_of(const ImageBytes& image) {
  std::vector<T> items(image.bytes.size() / sizeof(T));
  if (!items.empty()) std::memcpy(items.data(), image.bytes.data(), items.size() * sizeof(T));
  return items;
}

}  // namespace

Status Renderer::draw_again(World& world, ViewId view, std::function<Status(FrameBuilder&)> add_copies) {
  State& s = *state_;
  const std::vector<ViewRequest> all = s.last_requests;
  const auto last = std::ranges::find(all, view, [](const ViewRequest& request) { return request.settings.id; });
  GLOAM_ASSERT(last != all.end(),
               "view " + std::to_string(view.value) + ": what is read back must be of a view of the last frame");
  GLOAM_ASSERT(s.images.at(view.value).world == s.slot_of(world).value,
               "view " + std::to_string(view.value) + " was drawn of another world");
  ViewRequest redraw = *last;
  redraw.target = {};  // the image of a window may be gone
  redraw.settings.width = s.images.at(view.value).width;
  redraw.settings.height = s.images.at(view.value).height;
  s.copies = std::make_unique<Captures>(*s.options.device);
  s.copy_request = CopyRequest{view, std::move(add_copies)};
  Status drawn;
  try {
    drawn = render(world, std::span(&redraw, 1));
  } catch (...) {
    s.copy_request.reset();
    s.copies.reset();
    s.last_requests = all;
    throw;
  }
  s.copy_request.reset();
  s.last_requests = all;
  if (drawn.ok()) drawn = wait();
  if (drawn.ok())
    s.copies->finish();
  else
    s.copies.reset();
  return drawn;
}

Result<std::vector<ImageBytes>> Renderer::read_images(World& world, ViewId view,
                                                      std::span<const std::string_view> names) {
  State& s = *state_;
  std::vector<ImageBytes> images(names.size());
  Status all_there;
  const auto add_copies = [&](FrameBuilder& frame) -> Status {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const FrameBuilder::Exposed* found = find_exposed(frame, names[i]);
      if (found == nullptr) {
        all_there = unknown_image(frame, names[i]);
        return {};
      }
      const ImageRef newest = frame.graph().newest(found->image);
      const gpu::ImageDesc& desc = frame.graph().desc(newest);
      images[i] = {desc.width, desc.height, desc.format, {}};
      GLOAM_TRY(s.copies->add(frame.graph(), names[i], newest));
    }
    return {};
  };
  GLOAM_TRY(draw_again(world, view, add_copies));
  if (all_there.ok()) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::span<const std::byte> bytes = s.copies->bytes(names[i]);
      images[i].bytes.assign(bytes.begin(), bytes.end());
    }
  }
  s.copies.reset();
  if (!all_there.ok()) return all_there.error();
  return images;
}

Result<ImageBytes> Renderer::read_image(World& world, ViewId view, std::string_view name) {
  auto images = read_images(world, view, std::span(&name, 1));
  if (!images.ok()) return images.error();
  return std::move(images->front());
}

Result<GeometryPicture> Renderer::read_geometry(World& world, ViewId view) {
  static constexpr std::string_view kNames[] = {"depth", "base_color", "normals", "material"};
  const auto images = read_images(world, view, kNames);
  if (!images.ok()) return images.error();
  GeometryPicture picture;
  picture.view = state_->builders.back()->view();
  picture.depth = items_of<float>((*images)[0]);
  picture.base_color = items_of<std::uint32_t>((*images)[1]);
  picture.normals = items_of<uvec2>((*images)[2]);
  picture.material = items_of<std::uint32_t>((*images)[3]);
  if (find_exposed(*state_->builders.back(), "smooth_surfaces") == nullptr) return picture;
  const auto smooth = read_image(world, view, "smooth_surfaces");
  if (!smooth.ok()) return smooth.error();
  picture.smooth_surfaces = items_of<uvec2>(*smooth);
  return picture;
}

}  // namespace gloam
