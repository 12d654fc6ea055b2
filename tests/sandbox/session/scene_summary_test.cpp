// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/scene_summary.h"

#include <gtest/gtest.h>

#include "modules/module_list/module_list.h"
#include "modules/particles/components.h"

namespace gloam {
namespace {

TEST(MissingEffects, name_each_module_that_is_called_for_and_not_built_with_its_reason) {
  const ModuleList modules = make_all_modules();
  World world;
  for (const auto& module : modules) module->register_components(world);
  EXPECT_EQ(missing_effects(world, modules), "");
  world.create(ParticleEmitter{.kind = EmitterKind::fog});
  const std::string text = missing_effects(world, modules);
  EXPECT_NE(text.find("particles ("), std::string::npos) << text;
  EXPECT_EQ(text.find("shadows"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

}  // namespace
}  // namespace gloam
