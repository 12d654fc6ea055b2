// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spec_constants.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/gpu/spirv/reflection.h"
#include "shaders/gpu_test/shaders.h"
#include "shaders/lights/shaders.h"

namespace gloam::gpu {
namespace {

std::vector<ReflectedConstant> constants_of(const ShaderCode& code) { return reflect_spirv(code).value().constants; }

std::string clause_of(const SpecConstants& constants) {
  const auto fault = find_fault(constants, constants_of(shaders::gpu_test::disabled_code_comp));
  return fault ? std::string(fault->name) + ": " + fault->clause : "";
}

TEST(SpecConstants, a_later_value_replaces_an_earlier_one) {
  SpecConstants constants = {{"kMode", 1u}, {"kTwice", true}, {"kMode", 2u}};
  EXPECT_EQ(constants.size(), 2u);
  EXPECT_EQ(constants.find("kMode")->value, SpecValue(2u));
  constants.set(SpecConstants{{"kMode", 3u}, {"kSteps", 1}});
  EXPECT_EQ(constants.size(), 3u);
  EXPECT_EQ(constants.find("kMode")->value, SpecValue(3u));
  EXPECT_EQ(constants.find("kFactor"), nullptr);
}

TEST(SpecConstants, the_order_of_calls_does_not_count) {
  EXPECT_EQ((SpecConstants{{"kA", 1u}, {"kB", 2u}}), (SpecConstants{{"kB", 2u}, {"kA", 1u}}));
  EXPECT_NE((SpecConstants{{"kA", 1u}}), (SpecConstants{{"kA", 1}})) << "types differ";
}

TEST(SpecConstants, numbers_come_from_the_shader) {
  const auto declared = constants_of(shaders::gpu_test::disabled_code_comp);
  const auto made = numbered({{"kFactor", 0.5f}, {"kMode", 7u}, {"kSteps", -1}, {"kTwice", true}}, declared);
  ASSERT_EQ(made.size(), 4u);
  const std::uint32_t expected[4] = {7, 1, 0xFFFFFFFFu, 0x3F000000u};  // by number: kMode, kTwice, kSteps, kFactor
  for (const NumberedConstant& constant : made) EXPECT_EQ(constant.value, expected[constant.id]) << constant.id;
}

TEST(SpecConstants, parts_of_the_workgroup_size_have_names) {
  const auto declared = constants_of(shaders::lights::find_lights_accurate_comp);
  ASSERT_EQ(declared.size(), 1u);
  EXPECT_EQ(declared[0].name, "local_size_y");
  EXPECT_EQ(declared[0].type, SpecType::unsigned_integer);
  EXPECT_EQ(numbered({{"local_size_y", 4u}}, declared).size(), 1u);
}

TEST(SpecConstants, a_name_that_no_shader_has_is_a_fault) {
  EXPECT_EQ(clause_of({{"kMode", 1u}}), "");
  EXPECT_EQ(clause_of({{"kMood", 1u}}), "kMood: the program has no specialisation constant of this name");
}

TEST(SpecConstants, shared_constants_apply_where_present) {
  SpecConstants constants;
  constants.set_if_present("kMood", 1u);
  EXPECT_EQ(clause_of(constants), "");
  EXPECT_TRUE(numbered(constants, constants_of(shaders::gpu_test::disabled_code_comp)).empty());
  constants.set("kMood", 1u);
  EXPECT_NE(clause_of(constants), "") << "the later call decides";
  EXPECT_EQ(clause_of(constants.where_present()), "");
}

TEST(SpecConstants, a_value_of_another_type_is_a_fault) {
  EXPECT_EQ(clause_of({{"kSteps", 1u}}), "kSteps: the shader declares it as int, and the value is of type uint");
  EXPECT_EQ(clause_of({{"kTwice", 1u}}), "kTwice: the shader declares it as bool, and the value is of type uint");
  SpecConstants shared;
  shared.set_if_present("kFactor", 1);
  EXPECT_EQ(clause_of(shared), "kFactor: the shader declares it as float, and the value is of type int");
}

TEST(SpecConstants, values_have_texts) {
  EXPECT_EQ(text_of(true), "true");
  EXPECT_EQ(text_of(8u), "8");
  EXPECT_EQ(text_of(-3), "-3");
  EXPECT_EQ(text_of(0.5f), "0.5");
}

}  // namespace
}  // namespace gloam::gpu
