// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Adds a module with a shader, both defined by the host, to gloam's modules. Draws on the recording device, which only
// records commands.
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/renderer.h"
#include "engine/scene/keys/registry.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "veil_module.h"

namespace {

bool has_pass(gloam::Renderer& renderer, const std::string& name) {
  for (const gloam::PassTime& pass : renderer.report().passes)
    if (pass.name == name) return true;
  return false;
}

/// A view that captures the light above the scene, as the main view's frame needs it.
gloam::ViewRequest capture_of(gloam::gpu::ImageHandle image, bool first) {
  gloam::ViewRequest capture;
  capture.settings.id = gloam::ViewId{1};
  capture.settings.purpose = gloam::ViewPurpose::capture;
  capture.settings.width = capture.settings.height = 16;
  capture.settings.world_from_camera[3] = gloam::dvec4(0.0, 2.0, 0.0, 1.0);
  constexpr gloam::gpu::Access kReady = gloam::gpu::Access::compute_read;
  capture.target.light = {.image = image, .before = first ? gloam::gpu::Access::none : kReady, .after = kReady};
  return capture;
}

}  // namespace

int main() {
  const auto device = gloam::gpu::make_recording_device();
  const gloam::gpu::ImageHandle surroundings =
      device
          ->create_image({.name = "surroundings",
                          .module = "host",
                          .format = gloam::gpu::Format::rgba16_float,
                          .width = 16,
                          .height = 16,
                          .usage = gloam::gpu::ImageUsage::color_target | gloam::gpu::ImageUsage::sampled})
          .value();
  const auto executor = gloam::make_serial_executor();
  gloam::ModuleList modules = gloam::make_all_modules();
  modules.push_back(host::make_veil_module(surroundings));
  const bool has_key = gloam::make_key_registry(modules).find("gloam.veil.density") != nullptr;
  gloam::RendererOptions options;
  options.device = device.get();
  options.executor = executor.get();
  options.modules = std::move(modules);
  auto renderer = gloam::Renderer::create(std::move(options)).value();
  gloam::World world;
  renderer->prepare_world(world);
  host::build_little_world(world);

  std::vector<gloam::ViewRequest> views = {capture_of(surroundings, true), {}};
  views[1].settings.width = 64;
  views[1].settings.height = 40;
  const auto draws = [&] { return renderer->render(world, views).ok() && renderer->wait().ok(); };
  bool right = draws() && !has_pass(*renderer, "veil");
  views[0] = capture_of(surroundings, false);
  world.create(host::Veil{.density = 0.05f});
  for (int frame = 0; frame < 3; ++frame) right = draws() && right;
  right = right && has_pass(*renderer, "veil") && has_pass(*renderer, "veil_average");
  const double risen = renderer->report().counters["veil.density"];
  right = right && risen > 0.0 && risen < 0.05 && !has_pass(*renderer, "veil_share");
  right = right && renderer->knobs().set("veil.stride", "1").ok();
  views[1].settings.visualizer = "veil_share";
  right = draws() && right && has_pass(*renderer, "veil_share");
  renderer.reset();
  device->destroy(surroundings);
  for (const std::string& fault : device->faults()) std::printf("%s\n", fault.c_str());
  right = right && has_key && device->faults().empty();
  std::printf("gloam with a module of the host's: %s\n", right ? "right" : "wrong");
  return right ? 0 : 1;
}
