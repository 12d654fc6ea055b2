// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include "sandbox/commands/commands.h"
#include "sandbox/scenes/builtin.h"

namespace gloam {

Status run_scenes(const CommandContext& context) {
  std::size_t widest = 0;
  for (const BuiltinScene& scene : builtin_scenes()) widest = std::max(widest, scene.name.size());
  for (const BuiltinScene& scene : builtin_scenes()) {
    const std::string gap(widest - scene.name.size() + 2, ' ');
    context.console.print("builtin:" + std::string(scene.name) + gap + std::string(scene.shows) + "\n");
  }
  return {};
}

}  // namespace gloam
