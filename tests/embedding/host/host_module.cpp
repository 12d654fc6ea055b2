// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Adds a module with a shader, both defined by the host, to gloam's modules. Draws on the recording device, which only
// records commands.
#include <cstdio>
#include <string>
#include <utility>

#include "engine/gpu/recording_device.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "veil_module.h"

namespace {

bool has_pass(gloam::Renderer& renderer, const std::string& name) {
  for (const gloam::PassTime& pass : renderer.report().passes)
    if (pass.name == name) return true;
  return false;
}

}  // namespace

int main() {
  const auto device = gloam::gpu::make_recording_device();
  const auto executor = gloam::make_serial_executor();
  gloam::ModuleList modules = gloam::make_all_modules();
  modules.push_back(host::make_veil_module());
  const bool has_key = gloam::make_key_registry(modules).find("gloam.veil.density") != nullptr;
  gloam::RendererOptions options;
  options.device = device.get();
  options.executor = executor.get();
  options.modules = std::move(modules);
  auto renderer = gloam::Renderer::create(std::move(options)).value();
  gloam::World world;
  renderer->prepare_world(world);
  host::build_little_world(world);

  gloam::ViewRequest view;
  view.settings.width = 64;
  view.settings.height = 40;
  bool right = renderer->render(world, {&view, 1}).ok() && renderer->wait().ok() && !has_pass(*renderer, "veil");
  world.create(host::Veil{.density = 0.05f, .radiance = gloam::vec3(20.0f)});
  right = right && renderer->render(world, {&view, 1}).ok() && renderer->wait().ok() && has_pass(*renderer, "veil");
  right = right && renderer->report().counters.contains("veil.density");
  renderer.reset();
  for (const std::string& fault : device->faults()) std::printf("%s\n", fault.c_str());
  right = right && has_key && device->faults().empty();
  std::printf("gloam with a module of the host's: %s\n", right ? "right" : "wrong");
  return right ? 0 : 1;
}
