// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/specialize.h"

#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "engine/gpu/spirv/reflection.h"
#include "shaders/every/shaders.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/spirv/instructions.h"

namespace gloam::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

std::size_t count_of(std::span<const std::uint32_t> words, std::uint32_t op) {
  std::size_t count = 0;
  test::for_each_instruction(words, [&](std::uint32_t found, const auto&) { count += found == op ? 1 : 0; });
  return count;
}

bool has_specialisation(std::span<const std::uint32_t> words) {
  bool found = false;
  test::for_each_instruction(words, [&](std::uint32_t op, const auto& w) {
    found = found || (op == spv::OpDecorate && w[2] == spv::DecorationSpecId);
  });
  return found;
}

Words disabled_code(std::uint32_t mode) {
  const NumberedConstant constants[] = {{.id = 0, .value = mode}};
  return spirv::specialize(shaders::gpu_test::disabled_code_comp.words, constants);
}

TEST(SpirvSpecialize, leaves_out_functions_that_nothing_calls) {
  EXPECT_EQ(count_of(disabled_code(4), spv::OpFunction), 2u);
  EXPECT_EQ(count_of(disabled_code(4), spv::OpFunctionCall), 1u);
  EXPECT_EQ(count_of(disabled_code(0), spv::OpFunction), 1u);
  EXPECT_EQ(count_of(disabled_code(0), spv::OpFunctionCall), 0u);
}

TEST(SpirvSpecialize, leaves_out_branches_that_are_never_taken) {
  const Words all(shaders::gpu_test::disabled_code_comp.words.begin(),
                  shaders::gpu_test::disabled_code_comp.words.end());
  EXPECT_LT(count_of(disabled_code(0), spv::OpBranchConditional), count_of(all, spv::OpBranchConditional));
  EXPECT_LT(count_of(disabled_code(3), spv::OpBranchConditional), count_of(disabled_code(4), spv::OpBranchConditional));
}

TEST(SpirvSpecialize, leaves_no_choice_between_constant_vectors) {
  for (std::uint32_t flag = 0; flag < 3; ++flag) {
    const NumberedConstant constants[] = {{.id = 0, .value = flag}};
    const Words words = spirv::specialize(shaders::gpu_test::choose_vectors_comp.words, constants);
    ASSERT_FALSE(words.empty());
    test::for_each_instruction(words, [&](std::uint32_t op, const auto& w) {
      EXPECT_FALSE(op == spv::OpSpecConstantOp && w[3] == spv::OpSelect) << "flag " << flag;
    });
  }
}

/// A module with a specialisation constant, id 4, and a choice between two vectors, id 12, by components.
Words module_with_choice_by_components(std::uint32_t second_vector_op) {
  Words words = {spv::MagicNumber, 0x00010600, 0, 20, 0};
  const auto add = [&](std::uint32_t op, std::initializer_list<std::uint32_t> operands) {
    words.push_back((static_cast<std::uint32_t>(operands.size()) + 1) << spv::WordCountShift | op);
    words.insert(words.end(), operands);
  };
  add(spv::OpDecorate, {4, spv::DecorationSpecId, 0});
  add(spv::OpTypeBool, {1});
  add(spv::OpTypeVector, {2, 1, 3});
  add(spv::OpConstantFalse, {1, 3});
  add(spv::OpSpecConstantTrue, {1, 4});
  add(spv::OpSpecConstantComposite, {2, 5, 4, 3, 4});
  add(spv::OpTypeFloat, {6, 32});
  add(spv::OpTypeVector, {7, 6, 3});
  for (const std::uint32_t number : {8u, 9u}) add(spv::OpConstant, {6, number, 0x3f800000u + number});
  add(spv::OpConstantComposite, {7, 10, 8, 8, 8});
  if (second_vector_op == spv::OpConstantComposite) {
    add(second_vector_op, {7, 11, 9, 9, 9});
  } else {
    add(second_vector_op, {7, 11});
  }
  add(spv::OpSpecConstantOp, {7, 12, spv::OpSelect, 5, 10, 11});
  return words;
}

/// The operands after the type of the instruction that defines `id` as a constant.
Words constant_of(std::span<const std::uint32_t> words, std::uint32_t id, std::uint32_t op) {
  Words operands;
  test::for_each_instruction(words, [&](std::uint32_t found, const auto& w) {
    if (found == op && w.size() > 2 && w[2] == id) operands.assign(w.begin() + 3, w.end());
  });
  return operands;
}

