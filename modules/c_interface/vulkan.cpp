// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <span>

#include "engine/gpu/vulkan_interop.h"
#include "engine/render/host_geometry.h"
#include "modules/c_interface/handles.h"

// The parts of the interface that take a host's Vulkan objects.

namespace gloam::c_interface {
namespace {

gpu::Format format_of(std::uint32_t format) {
  switch (static_cast<VkFormat>(format)) {
    case VK_FORMAT_R8G8B8A8_UNORM:
      return gpu::Format::rgba8_unorm;
    case VK_FORMAT_R8G8B8A8_SRGB:
      return gpu::Format::rgba8_srgb;
    case VK_FORMAT_B8G8R8A8_UNORM:
      return gpu::Format::bgra8_unorm;
    case VK_FORMAT_B8G8R8A8_SRGB:
      return gpu::Format::bgra8_srgb;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return gpu::Format::rgba16_float;
    case VK_FORMAT_R32_SFLOAT:
      return gpu::Format::r32_float;
    case VK_FORMAT_D32_SFLOAT:
      return gpu::Format::d32_float;
    default:
      return gpu::Format::undefined;
  }
}

/// The handle of a host's image with this description. Handles stay until the host has the image forgotten: other views
/// of the frame may use them.
Result<gpu::ImageHandle> import(EngineObject& engine, std::uint64_t image, std::uint32_t format, const gloam_view& view,
                                gpu::ImageUsage usage, const char* name) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "host";
  desc.format = format_of(format);
  desc.width = view.width;
  desc.height = view.height;
  desc.usage = usage;
  const bool is_picture = desc.format == gpu::Format::rgba8_unorm || desc.format == gpu::Format::rgba8_srgb ||
                          desc.format == gpu::Format::bgra8_unorm || desc.format == gpu::Format::bgra8_srgb;
  if (desc.format == gpu::Format::undefined || (usage == gpu::ImageUsage::color_target && !is_picture))
    return usage_error(std::string(name) + "_format is " + std::to_string(format) +
                       ", which gloam does not take there");
  for (const ImportedImage& kept : engine.images)
    if (kept.image == image && kept.desc.format == desc.format && kept.desc.width == desc.width &&
        kept.desc.height == desc.height && kept.desc.usage == desc.usage)
      return kept.handle;
  engine.images.push_back({image, desc, gpu::import_image(*engine.device, reinterpret_cast<VkImage>(image), desc)});
  return engine.images.back().handle;
}

Result<HostGeometry> geometry_of(EngineObject& engine, const gloam_view& view) {
  gloam_host_geometry read;
  GLOAM_TRY(read_struct(view.geometry, gloam_host_geometry(GLOAM_HOST_GEOMETRY_INIT), "gloam_host_geometry", read));
  HostGeometryDesc desc;
  desc.near_m = read.near_m;
  desc.draws_meshes = read.draws_meshes != 0;
  struct Image {
    gpu::ImageHandle* handle;
    std::uint64_t image;
    std::uint32_t format;
    const char* name;
  };
  for (const Image& of :
       {Image{&desc.depth, read.depth, read.depth_format, "gloam_host_geometry::depth"},
        Image{&desc.normals, read.normals, read.normals_format, "gloam_host_geometry::normals"},
        Image{&desc.base_color, read.base_color, read.base_color_format, "gloam_host_geometry::base_color"},
        Image{&desc.material, read.material, read.material_format, "gloam_host_geometry::material"},
        Image{&desc.emissive, read.emissive, read.emissive_format, "gloam_host_geometry::emissive"}}) {
    if (of.image == 0) continue;  // HostGeometry::create() names those that are missing
    const auto handle = import(engine, of.image, of.format, view, gpu::ImageUsage::sampled, of.name);
    if (!handle) return handle.error();
    *of.handle = *handle;
  }
  return HostGeometry::create(*engine.device, desc);
}

}  // namespace

Result<std::unique_ptr<gpu::Device>> create_device_on(const gloam_vulkan_device& given, LogSink* log,
                                                      const char* cache_directory) {
  gloam_vulkan_device read;
  GLOAM_TRY(read_struct(&given, gloam_vulkan_device(GLOAM_VULKAN_DEVICE_INIT), "gloam_vulkan_device", read));
  if (read.instance == nullptr || read.physical_device == nullptr || read.device == nullptr || read.queue == nullptr ||
      read.get_instance_proc_addr == nullptr || read.features == nullptr ||
      (read.extensions == nullptr && read.extension_count > 0))
    return usage_error("a handle of gloam_vulkan_device is null");
  gpu::HostDevice host;
  host.instance = static_cast<VkInstance>(read.instance);
  host.physical_device = static_cast<VkPhysicalDevice>(read.physical_device);
  host.device = static_cast<VkDevice>(read.device);
  host.queue = static_cast<VkQueue>(read.queue);
  host.queue_family = read.queue_family;
  host.get_instance_proc_addr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(read.get_instance_proc_addr);
  if (read.api_version != 0) host.api_version = read.api_version;
  host.enabled_extensions = std::span(read.extensions, read.extension_count);
  host.enabled_features = static_cast<const VkPhysicalDeviceFeatures2*>(read.features);
  if (cache_directory != nullptr) host.cache_directory = cache_directory;
  host.log = log;
  return gpu::create_vulkan_device_on(host);
}

Status use_host_images(EngineObject& engine, const gloam_view& view, ViewRequest& request) {
  if (view.image != 0) {
    const auto image =
        import(engine, view.image, view.image_format, view, gpu::ImageUsage::color_target, "gloam_view::image");
    if (!image) return image.error();
    request.target.image = *image;
  }
  if (view.geometry != nullptr) {
    const auto geometry = geometry_of(engine, view);
    if (!geometry) return geometry.error();
    request.geometry = *geometry;
  }
  return {};
}

}  // namespace gloam::c_interface

extern "C" gloam_result gloam_engine_forget_image(gloam_engine* engine, uint64_t image) {
  using gloam::c_interface::EngineObject;
  return gloam::c_interface::guarded_with(engine, "gloam_engine_forget_image", [&](EngineObject& of) -> gloam::Status {
    std::erase_if(of.images, [&](const gloam::c_interface::ImportedImage& kept) {
      if (kept.image == image) of.device->destroy(kept.handle);
      return kept.image == image;
    });
    return {};
  });
}
