// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <span>

#include "modules/lights/module.h"
#include "modules/shadows/atlas/shared_places.h"
#include "modules/shadows/systems.h"
#include "tests/jobs/executors.h"
#include "tests/support/module_world.h"

namespace gloam::test {

/// A world of lights and the shadows of its views, run like in a renderer.
struct ShadowWorld : ModuleWorld {
  ShadowWorld() : ModuleWorld(make_lights_module()) {
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<CasterVolume>("caster_volume");
    world.set_resource(CapturePlaces{});
    world.set_resource(ShadowTexelGrid{});
    add_shadow_systems(schedule);
  }

  /// Adds lights of every kind in front of the camera.
  void add_random(std::uint32_t count, std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      Light light;
      light.kind = i % 2 == 0 ? LightKind::point : LightKind::spot;
      light.range_m = static_cast<float>(2.0 + 1.5 * unit(random));
      light.intensity = static_cast<float>(20.0 + 19.0 * unit(random));
      light.outer_angle = static_cast<float>(0.8 + 0.7 * unit(random));
      const double depth = 30.0 + 25.0 * unit(random);
      const dmat4 placed =
          glm::translate(dmat4(1.0), dvec3(0.5 * depth * unit(random), 0.3 * depth * unit(random), -depth));
      add(light, glm::rotate(placed, unit(random) * 3.0, glm::normalize(dvec3(unit(random), 1.1, unit(random)))));
    }
  }
  Entity add(const Light& light, const dmat4& node = glm::translate(dmat4(1.0), dvec3(0, 0, -8))) {
    return world.create(light, WorldTransform{node});
  }
  Entity add_point() {
    Light light;
    light.range_m = 4.0f;
    return add(light);
  }
  Entity add_sun() {
    Light light;
    light.kind = LightKind::directional;
    return add(light, glm::rotate(dmat4(1.0), -1.0, dvec3(1, 0, 0)));
  }
  /// Adds a cube with a side of 2 m.
  void add_mesh(const dvec3& at) {
    auto& assets = world.resource<SceneAssets>();
    if (assets.meshes.empty()) {
      assets.meshes.emplace_back();
      assets.meshes[0].bounds = {vec3(-1.0f), vec3(1.0f)};
    }
    world.create(MeshInstance{}, WorldTransform{glm::translate(dmat4(1.0), at)});
  }

  /// Runs a frame: prepares all views, then runs the systems of each. Frame 0 is a camera cut.
  void run(JobExecutor& executor, std::span<const ViewSettings> views, std::uint64_t number = 0) {
    schedule.run(Stage::world, world, executor);
    for (const ViewSettings& view : views) {
      world.set_view_resource(view.id, make_view(view, number, view.camera_cut ? number : 0));
      module->prepare_view(world, view.id, knobs);
      prepare_shadow_view(world, view.id, ShadowKnobs{});
    }
    for (const ViewSettings& view : views) schedule.run_view(view.id, world, executor);
  }
  void run(JobExecutor& executor) { run(executor, {&settings, 1}, frame++); }
  const ViewFaces& run() {
    run(*make_serial_executor());
    return shadows();
  }
  std::uint64_t frame = 0;  ///< number of the next one
  [[nodiscard]] const ViewFaces& shadows() const { return world.view_resource<ViewFaces>(settings.id); }
  [[nodiscard]] ShadowSettings& shadow_settings() {
    prepare_shadow_view(world, settings.id, ShadowKnobs{});
    return world.view_resource<ShadowSettings>(settings.id);
  }
};

}  // namespace gloam::test
