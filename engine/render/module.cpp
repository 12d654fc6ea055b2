// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/module.h"

namespace gloam {

KeyRegistry make_key_registry(const ModuleList& modules) {
  KeyRegistry registry;
  add_engine_keys(registry);
  for (const auto& module : modules) module->scene_keys(registry);
  return registry;
}

}  // namespace gloam
