// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/fog/components.h"
#include "modules/fog/module.h"

namespace gloam {
namespace {

struct FogDemand : ::testing::Test {
  std::unique_ptr<Module> fog = make_fog_module();
  World world;

  FogDemand() { fog->register_components(world); }
  void expect(bool needed, const char* reason, const RenderView* view = nullptr) {
    const Demand demand = fog->demand(world, view);
    EXPECT_EQ(demand.needed, needed);
    EXPECT_EQ(demand.reason, reason);
  }
};

TEST_F(FogDemand, is_for_fog_with_a_density) {
  expect(false, "no fog");
  world.create(Fog{});
  expect(false, "no fog");
  world.create(Fog{.density = 0.1f});
  expect(true, "the scene has fog");
}

TEST_F(FogDemand, is_for_all_views_but_captures) {
  world.create(Fog{.density = 0.1f});
  RenderView view;
  for (const ViewPurpose purpose : {ViewPurpose::main, ViewPurpose::reference}) {
    view.purpose = purpose;
    expect(true, "the scene has fog", &view);
  }
  view.purpose = ViewPurpose::capture;
  expect(false, "captures have no fog", &view);
}

}  // namespace
}  // namespace gloam
