// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "engine/ecs/world.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/view.h"
#include "modules/glare/components.h"
#include "modules/glare/knobs.h"
#include "modules/glare/module.h"

namespace gloam {
namespace {

struct GlareDemand : ::testing::Test {
  std::unique_ptr<Module> glare = make_glare_module();
  World world;
  RenderView view;

  GlareDemand() { glare->register_components(world); }
  void expect(bool needed, const char* reason, bool of_view = false) {
    const Demand demand = glare->demand(world, of_view ? &view : nullptr);
    EXPECT_EQ(demand.needed, needed);
    EXPECT_EQ(demand.reason, reason);
  }
  void expect_view(bool needed, const char* reason) { expect(needed, reason, true); }
};

TEST_F(GlareDemand, is_for_cameras_that_scatter_light) {
  expect(false, "no camera has glare");
  const Entity camera = world.create(Glare{0.0f});
  expect(false, "no camera has glare");
  world.get<Glare>(camera).share = 0.1f;
  expect(true, "1 camera has glare");
  world.create(Glare{});
  expect(true, "2 cameras have glare");
}

TEST_F(GlareDemand, is_for_all_cameras_of_a_world_with_a_default) {
  view.camera_entity = world.create();
  expect_view(false, "the view's camera has no glare");
  add_default_glare(world);
  expect(true, "cameras have glare by default");
  expect_view(true, "the view's camera has glare");
  view.camera_entity = kNoEntity;
  expect_view(true, "the view's camera has glare");
}

TEST_F(GlareDemand, of_a_camera_is_its_own) {
  add_default_glare(world);
  view.camera_entity = world.create(Glare{0.0f});
  expect_view(false, "the view's camera has no glare");
  for (const float share : {-1.0f, std::nanf("")}) {
    world.get<Glare>(view.camera_entity).share = share;
    expect_view(false, "the view's camera has no glare");
  }
  world.get<Glare>(view.camera_entity).share = 0.01f;
  expect_view(true, "the view's camera has glare");
}

TEST_F(GlareDemand, is_for_pictures_and_not_for_captures_and_companions) {
  add_default_glare(world);
  for (const ViewPurpose purpose : {ViewPurpose::main, ViewPurpose::reference}) {
    view.purpose = purpose;
    expect_view(true, "the view's camera has glare");
  }
  view.purpose = ViewPurpose::capture;
  expect_view(false, "captures have no lens");
  view.purpose = ViewPurpose::main;
  view.main_view = ViewId{view.id.value + 1};
  expect_view(false, "the view's main view has the glare");
}

TEST_F(GlareDemand, the_knob_switches_the_module_off) {
  KnobRegistry knobs;
  glare->knobs(knobs);
  EXPECT_EQ(glare->switched_off(world, knobs), "");
  ASSERT_TRUE(knobs.set("glare.lines", "off").ok());
  EXPECT_EQ(glare->switched_off(world, knobs), "glare.lines=off");
}

}  // namespace
}  // namespace gloam
