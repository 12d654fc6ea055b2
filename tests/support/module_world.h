// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/module.h"
#include "engine/render/view.h"
#include "engine/scene/gltf/import.h"
#include "engine/schedule/schedule.h"

namespace gloam::test {

/// A world with the components and systems of one module, and one view, run like in a renderer.
struct ModuleWorld {
  World world;
  std::unique_ptr<Module> module;
  Schedule schedule;
  KnobRegistry knobs;
  ViewSettings settings;

  explicit ModuleWorld(std::unique_ptr<Module> tested) : module(std::move(tested)) {
    prepare_scene_world(world);
    module->register_components(world);
    module->add_systems(schedule);
    module->knobs(knobs);
    schedule.set_checked(true);
    settings.width = 640;
    settings.height = 360;
  }

  void run(JobExecutor& executor) {
    schedule.run(Stage::world, world, executor);
    world.set_view_resource(settings.id, make_view(settings, 0));
    module->prepare_view(world, settings.id, knobs);
    schedule.run_view(settings.id, world, executor);
  }
  void run() { run(*make_serial_executor()); }
};

}  // namespace gloam::test
