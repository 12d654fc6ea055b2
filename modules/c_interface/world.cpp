// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "engine/render/module.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/c_interface/handles.h"

using gloam::c_interface::EngineObject;
using gloam::c_interface::guarded;
using gloam::c_interface::guarded_with;
using gloam::c_interface::usage_error;
using gloam::c_interface::WorldObject;

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

Status set_sky(WorldObject& of, const float* zenith, const float* horizon, const float* ground) {
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
  return guarded_with(engine, "gloam_world_create", [&](EngineObject& of) -> gloam::Status {
    if (world == nullptr) return usage_error("gloam_world_create: world is null");
    auto made = std::make_unique<WorldObject>();
    made->engine = &of;
    of.renderer->prepare_world(made->world);
    *world = gloam::c_interface::worlds().add(std::move(made));
    ++of.worlds;
    return {};
  });
}

gloam_result gloam_world_destroy(gloam_world* world) {
  return guarded([&]() -> gloam::Status {
    if (world == nullptr) return {};
    const std::unique_ptr<WorldObject> ending = gloam::c_interface::worlds().remove(world);
    if (ending == nullptr) return usage_error("gloam_world_destroy: world is no world that exists");
    ending->engine->renderer->release_world(ending->world);
    --ending->engine->worlds;
    return {};
  });
}

gloam_result gloam_world_load(gloam_world* world, const char* path) {
  return guarded_with(world, "gloam_world_load", [&](WorldObject& of) -> gloam::Status {
    if (path == nullptr) return usage_error("gloam_world_load: an argument is null");
    if (of.world.entity_count() > 0) return usage_error("gloam_world_load: the world is not empty");
    EngineObject& engine = *of.engine;
    gloam::LogSink& log = engine.log == nullptr ? gloam::null_log() : *engine.log;
    const auto loaded = gloam::import_gltf(path, {}, gloam::make_key_registry(engine.renderer->modules()), of.world,
                                           *engine.executor, log);
    if (!loaded) return loaded.error();
    return {};
  });
}

gloam_result gloam_world_set_clock(gloam_world* world, double time_s, double dt_s) {
  return guarded_with(world, "gloam_world_set_clock", [&](WorldObject& of) -> gloam::Status {
    if (!std::isfinite(time_s) || !std::isfinite(dt_s) || dt_s < 0.0)
      return usage_error("gloam_world_set_clock: times are finite, and dt_s is at least 0");
    of.world.resource<gloam::SceneClock>() = {time_s, dt_s};
    return {};
  });
}

gloam_result gloam_world_set_sky(gloam_world* world, const float zenith[3], const float horizon[3],
                                 const float ground[3]) {
  return guarded_with(world, "gloam_world_set_sky", [&](WorldObject& of) -> gloam::Status {
    return gloam::c_interface::set_sky(of, zenith, horizon, ground);
  });
}

gloam_result gloam_world_set_exposure(gloam_world* world, float ev100) {
  return guarded_with(world, "gloam_world_set_exposure", [&](WorldObject& of) -> gloam::Status {
    if (!std::isfinite(ev100) || std::abs(ev100) > 64.0f)
      return usage_error("gloam_world_set_exposure: an exposure is a number from -64 to 64");
    auto& environment = of.world.resource<gloam::SceneEnvironment>();
    environment.exposure_ev100 = ev100;
    environment.has_exposure = true;
    return {};
  });
}

gloam_result gloam_world_find(gloam_world* world, const char* kind, const char* name, gloam_entity* entity) {
  return guarded_with(world, "gloam_world_find", [&](WorldObject& of) -> gloam::Status {
    if (kind == nullptr || name == nullptr || entity == nullptr)
      return usage_error("gloam_world_find: an argument is null");
    const auto found = of.world.resource<gloam::SceneNames>().find(kind, name);
    if (!found) return found.error();
    *entity = gloam::c_interface::number_of(*found);
    return {};
  });
}

gloam_result gloam_entity_destroy(gloam_world* world, gloam_entity entity) {
  return guarded_with(world, "gloam_entity_destroy", [&](WorldObject& of) -> gloam::Status {
    const auto found = gloam::c_interface::entity_of(of.world, entity);
    if (!found) return found.error();
    of.world.destroy(*found);
    return {};
  });
}

gloam_result gloam_entity_set_matrix(gloam_world* world, gloam_entity entity, const double matrix[16]) {
  return guarded_with(world, "gloam_entity_set_matrix", [&](WorldObject& of) -> gloam::Status {
    const auto found = gloam::c_interface::entity_of(of.world, entity);
    if (!found) return found.error();
    const auto pose = gloam::c_interface::matrix_of(matrix, "matrix");
    if (!pose) return pose.error();
    // The world's transform is the host's from now on.
    of.world.remove<gloam::LocalTransform>(*found);
    of.world.remove<gloam::LocalMatrix>(*found);
    of.world.remove<gloam::Parent>(*found);
    of.world.add(*found, gloam::WorldTransform{*pose});
    return {};
  });
}

}  // extern "C"
