// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A plugin that is compiled with hidden visibility and contains gloam's library itself.
#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "health.h"

extern "C" __attribute__((visibility("default"))) void heal(gloam::World& world) {
  world.register_component<Health>();
  if (world.entity_count() == 0) world.create(Health{1});
  world.view<Health>().each([&](Health& health) {
    ++health.value;
    ++world.resource<Score>().healed;
  });
}
