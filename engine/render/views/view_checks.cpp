// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/views/view_checks.h"

#include <algorithm>
#include <set>
#include <string>

namespace gloam {
namespace {

bool is_picture(gpu::Format format) {
  using enum gpu::Format;
  return format == rgba8_unorm || format == rgba8_srgb || format == bgra8_unorm || format == bgra8_srgb;
}

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_light_target(const gpu::Device& device, const ViewRequest& request, const std::string& view) {
  const LightTarget& light = *request.target.light;
  GLOAM_ASSERT(!request.target.image && !request.target.acquire && !request.target.overlay,
               view + ": a view has a picture or a LightTarget, not both");
  GLOAM_ASSERT(light.image, view + ": LightTarget has no image");
  const gpu::ImageDesc& desc = device.desc(light.image);
  GLOAM_ASSERT(light.mip < desc.mips && light.layer < desc.layers,
               view + ": LightTarget names mip " + std::to_string(light.mip) + " of layer " +
                   std::to_string(light.layer) + ", and its image \"" + desc.name + "\" has " +
                   std::to_string(desc.mips) + " mips and " + std::to_string(desc.layers) + " layers");
  GLOAM_ASSERT(gpu::has(desc.usage, gpu::ImageUsage::color_target),
               view + ": the image \"" + desc.name + "\" of LightTarget was made without ImageUsage::color_target");
}

}  // namespace

void check_ids(std::span<const ViewRequest> requests) {
  std::set<std::uint32_t> ids;
  for (const ViewRequest& request : requests) {
    const std::uint32_t id = request.settings.id.value;
    GLOAM_ASSERT(id - CompanionViews::kFirstId >= CompanionViews::kMost * CompanionViews::kMostMainIds,
                 "view " + std::to_string(id) + ": ids from CompanionViews::kFirstId on are for companions");
    GLOAM_ASSERT(ids.insert(id).second, "view " + std::to_string(id) + " is requested twice in one frame");
  }
}

Status acquire_target(const gpu::Device& device, ViewRequest& request) {
  if (!request.target.acquire) return {};
  const auto image = request.target.acquire();
  if (!image.ok()) return image.error();
  request.target.image = *image;
  if (!*image) return {};
  const gpu::ImageDesc& desc = device.desc(*image);
  if (request.target.width > 0) {
    // A window that shrinks meanwhile may be smaller than the view.
    request.target.width = desc.width;
    request.target.height = desc.height;
    request.settings.width = std::min(request.settings.width, desc.width);
    request.settings.height = std::min(request.settings.height, desc.height);
    return {};
  }
  request.settings.width = desc.width;
  request.settings.height = desc.height;
  return {};
}

Status check_size(const ViewSettings& settings) {
  if (settings.width <= kMostViewPixels && settings.height <= kMostViewPixels) return {};
  return Error{ErrorKind::usage, "view " + std::to_string(settings.id.value) + " is " +
                                     size_text(settings.width, settings.height) + " pixels: a view has at most " +
                                     std::to_string(kMostViewPixels) + " a side"};
}

void check_target(const gpu::Device& device, const ViewRequest& request) {
  const ViewSettings& settings = request.settings;
  const ViewTarget& target = request.target;
  const std::string view = "view " + std::to_string(settings.id.value);
  GLOAM_ASSERT(target.width == 0 || (target.width >= settings.width && target.height >= settings.height),
               view + " is " + size_text(settings.width, settings.height) + " pixels, its picture " +
                   size_text(target.width, target.height) + ": a picture is not smaller than its view");
  if (request.geometry) {
    GLOAM_ASSERT(request.geometry->width() == settings.width && request.geometry->height() == settings.height,
                 view + " is " + size_text(settings.width, settings.height) + " pixels, the host's geometry " +
                     size_text(request.geometry->width(), request.geometry->height()) + ": they must have one size");
  }
  if (request.target.light) check_light_target(device, request, view);
  if (!request.target.image) return;
  const gpu::ImageDesc& desc = device.desc(request.target.image);
  const bool enlarged = request.target.width > 0 && may_enlarge(request) && desc.width == request.target.width &&
                        desc.height == request.target.height;
  GLOAM_ASSERT(enlarged || (desc.width == settings.width && desc.height == settings.height),
               view + " is " + size_text(settings.width, settings.height) + " pixels, its target image \"" + desc.name +
                   "\" " + size_text(desc.width, desc.height) + ": they must have one size");
  GLOAM_ASSERT(is_picture(desc.format), view + ": a target image is rgba8 or bgra8, UNORM or sRGB, and \"" + desc.name +
                                            "\" is " + std::string(name_of(desc.format)));
  GLOAM_ASSERT(gpu::has(desc.usage, gpu::ImageUsage::color_target),
               view + ": the target image \"" + desc.name + "\" was made without ImageUsage::color_target");
}

bool may_enlarge(const ViewRequest& request) {
  const ViewSettings& settings = request.settings;
  return settings.purpose == ViewPurpose::main && settings.visualizer == "none" && !settings.lens &&
         !request.target.light && !request.geometry;
}

}  // namespace gloam
