// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/reflection.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "shaders/gpu_test/shaders.h"

namespace gloam::gpu {
namespace {

SpirvReflection reflect(const ShaderCode& code) {
  const auto reflection = reflect_spirv(code);
  EXPECT_TRUE(reflection.ok()) << reflection.error().message;
  return reflection ? *reflection : SpirvReflection();
}

const SpirvReflection& layouts() {
  static const SpirvReflection reflection = reflect(shaders::gpu_test::layouts_comp);
  return reflection;
}

TEST(SpirvReflection, reads_stage_and_workgroup_size) {
  EXPECT_EQ(layouts().stage, ShaderStage::compute);
  EXPECT_EQ(layouts().local_size, (std::array<std::uint32_t, 3>{4, 2, 3}));
  EXPECT_EQ(reflect(shaders::gpu_test::triangle_vert).stage, ShaderStage::vertex);
  EXPECT_EQ(reflect(shaders::gpu_test::triangle_frag).stage, ShaderStage::fragment);
}

TEST(SpirvReflection, reads_the_size_of_push_constants) {
  EXPECT_EQ(layouts().push_constant_bytes, 16u);
  EXPECT_EQ(reflect(shaders::gpu_test::triangle_vert).push_constant_bytes, 0u);
}

TEST(SpirvReflection, tells_volumes_from_planes) {
  const SpirvReflection painted = reflect_spirv(shaders::gpu_test::paint_volume_comp).value();
  ASSERT_EQ(painted.bindings.size(), 1u);
  EXPECT_EQ(painted.bindings[0].kind, ResourceKind::storage_image);
  EXPECT_EQ(painted.bindings[0].dimension, ImageDimension::volume);
  const SpirvReflection seen = reflect_spirv(shaders::gpu_test::look_into_volume_comp).value();
  EXPECT_EQ(seen.bindings[0].kind, ResourceKind::sampled_image);
  EXPECT_EQ(seen.bindings[0].dimension, ImageDimension::volume);
}

TEST(SpirvReflection, tells_what_every_binding_is) {
  struct Expected {
    std::uint32_t set, binding;
    ResourceKind kind;
    std::uint32_t count;
    ImageDimension dimension;
    bool arrayed;
  };
  const std::vector<Expected> expected = {
      {0, 0, ResourceKind::storage_buffer, 1, ImageDimension::none, false},
      {0, 1, ResourceKind::uniform_buffer, 1, ImageDimension::none, false},
      {0, 2, ResourceKind::sampled_image, 1, ImageDimension::plane, false},
      {0, 5, ResourceKind::sampled_image, 4, ImageDimension::cube, true},
      {0, 6, ResourceKind::storage_buffer, 1, ImageDimension::none, false},
      {2, 1, ResourceKind::storage_image, 1, ImageDimension::plane, true},
  };
  ASSERT_EQ(layouts().bindings.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const ReflectedBinding& b = layouts().bindings[i];
    EXPECT_EQ(b.set, expected[i].set) << i;
    EXPECT_EQ(b.binding, expected[i].binding) << i;
    EXPECT_EQ(b.kind, expected[i].kind) << i;
    EXPECT_EQ(b.count, expected[i].count) << i;
    EXPECT_EQ(b.dimension, expected[i].dimension) << i;
    EXPECT_EQ(b.arrayed, expected[i].arrayed) << i;
    EXPECT_EQ(b.used, b.binding != 6) << i;
  }
  EXPECT_EQ(layouts().bindings[0].name, "Lights");
  EXPECT_EQ(layouts().bindings[1].name, "view");
  EXPECT_EQ(layouts().find_binding(2, 1)->name, "target");
  EXPECT_EQ(layouts().find_binding(1, 1), nullptr);
}

TEST(SpirvReflection, gives_offsets_of_members_by_structure_name) {
  const ReflectedStruct* light = layouts().find_struct("Light");
  ASSERT_NE(light, nullptr);
  ASSERT_EQ(light->members.size(), 4u);
  EXPECT_EQ(light->members[0].name, "position");
  EXPECT_EQ(light->members[0].size, 12u);
  EXPECT_EQ(light->members[1].name, "range_m");
  EXPECT_EQ(light->members[1].offset, 12u);
  EXPECT_EQ(light->members[2].offset, 16u);
  EXPECT_EQ(light->members[2].size, 36u);
  EXPECT_EQ(light->members[3].offset, 52u);
  EXPECT_EQ(light->size, 56u);

  const ReflectedStruct* lights = layouts().find_struct("Lights");
  ASSERT_NE(lights, nullptr);
  EXPECT_EQ(lights->members[1].offset, 4u);
  EXPECT_EQ(lights->members[1].array_stride, 56u);

  const ReflectedStruct* view = layouts().find_struct("View");
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(view->members[1].offset, 64u);
  EXPECT_EQ(view->members[1].size, 24u);
  EXPECT_EQ(view->members[2].offset, 88u);
  EXPECT_EQ(layouts().find_struct("Nothing"), nullptr);
}

TEST(SpirvReflection, names_the_shader_in_its_error) {
  const auto reflection = reflect_spirv({"broken", {}});
  ASSERT_FALSE(reflection.ok());
  EXPECT_EQ(reflection.error().kind, ErrorKind::input);
  EXPECT_NE(reflection.error().message.find("\"broken\""), std::string::npos);
}

TEST(SpirvReflection, refuses_words_that_end_in_the_middle_of_an_instruction) {
  const auto words = shaders::gpu_test::layouts_comp.words;
  EXPECT_FALSE(reflect_spirv({"cut", words.first(words.size() / 2 - 1)}).ok() &&
               reflect_spirv({"cut", words.first(words.size() / 2)}).ok() &&
               reflect_spirv({"cut", words.first(words.size() / 2 + 1)}).ok());
}

TEST(SpirvReflection, survives_any_damage) {
  const auto words = shaders::gpu_test::layouts_comp.words;
  std::mt19937 random(11);
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::uint32_t> damaged(words.begin(), words.end());
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = random() % damaged.size();
      damaged[at] = random() % 2 == 0 ? static_cast<std::uint32_t>(random()) : damaged[random() % damaged.size()];
    }
    if (damaged[3] > 100000) damaged[3] = 100000;  // a huge bound is legal and only costs time
    (void)reflect_spirv({"damaged", damaged});
  }
}

}  // namespace
}  // namespace gloam::gpu
