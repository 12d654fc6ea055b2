// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host that draws its own geometry: it traces rays to the boxes of the little world and writes depth, normals,
// colours and material into its own images. gloam lights them, in the host's command buffer. The picture must be the
// one that gloam draws of meshes of the same boxes. Shadows come from meshes that only cast, or from the host's own
// draws. A shader of the host lights the images too, by gloam's light lists and visibilities. Exit code 77: there is no
// Vulkan device.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "box_casters.h"
#include "checks.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"
#include "engine/math/srgb.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "own_shading.h"
#include "thread_executor.h"
#include "traced_boxes.h"
#include "vulkan_host.h"

namespace {

namespace gpu = gloam::gpu;
using host::append, host::Bytes, host::difference, host::Difference, host::for_each_pixel, host::Hit, host::unorm;

constexpr std::uint32_t kWidth = 240;
constexpr std::uint32_t kHeight = 136;
constexpr double kNear = 0.2, kFar = 80.0;  // of the host's projection

using host::check;
using host::fail;
using host::value_of;

gloam::ViewSettings camera() {
  gloam::ViewSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.world_from_camera[3] = gloam::dvec4(0.0, 2.2, 6.0, 1.0);
  return settings;
}

/// The host's images, four bytes a texel, as it would have drawn them.
struct Drawn {
  Bytes depth, normals, colors, material;
};

Drawn draw_boxes() {
  Drawn drawn;
  for_each_pixel(kWidth, kHeight, camera(), [&](const Hit& hit) {
    const bool sky = hit.box == nullptr;
    append(drawn.depth,
           sky ? 1.0f : static_cast<float>(kFar * (hit.distance - kNear) / (hit.distance * (kFar - kNear))));
    std::uint32_t normal = 0, color = 0;
    for (int i = 0; i < 3; ++i) {
      normal |= unorm(0.5 + 0.5 * hit.normal[i], 10) << (10 * i);
      color |= sky ? 0u : unorm(gloam::linear_to_srgb(static_cast<double>(hit.box->color[i])), 8) << (8 * i);
    }
    append(drawn.normals, normal);
    append(drawn.colors, color);
    append(drawn.material, 255u | unorm(static_cast<double>(host::kLittleRoughness), 8) << 8);
  });
  return drawn;
}

/// One of the host's images with its handle in gloam.
struct Shared {
  host::HostImage image;
  gpu::ImageHandle handle;
};

Shared share(host::VulkanHost& vulkan, gpu::Device& device, VkFormat vulkan_format, gpu::Format format) {
  Shared shared;
  shared.image = vulkan.create_image(vulkan_format, kWidth, kHeight);
  gpu::ImageDesc desc;
  desc.name = "host geometry";
  desc.module = "host";
  desc.format = format;
  desc.width = kWidth;
  desc.height = kHeight;
  desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_source;
  shared.handle = gpu::import_image(device, shared.image.image, desc);
  return shared;
}

/// The casters of the boxes' shadows.
enum class Casters { meshes, own_draws, none };

class Stage {
 public:
  Stage(host::VulkanHost& vulkan, gpu::Device& device, gloam::LogSink& log)
      : vulkan_(vulkan), device_(device), log_(log) {
    const Drawn drawn = draw_boxes();
    const auto filled = [&](VkFormat vulkan_format, gpu::Format format, const Bytes& texels) {
      images_.push_back(share(vulkan, device, vulkan_format, format));
      vulkan.write(images_.back().image, texels, gpu::host_image_layout(gpu::Access::fragment_read));
      return images_.back().handle;
    };
    desc_.depth = filled(VK_FORMAT_R32_SFLOAT, gpu::Format::r32_float, drawn.depth);
    desc_.depth_kind = gloam::HostDepth::standard;
    desc_.near_m = static_cast<float>(kNear);
    desc_.far_m = static_cast<float>(kFar);
    desc_.normals = filled(VK_FORMAT_A2B10G10R10_UNORM_PACK32, gpu::Format::rgb10a2_unorm, drawn.normals);
    desc_.base_color = filled(VK_FORMAT_R8G8B8A8_SRGB, gpu::Format::rgba8_srgb, drawn.colors);
    desc_.material = filled(VK_FORMAT_R8G8B8A8_UNORM, gpu::Format::rgba8_unorm, drawn.material);
    picture_ = share(vulkan, device, VK_FORMAT_R8G8B8A8_SRGB, gpu::Format::rgba8_srgb);
    images_.push_back(picture_);
  }
  ~Stage() {
    for (const Shared& shared : images_) device_.destroy(shared.handle);
    check(device_.wait_idle());
    for (const Shared& shared : images_) vulkan_.destroy(shared.image);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Lights the host's images, in the host's command buffers. bands: as in make_own_shading; none: gloam's shader.
  Bytes light(Casters casters, std::optional<std::uint32_t> bands = {}) {
    gloam::HostGeometryDesc desc = desc_;
    desc.draws_meshes = false;
    gloam::ViewRequest request = this->request();
    request.geometry = value_of(gloam::HostGeometry::create(device_, desc));
    gloam::ModuleList own;
    if (casters == Casters::own_draws) own.push_back(host::make_box_casters());
    if (bands) own.push_back(host::make_own_shading(*bands));
    return draw({.meshes = casters == Casters::meshes, .shadows = true}, request, std::move(own), true);
  }
  /// gloam draws the boxes itself.
  Bytes draw_meshes() { return draw({.meshes = true, .shadows = true}, request(), {}, false); }
  /// Frames in which nothing changes, with a picture of gloam's own, in the host's command buffers: the host submits
  /// each of them, so none may be kept back.
  void rest() {
    gloam::ViewRequest request = this->request();
    request.target = {};
    static_cast<void>(draw({.meshes = true, .shadows = true}, request, {}, true, 8));
  }

 private:
  [[nodiscard]] gloam::ViewRequest request() const {
    gloam::ViewRequest request;
    request.settings = camera();
    request.target = {.image = picture_.handle, .after = gpu::Access::transfer_read};
    return request;
  }
  Bytes draw(const host::LittleWorld& wanted, const gloam::ViewRequest& request, gloam::ModuleList own,
             bool in_host_commands, int frames = 3) {
    gloam::ModuleList modules = gloam::make_all_modules();
    for (auto& module : own) modules.push_back(std::move(module));
    auto renderer = value_of(gloam::Renderer::create(
        {.device = &device_, .executor = &executor_, .log = &log_, .modules = std::move(modules)}));
    check(renderer->knobs().set("lighting.dither", "off"));
    gloam::World world;
    renderer->prepare_world(world);
    host::build_little_world(world, wanted);
    auto& environment = world.resource<gloam::SceneEnvironment>();
    environment.has_exposure = true;
    environment.exposure_ev100 = 9.0f;
    for (int frame = 0; frame < frames; ++frame) {
      const VkCommandBuffer commands = in_host_commands ? vulkan_.begin_commands() : VK_NULL_HANDLE;
      if (in_host_commands) gpu::record_next_frame_into(device_, commands);
      check(renderer->render(world, {&request, 1}));
      if (!in_host_commands) continue;
      vulkan_.submit(commands);
      check(gpu::host_submitted(device_));
    }
    return vulkan_.read(picture_.image, gpu::host_image_layout(gpu::Access::transfer_read),
                        gpu::frame_timeline(device_));
  }

  host::VulkanHost& vulkan_;
  gpu::Device& device_;
  gloam::LogSink& log_;
  host::ThreadExecutor executor_{2};
  gloam::HostGeometryDesc desc_;
  Shared picture_;
  std::vector<Shared> images_;
};

}  // namespace

int main() {
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  gloam::LogSink& log = host::warning_log();
  gpu::separate_driver_caches();
  gpu::HostDevice description = vulkan->describe();
  description.log = &log;
  auto device = value_of(gpu::create_vulkan_device_on(description));
  bool right = true;
  {
    Stage stage(*vulkan, *device, log);
    const Bytes meshes = stage.draw_meshes();
    const Bytes unshadowed = stage.light(Casters::none);
    for (const auto& [name, casters] :
         {std::pair("meshes that only cast", Casters::meshes), {"the host's draws", Casters::own_draws}}) {
      const Bytes lit = stage.light(casters);
      const Difference same = difference(meshes, lit), other = difference(unshadowed, lit);
      std::printf(
          "shadows of %s: %.3f of 255 from gloam's picture, %.2f %% of pixels by more than 8; %.2f without shadows\n",
          name, same.mean, 100.0 * same.share, other.mean);
      right = right && same.mean < 0.5 && same.share < 0.01 && other.mean > 1.0;
    }
    const Bytes lit = stage.light(Casters::meshes);
    const Difference smooth = difference(lit, stage.light(Casters::meshes, 0));
    const Difference banded = difference(lit, stage.light(Casters::meshes, 1));
    std::printf("the host's shader: %.3f of 255 from gloam's; with hard shadow edges %.3f, %.2f %% of pixels\n",
                smooth.mean, banded.mean, 100.0 * banded.share);
    stage.rest();
    right = right && smooth.mean < 0.01 && smooth.share == 0.0 && banded.share > 0.001 && banded.share < 0.1;
  }
  device.reset();
  const std::uint64_t messages = vulkan->close();
  std::printf("gloam lights a host's geometry: %s, %llu validation messages\n", right ? "right" : "wrong",
              static_cast<unsigned long long>(messages));
  return right && messages == 0 ? 0 : 1;
}
