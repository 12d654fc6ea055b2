// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/ext/matrix_transform.hpp>
#include <string>

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

[[nodiscard]] inline dmat4 moved(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

/// A world without a renderer, with the components that a bake reads.
struct BakeWorld {
  World world;
  SceneMaker scene{world};

  BakeWorld() {
    prepare_scene_world(world);
    world.register_component<Light>("light");
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<IbrProxy>("ibr_proxy");
    world.register_component<FlameProxy>("flame_proxy");
    world.register_component<CubeProbe>("cube_probe");
    world.set_resource(ReflectionCaptures{});
  }
  Entity light(const std::string& name, const Light& light, const dmat4& matrix) {
    const Entity entity = world.create(light, WorldTransform{matrix});
    world.resource<SceneNames>().add("light", name, entity);
    return entity;
  }
  [[nodiscard]] std::uint32_t text(const std::string& text) { return world.resource<SceneStrings>().intern(text); }
};

}  // namespace gloam::test
