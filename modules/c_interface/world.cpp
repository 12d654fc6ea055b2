// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "engine/render/module.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/c_interface/handles.h"

using gloam::c_interface::guarded;
using gloam::c_interface::usage_error;

namespace gloam::c_interface {
namespace {

[[nodiscard]] Result<vec3> color_of(const float* values, const char* name) {
  if (values == nullptr) return usage_error(std::string(name) + " is null");
  const vec3 color(values[0], values[1], values[2]);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(color[i]) || color[i] < 0.0f)
      return usage_error(std::string(name) + " holds a number that is below 0 or not finite");
  return color;
}

Status set_sky(gloam_world& of, const float* zenith, const float* horizon, const float* ground) {
  const auto up = color_of(zenith, "zenith"), side = color_of(horizon, "horizon"), down = color_of(ground, "ground");
  for (const auto* color : {&up, &side, &down})
    if (!color->ok()) return color->error();
  auto& sky = of.world.resource<SceneEnvironment>();
  sky.sky_zenith = *up;
  sky.sky_horizon = *side;
  sky.sky_ground = *down;
  sky.has_sky = true;
  return {};
}

}  // namespace
}  // namespace gloam::c_interface

extern "C" {

gloam_result gloam_world_create(gloam_engine* engine, gloam_world** world) {
  return guarded([&]() -> gloam::Status {
    if (engine == nullptr || world == nullptr) return usage_error("gloam_world_create: an argument is null");
    auto made = std::make_unique<gloam_world>();
    made->engine = engine;
    engine->renderer->prepare_world(made->world);
    ++engine->worlds;
    *world = made.release();
    return {};
  });
}

gloam_result gloam_world_destroy(gloam_world* world) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return {};
    const std::unique_ptr<gloam_world> ending(world);
    ending->engine->renderer->release_world(ending->world);
    --ending->engine->worlds;
    return {};
  });
}

gloam_result gloam_world_load(gloam_world* world, const char* path) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr || path == nullptr) return usage_error("gloam_world_load: an argument is null");
    if (world->world.entity_count() > 0) return usage_error("gloam_world_load: the world is not empty");
    gloam_engine& engine = *world->engine;
    gloam::LogSink& log = engine.log == nullptr ? gloam::null_log() : *engine.log;
    const auto loaded = gloam::import_gltf(path, {}, gloam::make_key_registry(engine.renderer->modules()), world->world,
                                           *engine.executor, log);
    if (!loaded) return loaded.error();
    return {};
  });
}

gloam_result gloam_world_set_clock(gloam_world* world, double time_s, double dt_s) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_world_set_clock: world is null");
    if (!std::isfinite(time_s) || !std::isfinite(dt_s) || dt_s < 0.0)
      return usage_error("gloam_world_set_clock: times are finite, and dt_s is at least 0");
    world->world.resource<gloam::SceneClock>() = {time_s, dt_s};
    return {};
  });
}

gloam_result gloam_world_set_sky(gloam_world* world, const float zenith[3], const float horizon[3],
                                 const float ground[3]) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_world_set_sky: world is null");
    return gloam::c_interface::set_sky(*world, zenith, horizon, ground);
  });
}

gloam_result gloam_world_set_exposure(gloam_world* world, float ev100) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_world_set_exposure: world is null");
    if (!std::isfinite(ev100) || std::abs(ev100) > 64.0f)
      return usage_error("gloam_world_set_exposure: an exposure is a number from -64 to 64");
    auto& environment = world->world.resource<gloam::SceneEnvironment>();
    environment.exposure_ev100 = ev100;
    environment.has_exposure = true;
    return {};
  });
}

gloam_result gloam_world_find(gloam_world* world, const char* kind, const char* name, gloam_entity* entity) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr || kind == nullptr || name == nullptr || entity == nullptr)
      return usage_error("gloam_world_find: an argument is null");
    const auto found = world->world.resource<gloam::SceneNames>().find(kind, name);
    if (!found) return found.error();
    *entity = gloam::c_interface::number_of(*found);
    return {};
  });
}

gloam_result gloam_entity_destroy(gloam_world* world, gloam_entity entity) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_entity_destroy: world is null");
    const auto found = gloam::c_interface::entity_of(world->world, entity);
    if (!found) return found.error();
    world->world.destroy(*found);
    return {};
  });
}

gloam_result gloam_entity_set_matrix(gloam_world* world, gloam_entity entity, const double matrix[16]) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_entity_set_matrix: world is null");
    const auto found = gloam::c_interface::entity_of(world->world, entity);
    if (!found) return found.error();
    const auto pose = gloam::c_interface::matrix_of(matrix, "matrix");
    if (!pose) return pose.error();
    // The world's transform is the host's from now on.
    world->world.remove<gloam::LocalTransform>(*found);
    world->world.remove<gloam::LocalMatrix>(*found);
    world->world.remove<gloam::Parent>(*found);
    world->world.add(*found, gloam::WorldTransform{*pose});
    return {};
  });
}

}  // extern "C"
