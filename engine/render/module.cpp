// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/module.h"

#include <algorithm>
#include <cstddef>

#include "engine/core/assert.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/reference/reference.h"
#include "engine/scene/keys/registry.h"

namespace gloam {
namespace {

void check_present(const ModuleList& modules) {
  for (std::size_t i = 0; i < modules.size(); ++i)
    GLOAM_ASSERT(modules[i] != nullptr, "module " + std::to_string(i) + " of the list is null");
}

std::size_t place_of(const ModuleList& modules, std::string_view name) {
  const auto found = std::ranges::find_if(modules, [&](const auto& module) { return module->name() == name; });
  return static_cast<std::size_t>(found - modules.begin());
}

}  // namespace

std::vector<ReferenceInfo> Module::references() const { return {}; }

std::vector<MeasureInfo> Module::measures() const { return {}; }

void check_modules(const ModuleList& modules) {
  check_present(modules);
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const std::string name(modules[i]->name());
    GLOAM_ASSERT(!name.empty(), "module " + std::to_string(i) + " of the list has no name");
    GLOAM_ASSERT(name != "engine", "a module must not be named \"engine\", as the engine is");
    GLOAM_ASSERT(place_of(modules, name) == i, "two modules of the list are named \"" + name + "\"");
    for (const std::string_view other : modules[i]->needs())
      GLOAM_ASSERT(place_of(modules, other) < modules.size(),
                   "module \"" + name + "\" needs the module \"" + std::string(other) + "\", which is not in the list");
    const auto check_order = [&](std::string_view other) {
      const std::size_t place = place_of(modules, other);
      GLOAM_ASSERT(place < i || place == modules.size(),
                   "module \"" + name + "\" must come after \"" + std::string(other) + "\" in the list of modules");
    };
    std::ranges::for_each(modules[i]->needs(), check_order);
    std::ranges::for_each(modules[i]->follows(), check_order);
  }
}

KeyRegistry make_key_registry(const ModuleList& modules) {
  check_present(modules);
  KeyRegistry registry;
  add_engine_keys(registry);
  for (const auto& module : modules) module->scene_keys(registry);
  return registry;
}

}  // namespace gloam
