// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/scene_summary.h"

#include <gtest/gtest.h>

#include <memory>
#include <string_view>

#include "engine/ecs/view.h"
#include "modules/module_list/module_list.h"

namespace gloam {
namespace {

/// A module of which only components exist; a world calls for it once it has one.
class PlannedModule final : public Module {
 public:
  struct Planned {
    int number = 0;
  };
  [[nodiscard]] std::string_view name() const override { return "planned"; }
  [[nodiscard]] bool built() const override { return false; }
  void register_components(World& world) const override { world.register_component<Planned>("planned"); }
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    return {world.view<const Planned>().size() > 0, "the world asks for it"};
  }
};

TEST(MissingEffects, name_each_module_that_is_called_for_and_not_built_with_its_reason) {
  ModuleList modules = make_all_modules();
  modules.push_back(std::make_unique<PlannedModule>());
  World world;
  for (const auto& module : modules) module->register_components(world);
  EXPECT_EQ(missing_effects(world, modules), "");
  world.create(PlannedModule::Planned{});
  const std::string text = missing_effects(world, modules);
  EXPECT_NE(text.find("planned ("), std::string::npos) << text;
  EXPECT_EQ(text.find("shadows"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

}  // namespace
}  // namespace gloam
