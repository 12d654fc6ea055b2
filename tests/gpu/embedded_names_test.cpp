// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Names that the build leaves in embedded SPIR-V (cmake/EmbedSpirv.cmake).
#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include <cstddef>
#include <cstdint>
#include <set>

#include "engine/gpu/spirv/reflection.h"
#include "shaders/every/shaders.h"

namespace gloam::gpu {
namespace {

constexpr std::uint32_t kHeaderWords = 5;

/// Ids of a module: those with a name, and those that should have one.
struct NamedIds {
  std::set<std::uint32_t> named;
  std::set<std::uint32_t> wanted;
};

NamedIds named_ids(const ShaderCode& code) {
  NamedIds ids;
  for (std::size_t at = kHeaderWords; at < code.words.size(); at += code.words[at] >> spv::WordCountShift) {
    const std::uint32_t op = code.words[at] & spv::OpCodeMask;
    if (op == spv::OpName) ids.named.insert(code.words[at + 1]);
    if (op == spv::OpTypeStruct) ids.wanted.insert(code.words[at + 1]);
    if (op == spv::OpDecorate &&
        (code.words[at + 2] == spv::DecorationSpecId || code.words[at + 2] == spv::DecorationBinding))
      ids.wanted.insert(code.words[at + 1]);
  }
  return ids;
}

TEST(EmbeddedNames, are_those_of_bindings_constants_and_structures) {
  ASSERT_FALSE(every_shader().empty());
  for (const ShaderCode* code : every_shader()) {
    const NamedIds ids = named_ids(*code);
    for (const std::uint32_t id : ids.named)
      EXPECT_TRUE(GLOAM_ALL_SHADER_NAMES || ids.wanted.contains(id)) << code->name << ": id " << id;
  }
}

// Passes set specialisation constants by name. Parts of the workgroup size get theirs from reflection.
TEST(EmbeddedNames, every_specialisation_constant_has_one) {
  std::size_t constants = 0;
  for (const ShaderCode* code : every_shader()) {
    std::set<std::uint32_t> numbers, named;
    for (std::size_t at = kHeaderWords; at < code->words.size(); at += code->words[at] >> spv::WordCountShift)
      if ((code->words[at] & spv::OpCodeMask) == spv::OpDecorate && code->words[at + 2] == spv::DecorationSpecId)
        numbers.insert(code->words[at + 3]);
    const auto reflection = reflect_spirv(*code);
    ASSERT_TRUE(reflection.ok()) << code->name;
    for (const ReflectedConstant& constant : reflection->constants) named.insert(constant.id);
    EXPECT_EQ(named, numbers) << code->name;
    constants += named.size();
  }
  EXPECT_GT(constants, 400u);
}

TEST(EmbeddedNames, every_binding_and_structure_in_memory_has_one) {
  std::size_t bindings = 0;
  for (const ShaderCode* code : every_shader()) {
    const auto reflection = reflect_spirv(*code);
    ASSERT_TRUE(reflection.ok()) << code->name;
    for (const ReflectedBinding& binding : reflection->bindings) EXPECT_FALSE(binding.name.empty()) << code->name;
    for (const ReflectedStruct& structure : reflection->structs) {
      EXPECT_FALSE(structure.name.empty()) << code->name;
      for (const ReflectedMember& member : structure.members)
        EXPECT_FALSE(member.name.empty()) << code->name << ": " << structure.name;
    }
    bindings += reflection->bindings.size();
  }
  EXPECT_GT(bindings, 500u);
}

}  // namespace
}  // namespace gloam::gpu
