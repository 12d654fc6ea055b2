// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// The smallest host: a world made by code, drawn into a picture on disk.
#include <cstdio>
#include <fstream>

#include "engine/gpu/vulkan_device.h"
#include "engine/render/renderer.h"
#include "engine/scene/mesh_builder.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"

int main() {
  auto device = gloam::gpu::create_vulkan_device({});
  if (!device.ok()) return std::puts(device.error().message.c_str()), 77;
  auto executor = gloam::make_pool_executor();  // or a JobExecutor of the host
  auto renderer = gloam::Renderer::create(
      {.device = device->get(), .executor = executor.get(), .modules = gloam::make_all_modules()});
  if (!renderer.ok()) return std::puts(renderer.error().message.c_str()), 1;
  gloam::World world;
  (*renderer)->prepare_world(world);

  auto& assets = world.resource<gloam::SceneAssets>();
  assets.materials.push_back({.base_color = {0.5f, 0.4f, 0.3f, 1.0f}, .metallic = 0.0f, .roughness = 0.6f});
  gloam::Mesh pyramid;  // on a floor; three positions a triangle, counter-clockwise seen from outside
  const gloam::vec3 a(-1, 0, 1), b(1, 0, 1), c(1, 0, -1), d(-1, 0, -1), top(0, 2, 0);
  pyramid.primitives.push_back({.material = 0, .positions = {a, b, top, b, c, top, c, d, top, d, a, top}});
  pyramid.primitives.push_back({.material = 0, .positions = {8.f * d, 8.f * a, 8.f * b, 8.f * d, 8.f * b, 8.f * c}});
  gloam::complete_mesh(pyramid, assets);  // computes indices, normals and bounds
  assets.meshes.push_back(pyramid);
  world.create(gloam::LocalTransform{}, gloam::WorldTransform{}, gloam::MeshInstance{0});
  world.create(gloam::LocalTransform{.translation = {2.0, 2.5, 2.5}}, gloam::WorldTransform{},
               gloam::Light{.color = {1.0f, 0.7f, 0.4f}, .intensity = 200.0f, .width_m = 0.4f}, gloam::ShadowCaster{});
  world.resource<gloam::SceneEnvironment>().sky_horizon = {1.0f, 1.5f, 3.0f};  // cd/m²

  gloam::ViewRequest view{.settings = {.width = 640, .height = 360}};  // view.target.image: an image of the host
  view.settings.world_from_camera[3] = {0.0, 1.5, 6.0, 1.0};           // looks along −Z
  if (auto drawn = (*renderer)->render(world, {&view, 1}); !drawn.ok())
    return std::puts(drawn.error().message.c_str()), 1;
  const auto picture = (*renderer)->read_picture(view.settings.id);
  if (!picture.ok()) return std::puts(picture.error().message.c_str()), 1;
  std::ofstream file("minimal.ppm", std::ios::binary);
  file << "P6 " << picture->width << ' ' << picture->height << " 255\n";
  for (std::size_t i = 0; i < picture->rgba.size(); i += 4)
    file.write(reinterpret_cast<const char*>(&picture->rgba[i]), 3);
}
