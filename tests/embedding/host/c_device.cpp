// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host with its own Vulkan device and images that knows gloam by gloam.h only. gloam draws the little world into the
// host's image: it must equal, bit for bit, the picture of an engine with its own device. Then gloam lights images that
// the host has drawn by rays. Exit code 77: there is no Vulkan device.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "checks.h"
#include "engine/math/srgb.h"
#include "little_world.h"
#include "modules/c_interface/gloam.h"
#include "traced_boxes.h"
#include "vulkan_host.h"

namespace {

using host::Bytes, host::fail;

constexpr std::uint32_t kWidth = 240;
constexpr std::uint32_t kHeight = 136;
constexpr float kNear = 0.2f;

void check(gloam_result result) {
  if (result != GLOAM_OK) fail(gloam_error_message());
}

/// The call must fail with this code and a sentence with these words.
void refuse(gloam_result got, gloam_result wanted, const char* says) {
  const std::string message = gloam_error_message();
  if (got != wanted || message.find(says) == std::string::npos)
    fail("'" + message + "' (" + std::to_string(got) + ") in place of an error about " + says);
}

/// Column-major: a rotation's columns and a place.
using Matrix = std::array<double, 16>;
Matrix matrix(const glm::dmat3& turn, const gloam::dvec3& place) {
  Matrix m = {};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) m[static_cast<std::size_t>(4 * column + row)] = turn[column][row];
  for (int row = 0; row < 3; ++row) m[static_cast<std::size_t>(12 + row)] = place[row];
  m[15] = 1.0;
  return m;
}

/// The boxes, the lamp and the sun of the little world.
void fill(gloam_world* world, bool meshes) {
  for (const host::LittleBox& box : host::kLittleBoxes) {
    if (!meshes) break;
    gloam_material material = GLOAM_MATERIAL_INIT;
    for (int i = 0; i < 4; ++i) material.base_color[i] = box.color[i];
    material.roughness = host::kLittleRoughness;
    gloam_mesh mesh = GLOAM_MESH_INIT;
    check(gloam_material_create(world, &material, &mesh.material));
    const gloam::Primitive corners = host::box(box.half_m, 0);
    mesh.positions = &corners.positions[0].x;
    mesh.normals = &corners.normals[0].x;
    mesh.indices = corners.indices.data();
    mesh.vertex_count = static_cast<std::uint32_t>(corners.positions.size());
    mesh.index_count = static_cast<std::uint32_t>(corners.indices.size());
    std::uint32_t number = 0;
    gloam_entity entity = 0;
    check(gloam_mesh_create(world, &mesh, &number));
    check(gloam_instance_create(world, number, matrix(glm::dmat3(1.0), box.position).data(), &entity));
  }
  gloam_entity entity = 0;
  gloam_light lamp = GLOAM_LIGHT_INIT;
  lamp.color[1] = 0.7f;
  lamp.color[2] = 0.4f;
  lamp.intensity = 300.0f;
  check(gloam_light_create(world, &lamp, matrix(glm::dmat3(1.0), {0.0, 1.5, 1.5}).data(), &entity));
  gloam_light sun = GLOAM_LIGHT_INIT;
  sun.kind = GLOAM_LIGHT_DIRECTIONAL;
  sun.intensity = 2000.0f;
  // It shines along -Z: turned down by 30 degrees, then to the left by 60.
  const double c = 0.866025403784, s = 0.5;
  const glm::dmat3 down({1, 0, 0}, {0, c, -s}, {0, s, c}), left({s, 0, -c}, {0, 1, 0}, {c, 0, s});
  check(gloam_light_create(world, &sun, matrix(left * down, gloam::dvec3(0.0)).data(), &entity));
  const float zenith[] = {20.0f, 35.0f, 70.0f}, horizon[] = {90.0f, 60.0f, 45.0f}, ground[] = {0.0f, 0.0f, 0.0f};
  check(gloam_world_set_sky(world, zenith, horizon, ground));
  check(gloam_world_set_exposure(world, 9.0f));
}

gloam_view front() {
  gloam_view view = GLOAM_VIEW_INIT;
  view.id = 3;
  view.width = kWidth;
  view.height = kHeight;
  view.matrix[13] = 2.2;
  view.matrix[14] = 6.0;
  view.near_m = kNear;
  return view;
}

