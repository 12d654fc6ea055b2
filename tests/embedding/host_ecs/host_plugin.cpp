// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A host that loads a plugin again and again: both have the same components and resources in a world.
// usage: host_plugin PLUGIN
#include <dlfcn.h>

#include <cstdio>

#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "health.h"

namespace {

constexpr int kRounds = 3;

/// Loads the plugin kRounds times. Returns whether the world holds one entity, with this health.
bool plugin_heals(gloam::World& world, const char* path, int expected) {
  for (int round = 0; round < kRounds; ++round) {
    void* const plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (plugin == nullptr) {
      std::fprintf(stderr, "host_plugin: %s\n", dlerror());
      return false;
    }
    reinterpret_cast<void (*)(gloam::World&)>(dlsym(plugin, "heal"))(world);
    dlclose(plugin);
  }
  int sum = 0;
  world.view<const Health>().each([&](const Health& health) { sum += health.value; });
  if (sum == expected && world.entity_count() == 1 && world.resource<Score>().healed == kRounds) return true;
  std::fprintf(stderr, "host_plugin: health %d in %zu entities in place of %d\n", sum, world.entity_count(), expected);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  gloam::World host_first, plugin_first;
  host_first.set_resource(Score{});
  host_first.register_component<Health>();
  host_first.create(Health{5});
  plugin_first.set_resource(Score{});
  if (!plugin_heals(host_first, argv[1], 5 + kRounds)) return 1;
  return plugin_heals(plugin_first, argv[1], 1 + kRounds) ? 0 : 1;
}
