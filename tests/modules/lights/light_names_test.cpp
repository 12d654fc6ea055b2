// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/lights/light_names.h"

namespace gloam {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct LightNames : ::testing::Test {
  World world;
  Entity lamp{1, 1};
  Entity torch{2, 1};

  LightNames() {
    prepare_scene_world(world);
    auto& names = world.resource<SceneNames>();
    names.add("light", "lamp", lamp);
    names.add("light", "red torch", torch);
    names.add("camera", "lamp", Entity{3, 1});
    names.add("light", "twin", Entity{4, 1});
    names.add("light", "twin", Entity{5, 1});
  }
  [[nodiscard]] std::string fault(std::string_view names) const {
    const auto found = resolve_light_names(world, names, "gloam.test.lights");
    EXPECT_FALSE(found.ok());
    if (found.ok()) return {};
    EXPECT_EQ(found.error().kind, ErrorKind::input);
    return found.error().message;
  }
};

TEST_F(LightNames, come_in_the_order_of_the_list_trimmed) {
  for (const char* list : {"red torch,lamp", " red torch , lamp ", "red torch,,lamp,"}) {
    const auto found = resolve_light_names(world, list, "key");
    ASSERT_TRUE(found.ok()) << list;
    EXPECT_THAT(*found, ElementsAre(torch, lamp)) << list;
  }
}

TEST_F(LightNames, of_an_empty_list_are_none) {
  for (const char* list : {"", " ", ",", " , "}) {
    const auto found = resolve_light_names(world, list, "key");
    ASSERT_TRUE(found.ok());
    EXPECT_THAT(*found, IsEmpty());
  }
}

TEST_F(LightNames, that_are_absent_are_an_error_that_names_key_name_and_what_there_is) {
  EXPECT_THAT(fault("lamp, lantern"),
              AllOf(HasSubstr("gloam.test.lights"), HasSubstr("\"lantern\""), HasSubstr("lamp, red torch")));
}

// Hard case: scene.name_twice
TEST_F(LightNames, that_two_lights_share_are_an_error_only_when_used) {
  EXPECT_TRUE(resolve_light_names(world, "lamp", "key").ok());
  EXPECT_THAT(fault("twin"), AllOf(HasSubstr("gloam.test.lights"), HasSubstr("\"twin\""), HasSubstr("2 light nodes")));
}

}  // namespace
}  // namespace gloam