void log_line(void*, gloam_log_level level, const char* line) {
  if (level >= GLOAM_LOG_WARNING) std::fprintf(stderr, "%s\n", line);
}

/// An engine with a world.
struct Stage {
  Stage(const gloam_engine_info& given, bool meshes) {
    gloam_engine_info info = given;
    info.threads = 2;
    info.log = log_line;
    check(gloam_engine_create(&info, &engine));
    check(gloam_engine_set_knob(engine, "lighting.dither", "off"));
    check(gloam_world_create(engine, &world));
    fill(world, meshes);
  }
  ~Stage() {
    check(gloam_world_destroy(world));
    check(gloam_engine_destroy(engine));
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  void draw(const gloam_view& view) const {
    for (int frame = 0; frame < 3; ++frame) check(gloam_render(world, &view, 1));
    check(gloam_engine_wait(engine));
  }

  gloam_engine* engine = nullptr;
  gloam_world* world = nullptr;
};

/// The host's images with the boxes' surfaces, as rays see them.
class Surfaces {
 public:
  explicit Surfaces(host::VulkanHost& vulkan) : vulkan_(vulkan) {
    Bytes depth, normals, colors, material;
    gloam::ViewSettings camera;
    camera.camera.fov_y = front().fov_y;
    camera.world_from_camera[3] = gloam::dvec4(0.0, 2.2, 6.0, 1.0);
    host::for_each_pixel(kWidth, kHeight, camera, [&](const host::Hit& hit) {
      const bool sky = hit.box == nullptr;
      host::append(depth, sky ? 0.0f : static_cast<float>(static_cast<double>(kNear) / hit.distance));
      std::uint32_t normal = 0, color = 0;
      for (int i = 0; i < 3; ++i) {
        normal |= host::unorm(0.5 + 0.5 * hit.normal[i], 8) << (8 * i);
        color |= sky ? 0u : host::unorm(gloam::linear_to_srgb(static_cast<double>(hit.box->color[i])), 8) << (8 * i);
      }
      host::append(normals, normal);
      host::append(colors, color);
      host::append(material, 255u | host::unorm(static_cast<double>(host::kLittleRoughness), 8) << 8);
    });
    geometry.depth = filled(VK_FORMAT_R32_SFLOAT, depth, geometry.depth_format);
    geometry.near_m = kNear;
    geometry.normals = filled(VK_FORMAT_R8G8B8A8_UNORM, normals, geometry.normals_format);
    geometry.base_color = filled(VK_FORMAT_R8G8B8A8_SRGB, colors, geometry.base_color_format);
    geometry.material = filled(VK_FORMAT_R8G8B8A8_UNORM, material, geometry.material_format);
    geometry.draws_meshes = 0;
  }
  ~Surfaces() {
    for (const host::HostImage& image : images_) vulkan_.destroy(image);
  }
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;
  void forget(gloam_engine* engine) const {
    for (const host::HostImage& image : images_)
      check(gloam_engine_forget_image(engine, reinterpret_cast<std::uint64_t>(image.image)));
  }

  gloam_host_geometry geometry = GLOAM_HOST_GEOMETRY_INIT;

