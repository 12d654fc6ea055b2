// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "engine/gpu/spirv/reflection.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/every/shaders.h"
#include "tests/render/shared_structs/shared_structs.h"
#include "tests/render/shared_structs_table.h"  // written by shared_structs.py from the structures of all *_shared.h

// C++ and shaders share one declaration of each structure. These tests compare the offsets of both compilers.

namespace gloam {
namespace {

using test::kSharedStructs;
using test::SharedMember;
using test::SharedStruct;

void expect_same_layout(const gpu::ReflectedStruct& in_shader, const SharedStruct& in_cpp) {
  ASSERT_EQ(in_shader.members.size(), in_cpp.members.size());
  for (std::size_t i = 0; i < in_cpp.members.size(); ++i) {
    const SharedMember& member = in_cpp.members[i];
    EXPECT_EQ(in_shader.members[i].name, member.name) << "member " << i;
    EXPECT_EQ(in_shader.members[i].offset, member.offset) << member.name;
    EXPECT_EQ(in_shader.members[i].size, member.size) << member.name;
    EXPECT_EQ(in_shader.members[i].array_stride, member.stride) << member.name;
  }
  EXPECT_EQ(in_shader.size, in_cpp.size);
}

TEST(SharedStructs, have_the_layout_of_cpp_in_every_shader) {
  std::set<std::string_view> unseen;
  for (const SharedStruct& in_cpp : kSharedStructs) unseen.insert(in_cpp.name);
  for (const gpu::ShaderCode* shader : every_shader()) {
    const auto reflection = gpu::reflect_spirv(*shader);
    ASSERT_TRUE(reflection.ok()) << reflection.error().message;
    for (const gpu::ReflectedStruct& in_shader : reflection->structs) {
      const auto in_cpp = std::ranges::find(kSharedStructs, in_shader.name, &SharedStruct::name);
      if (in_cpp == kSharedStructs.end()) continue;  // a block of the shader
      SCOPED_TRACE(in_shader.name + " in " + std::string(shader->name));
      expect_same_layout(in_shader, *in_cpp);
      unseen.erase(in_cpp->name);
    }
  }
  for (const std::string_view name : unseen) {
    // Rows are in an image: shaders fetch them as texels of four words.
    const auto row = std::ranges::find(kSharedStructs, name, &SharedStruct::name);
    EXPECT_TRUE(name.ends_with("Row") && row->size % sizeof(vec4) == 0)
        << "no shader has " << name << " in a buffer or a block";
  }
}

TEST(SharedStructs, push_constants_fit_into_what_every_device_has) {
  for (const gpu::ShaderCode* shader : every_shader())
    EXPECT_LE(gpu::reflect_spirv(*shader).value().push_constant_bytes, 128u) << shader->name;
}

TEST(SharedStructs, materials_fit_into_their_stride) { EXPECT_LE(sizeof(shaders::MaterialConstants), kMaterialStride); }

TEST(SharedStructs, the_lights_fit_into_a_uniform_buffer) {
  EXPECT_LE(sizeof(shaders::LightBlock), 65536u) << "64 KiB is what the devices we know bind";
}

TEST(SharedStructs, packed_vertices_are_what_the_kernel_and_the_streams_read) {
  EXPECT_EQ(sizeof(PackedFrame), 8u);     // rg32_uint, uvec2
  EXPECT_EQ(sizeof(PackedSurface), 24u);  // rgba32_float and rgba16_float
  EXPECT_EQ(offsetof(PackedSurface, color), 16u);
  EXPECT_EQ(sizeof(PackedInfluence), 16u);  // uvec4
  EXPECT_EQ(sizeof(vec3), 12u);
}

}  // namespace
}  // namespace gloam