TEST(SpirvSpecialize, chooses_components_of_constant_vectors_one_by_one) {
  const Words words = module_with_choice_by_components(spv::OpConstantComposite);
  EXPECT_EQ(constant_of(spirv::specialize(words, {}), 12, spv::OpConstantComposite), (Words{8, 9, 8}));
  const NumberedConstant off[] = {{.id = 0, .value = 0}};
  EXPECT_EQ(constant_of(spirv::specialize(words, off), 12, spv::OpConstantComposite), (Words{9, 9, 9}));
}

TEST(SpirvSpecialize, leaves_choices_of_components_that_have_no_id_to_the_driver) {
  const Words words = module_with_choice_by_components(spv::OpConstantNull);
  EXPECT_EQ(constant_of(spirv::specialize(words, {}), 12, spv::OpSpecConstantOp), (Words{spv::OpSelect, 5, 10, 11}));
  const NumberedConstant off[] = {{.id = 0, .value = 0}};
  const Words specialized = spirv::specialize(words, off);
  EXPECT_EQ(count_of(specialized, spv::OpSpecConstantOp), 0u);
  EXPECT_EQ(count_of(specialized, spv::OpConstantNull), 2u);
}

TEST(SpirvSpecialize, gives_nothing_for_a_module_without_specialisation_constants) {
  EXPECT_TRUE(spirv::specialize(shaders::gpu_test::halve_comp.words, {}).empty());
}

TEST(SpirvSpecialize, keeps_the_interface_of_every_shader) {
  for (const ShaderCode* code : every_shader()) {
    const Words words = spirv::specialize(code->words, {});
    EXPECT_EQ(words.empty(), !has_specialisation(code->words)) << code->name;
    if (words.empty()) continue;
    EXPECT_FALSE(has_specialisation(words)) << code->name;
    const auto before = reflect_spirv(*code), after = reflect_spirv({code->name, words});
    ASSERT_TRUE(after.ok()) << code->name << ": " << after.error().message;
    EXPECT_EQ(after->stage, before->stage);
    EXPECT_EQ(after->local_size, before->local_size) << code->name;
    EXPECT_EQ(after->push_constant_bytes, before->push_constant_bytes);
    EXPECT_EQ(after->bindings.size(), before->bindings.size()) << code->name;
    EXPECT_LE(count_of(words, spv::OpSelectionMerge), count_of(code->words, spv::OpSelectionMerge)) << code->name;
  }
}

TEST(SpirvSpecialize, names_only_blocks_and_functions_that_exist) {
  for (const ShaderCode* code : every_shader()) {
    for (std::uint32_t value = 0; value < 4; ++value) {
      std::vector<NumberedConstant> constants;
      for (std::uint32_t id = 0; id < 32; ++id) constants.push_back({.id = id, .value = value});
      const Words words = spirv::specialize(code->words, constants);
      std::set<std::uint32_t> labels, functions, named;
      std::set<std::uint32_t> called;
      test::for_each_instruction(words, [&](std::uint32_t op, const auto& w) {
        if (op == spv::OpLabel) labels.insert(w[1]);
        if (op == spv::OpFunction) functions.insert(w[2]);
        if (op == spv::OpFunctionCall) called.insert(w[3]);
        if (op == spv::OpBranch || op == spv::OpSelectionMerge || op == spv::OpLoopMerge) named.insert(w[1]);
        if (op == spv::OpLoopMerge) named.insert(w[2]);
        if (op == spv::OpBranchConditional) named.insert({w[2], w[3]});
        for (std::size_t i = 4; op == spv::OpPhi && i < w.size(); i += 2) named.insert(w[i]);
      });
      EXPECT_TRUE(std::ranges::includes(labels, named)) << code->name << ", constants " << value;
      EXPECT_TRUE(std::ranges::includes(functions, called)) << code->name << ", constants " << value;
    }
  }
}

TEST(SpirvSpecialize, survives_damaged_modules) {
  const std::span<const std::uint32_t> modules[] = {shaders::gpu_test::disabled_code_comp.words,
                                                    shaders::gpu_test::choose_vectors_comp.words};
  std::mt19937 random(7);
  for (int round = 0; round < 6000; ++round) {
    const auto words = modules[round % 2];
    Words damaged(words.begin(), words.end());
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = random() % damaged.size();
      damaged[at] = random() % 2 == 0 ? static_cast<std::uint32_t>(random()) : damaged[random() % damaged.size()];
    }
    const NumberedConstant constants[] = {{.id = 0, .value = round % 6u}};
    static_cast<void>(spirv::specialize(damaged, constants));
  }
}

}  // namespace
}  // namespace gloam::gpu
