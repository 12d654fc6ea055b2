// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/runtime_conditions.h"

#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include <random>
#include <set>
#include <vector>

#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/spirv/specialize.h"
#include "shaders/every/shaders.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/spirv/instructions.h"

namespace gloam::gpu {
namespace {

using ModuleWords = std::vector<std::uint32_t>;

std::size_t branches_of(std::span<const std::uint32_t> words) {
  std::size_t count = 0;
  test::for_each_instruction(words, [&](std::uint32_t op, const auto&) {
    count += op == spv::OpBranchConditional || op == spv::OpSwitch ? 1 : 0;
  });
  return count;
}

ModuleWords kind_of_branch(std::uint32_t kind) {
  const NumberedConstant constants[] = {{.id = 0, .value = kind}};
  return spirv::specialize(shaders::gpu_test::uniform_branches_comp.words, constants);
}

/// Branches whose condition is another one than before.
std::size_t changed_branches(std::span<const std::uint32_t> before, std::span<const std::uint32_t> after) {
  std::vector<std::uint32_t> old, now;
  const auto collect = [](std::vector<std::uint32_t>& conditions) {
    return [&](std::uint32_t op, const auto& w) {
      if (op == spv::OpBranchConditional || op == spv::OpSwitch) conditions.push_back(w[1]);
    };
  };
  test::for_each_instruction(before, collect(old));
  test::for_each_instruction(after, collect(now));
  std::size_t changed = 0;
  for (std::size_t i = 0; i < old.size() && i < now.size(); ++i) changed += old[i] != now[i] ? 1 : 0;
  return changed;
}

TEST(UniformConditions, that_blocks_push_constants_and_arguments_decide_are_hidden) {
  for (const std::uint32_t kind : {0u, 1u, 2u, 4u}) {
    const ModuleWords before = kind_of_branch(kind);
    ASSERT_FALSE(before.empty());
    const ModuleWords after = spirv::hide_uniform_conditions(before);
    ASSERT_FALSE(after.empty()) << "kind " << kind;
    EXPECT_EQ(branches_of(after), branches_of(before));
    EXPECT_GE(changed_branches(before, after), kind == 4 ? 2u : 1u) << "kind " << kind;
  }
  // The function is called with a uniform: its exit by value is decided by it, its loop of 40 turns is not.
  const ModuleWords before = kind_of_branch(3);
  EXPECT_EQ(changed_branches(before, spirv::hide_uniform_conditions(before)), 1u);
}

TEST(UniformConditions, of_a_switch_are_hidden) {
  const ModuleWords after = spirv::hide_uniform_conditions(shaders::gpu_test::uniform_switch_comp.words);
  std::set<std::uint32_t> selected, switched;
  test::for_each_instruction(after, [&](std::uint32_t op, const auto& w) {
    if (op == spv::OpSelect) selected.insert(w[2]);
    if (op == spv::OpSwitch && selected.contains(w[1])) switched.insert(w[1]);
  });
  EXPECT_EQ(switched.size(), 1u);
}

TEST(UniformConditions, other_branches_stay_as_they_are) {
  for (const std::uint32_t kind : {5u, 6u, 7u}) {
    const ModuleWords before = kind_of_branch(kind);
    ASSERT_GT(branches_of(before), 0u) << "kind " << kind;
    EXPECT_TRUE(spirv::hide_uniform_conditions(before).empty()) << "kind " << kind;
  }
}

TEST(UniformConditions, hiding_adds_one_input_at_most_and_keeps_the_interface_of_every_shader) {
  std::size_t changed = 0;
  for (const ShaderCode* code : every_shader()) {
    const ModuleWords words = spirv::hide_uniform_conditions(code->words);
    if (words.empty()) continue;
    ++changed;
    EXPECT_GE(changed_branches(code->words, words), 1u) << code->name;
    EXPECT_TRUE(spirv::hide_uniform_conditions(words).empty()) << code->name << " keeps a uniform condition";
    const auto before = reflect_spirv(*code), after = reflect_spirv({code->name, words});
    ASSERT_TRUE(after.ok()) << code->name << ": " << after.error().message;
    EXPECT_EQ(after->local_size, before->local_size) << code->name;
    EXPECT_EQ(after->push_constant_bytes, before->push_constant_bytes) << code->name;
    EXPECT_EQ(after->bindings.size(), before->bindings.size()) << code->name;
  }
  EXPECT_GT(changed, 50u) << "the check sees nothing";
}

TEST(UniformConditions, damaged_modules_do_no_harm) {
  const auto words = shaders::gpu_test::uniform_branches_comp.words;
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    ModuleWords damaged(words.begin(), words.end());
    for (std::uint32_t c = 0; c < 1 + random() % 4; ++c) {
      const std::size_t at = random() % damaged.size();
      damaged[at] = random() % 2 == 0 ? static_cast<std::uint32_t>(random()) : damaged[random() % damaged.size()];
    }
    static_cast<void>(spirv::hide_uniform_conditions(damaged));
  }
}

}  // namespace
}  // namespace gloam::gpu
