// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/shader_interface.h"

#include <gtest/gtest.h>

#include "shaders/gpu_test/shaders.h"

namespace gloam::gpu {
namespace {

class ShaderInterface : public ::testing::Test {
 protected:
  SpirvReflection from = *reflect_spirv(shaders::gpu_test::layouts_comp);
  SpirvReflection to = from;
};

TEST_F(ShaderInterface, a_shader_can_replace_itself) {
  EXPECT_EQ(interface_difference(from, to), "");
  to.bindings.front().used = !to.bindings.front().used;
  EXPECT_EQ(interface_difference(from, to), "") << "code may change";
}

TEST_F(ShaderInterface, tells_the_first_difference) {
  EXPECT_EQ(interface_difference(from, *reflect_spirv(shaders::gpu_test::triangle_frag)), "it is of another stage");
  to.local_size[1] += 1;
  EXPECT_EQ(interface_difference(from, to), "its workgroup size has changed");
  to = from;
  to.constants.push_back({"local_size_x", 0, SpecType::unsigned_integer});
  EXPECT_EQ(interface_difference(from, to), "its workgroup size has changed");
  to = from;
  to.push_constant_bytes += 4;
  EXPECT_EQ(interface_difference(from, to), "its push constants have changed");
}

TEST_F(ShaderInterface, compares_bindings_and_layouts) {
  const std::string name = from.bindings.front().name;
  to.bindings.erase(to.bindings.begin());
  EXPECT_EQ(interface_difference(from, to), "binding '" + name + "' is gone");
  EXPECT_EQ(interface_difference(to, from), "binding '" + name + "' is new");
  to = from;
  to.bindings.front().name = "renamed";
  EXPECT_EQ(interface_difference(from, to), "binding '" + name + "' has changed");
  to = from;
  to.structs.front().size += 16;
  EXPECT_EQ(interface_difference(from, to), "structure '" + from.structs.front().name + "' has changed");
}

TEST_F(ShaderInterface, compares_types_of_specialisation_constants_but_not_which_there_are) {
  from = to = *reflect_spirv(shaders::gpu_test::disabled_code_comp);
  to.constants.erase(to.constants.begin());
  for (ReflectedConstant& constant : to.constants) ++constant.id;
  EXPECT_EQ(interface_difference(from, to), "");
  EXPECT_EQ(interface_difference(to, from), "");
  to.constants.front().type = SpecType::floating;
  EXPECT_EQ(interface_difference(from, to), "specialisation constant '" + to.constants.front().name + "' has changed");
}

}  // namespace
}  // namespace gloam::gpu