 private:
  std::uint64_t filled(VkFormat format, const Bytes& texels, std::uint32_t& told) {
    told = static_cast<std::uint32_t>(format);
    images_.push_back(vulkan_.create_image(format, kWidth, kHeight));
    vulkan_.write(images_.back(), texels, gloam::gpu::host_image_layout(gloam::gpu::Access::fragment_read));
    return reinterpret_cast<std::uint64_t>(images_.back().image);
  }
  host::VulkanHost& vulkan_;
  std::vector<host::HostImage> images_;
};

gloam_vulkan_device describe(const gloam::gpu::HostDevice& host) {
  gloam_vulkan_device device = GLOAM_VULKAN_DEVICE_INIT;
  device.instance = host.instance;
  device.physical_device = host.physical_device;
  device.device = host.device;
  device.queue = host.queue;
  device.queue_family = host.queue_family;
  device.api_version = host.api_version;
  device.get_instance_proc_addr = reinterpret_cast<void*>(host.get_instance_proc_addr);
  device.extensions = host.enabled_extensions.data();
  device.extension_count = static_cast<std::uint32_t>(host.enabled_extensions.size());
  device.features = host.enabled_features;
  return device;
}

/// Draws into the host's image and returns its texels.
Bytes picture(const Stage& stage, host::VulkanHost& vulkan, const gloam_host_geometry* geometry) {
  const host::HostImage target = vulkan.create_image(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight);
  gloam_view view = front();
  view.geometry = geometry;
  view.image = reinterpret_cast<std::uint64_t>(target.image);
  view.image_format = VK_FORMAT_R16G16B16A16_SFLOAT;
  refuse(gloam_render(stage.world, &view, 1), GLOAM_USAGE, "gloam_view::image_format is 97");
  view.image_format = VK_FORMAT_R8G8B8A8_SRGB;
  stage.draw(view);
  Bytes texels = vulkan.read(target, gloam::gpu::host_image_layout(gloam::gpu::Access::color_target), {});
  check(gloam_engine_forget_image(stage.engine, view.image));
  vulkan.destroy(target);
  return texels;
}

Bytes picture_alone(const std::string& device) {
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  info.device = device.c_str();
  const Stage stage(info, true);
  stage.draw(front());
  Bytes rgba(4 * kWidth * kHeight);
  check(gloam_read_picture(stage.world, front().id, rgba.data(), rgba.size(), nullptr, nullptr));
  return rgba;
}

/// What a host can get wrong about its device and its images.
void try_wrong_arguments(host::VulkanHost& vulkan, const Stage& stage, const gloam_host_geometry& right) {
  gloam_engine* engine = nullptr;
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  gloam_vulkan_device device = describe(vulkan.describe());
  info.vulkan = &device;
  device.queue = nullptr;
  refuse(gloam_engine_create(&info, &engine), GLOAM_USAGE, "gloam_vulkan_device is null");
  device = describe(vulkan.describe());
  VkPhysicalDeviceFeatures2 none = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  device.features = &none;
  refuse(gloam_engine_create(&info, &engine), GLOAM_NO_DEVICE, "timelineSemaphore");
  gloam_host_geometry wrong = right;
  gloam_view view = front();
  view.geometry = &wrong;
  wrong.depth = 0;
  refuse(gloam_render(stage.world, &view, 1), GLOAM_USAGE, "depth");
  wrong = right;
  wrong.normals_format = 1000;
  refuse(gloam_render(stage.world, &view, 1), GLOAM_USAGE, "normals_format is 1000");
  wrong = right;
  wrong.near_m = -1.0f;
  refuse(gloam_render(stage.world, &view, 1), GLOAM_USAGE, "near_m");
}

}  // namespace

int main() {
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  bool right = true;
  {
    const Surfaces surfaces(*vulkan);
    const gloam::gpu::HostDevice description = vulkan->describe();
    const gloam_vulkan_device device = describe(description);
    gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
    info.vulkan = &device;
    Bytes hosted, lit, unshadowed;
    {
      const Stage stage(info, true);
      hosted = picture(stage, *vulkan, nullptr);
      lit = picture(stage, *vulkan, &surfaces.geometry);
      try_wrong_arguments(*vulkan, stage, surfaces.geometry);
      surfaces.forget(stage.engine);
    }
    {
      const Stage stage(info, false);
      unshadowed = picture(stage, *vulkan, &surfaces.geometry);
      surfaces.forget(stage.engine);
    }
    const bool equal = hosted == picture_alone(vulkan->device_name());
    const host::Difference same = host::difference(hosted, lit), other = host::difference(unshadowed, lit);
    std::printf(
        "the host's image %s that of an engine of its own; traced surfaces: %.3f of 255 from meshes, %.2f %% of "
        "pixels by more than 8; %.2f without shadows\n",
        equal ? "equals" : "differs from", same.mean, 100.0 * same.share, other.mean);
    right = equal && same.mean < 0.5 && same.share < 0.01 && other.mean > 1.0;
  }
  const std::uint64_t messages = vulkan->close();
  std::printf("gloam.h on a host's device: %s, %llu validation messages\n", right ? "right" : "wrong",
              static_cast<unsigned long long>(messages));
  return right && messages == 0 ? 0 : 1;
}
