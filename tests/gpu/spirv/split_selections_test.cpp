// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/split_selections.h"

#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include <map>
#include <random>
#include <set>
#include <vector>

#include "engine/gpu/spirv/many_selections.h"
#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/spirv/specialize.h"
#include "shaders/every/shaders.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/spirv/instructions.h"

namespace gloam::gpu {
namespace {

using SplitWords = std::vector<std::uint32_t>;

SplitWords specialized(const ShaderCode& code) {
  SplitWords words = spirv::specialize(code.words, {});
  if (words.empty()) words.assign(code.words.begin(), code.words.end());
  return words;
}

/// The labels that branch to each label.
std::map<std::uint32_t, std::set<std::uint32_t>> predecessors(std::span<const std::uint32_t> words) {
  std::map<std::uint32_t, std::set<std::uint32_t>> from;
  std::uint32_t at = 0;
  test::for_each_instruction(words, [&](std::uint32_t op, const auto& w) {
    if (op == spv::OpLabel) at = w[1];
    if (op == spv::OpBranch) from[w[1]].insert(at);
    if (op == spv::OpBranchConditional) {
      from[w[2]].insert(at);
      from[w[3]].insert(at);
    }
  });
  return from;
}

/// Blocks that a search from each loop's header visits, the largest of all loops: it goes on in steps, takes the second
/// target of a branch first, and forgets only blocks that it has left. SwiftShader searches so.
std::size_t search_visits(std::span<const std::uint32_t> words, std::size_t limit) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> targets;
  std::map<std::uint32_t, std::uint32_t> merges;  // by loop header
  std::uint32_t at = 0;
  test::for_each_instruction(words, [&](std::uint32_t op, const auto& w) {
    if (op == spv::OpLabel) at = w[1];
    if (op == spv::OpLoopMerge) merges[at] = w[1];
    if (op == spv::OpBranch) targets[at] = {w[1]};
    if (op == spv::OpBranchConditional) targets[at] = {w[3], w[2]};
  });
  std::size_t most = 0;
  for (const auto& [header, merge] : merges) {
    std::set<std::uint32_t> left = {merge};
    std::vector<std::uint32_t> waiting = {header};
    std::size_t visits = 0;
    for (; visits < waiting.size() && visits < limit; ++visits) {
      const std::uint32_t block = waiting[visits];
      for (const std::uint32_t target : targets[block])
        if (!left.contains(target)) waiting.push_back(target);
      left.insert(block);
    }
    most = std::max(most, visits);
  }
  return most;
}

TEST(SplitSelections, many_selections_have_as_many_ifs_as_asked_for) {
  for (const std::uint32_t count : {0u, 1u, 7u, 20u}) {
    const SplitWords words = spirv::many_selections(count);
    EXPECT_EQ(spirv::count_selections(words), count);
    EXPECT_TRUE(reflect_spirv({"many selections", words}).ok());
    const SplitWords split = spirv::split_selections(words);
    EXPECT_EQ(split.empty(), count == 0);
    EXPECT_EQ(spirv::count_selections(split), 0u);
  }
}

TEST(SplitSelections, a_search_that_walks_all_paths_ends) {
  const SplitWords joined = spirv::many_selections(12);
  EXPECT_GT(search_visits(joined, 1u << 20), 1u << 12);
  EXPECT_LT(search_visits(spirv::split_selections(joined), 1u << 20), 100u);
  std::size_t hard = 0;
  for (const ShaderCode* code : every_shader()) {
    const SplitWords words = specialized(*code);
    const std::size_t before = search_visits(words, 100'000);
    const SplitWords split = spirv::split_selections(words);
    const std::size_t after = split.empty() ? before : search_visits(split, 100'000);
    EXPECT_LT(after, 5'000u) << code->name << ", before " << before;
    hard += before == 100'000 ? 1 : 0;
  }
  EXPECT_GT(hard, 5u) << "no shader needs it";
}

TEST(SplitSelections, no_shader_keeps_more_than_a_few_ifs_with_an_else) {
  for (const ShaderCode* code : every_shader()) {
    const SplitWords words = specialized(*code);
    const SplitWords split = spirv::split_selections(words);
    EXPECT_LE(spirv::count_selections(split.empty() ? words : split), 16u) << code->name;
  }
}

TEST(SplitSelections, every_value_comes_from_the_blocks_that_branch_to_it) {
  for (const ShaderCode* code : every_shader()) {
    const SplitWords split = spirv::split_selections(specialized(*code));
    if (split.empty()) continue;
    const auto from = predecessors(split);
    std::uint32_t at = 0;
    std::set<std::uint32_t> results;
    test::for_each_instruction(split, [&](std::uint32_t op, const auto& w) {
      const bool result = op == spv::OpPhi || op == spv::OpLogicalNot || op == spv::OpConstantNull;
      if (op == spv::OpLabel || result) {
        EXPECT_TRUE(results.insert(w[result ? 2 : 1]).second) << code->name << ": an id twice";
      }
      if (op == spv::OpLabel) at = w[1];
      if (op != spv::OpPhi) return;
      std::set<std::uint32_t> named;
      for (std::size_t i = 4; i < w.size(); i += 2) named.insert(w[i]);
      EXPECT_EQ(named, from.at(at)) << code->name << ": value " << w[2];
    });
    EXPECT_LT(*results.rbegin(), split[3]) << code->name << ": an id beyond the bound";
  }
}

TEST(SplitSelections, keeps_the_interface_of_every_shader) {
  for (const ShaderCode* code : every_shader()) {
    const SplitWords words = specialized(*code);
    const SplitWords split = spirv::split_selections(words);
    if (split.empty()) continue;
    const auto before = reflect_spirv({code->name, words}), after = reflect_spirv({code->name, split});
    ASSERT_TRUE(after.ok()) << code->name << ": " << after.error().message;
    EXPECT_EQ(after->local_size, before->local_size) << code->name;
    EXPECT_EQ(after->bindings.size(), before->bindings.size()) << code->name;
  }
}

TEST(SplitSelections, functions_count_once_for_each_call) {
  EXPECT_EQ(spirv::count_selections(specialized(shaders::gpu_test::called_twice_comp)), 2u);
  EXPECT_EQ(spirv::count_selections({}), 0u);
}

TEST(SplitSelections, survives_broken_modules) {
  const SplitWords whole = spirv::many_selections(9);
  std::mt19937 random(3);
  for (int i = 0; i < 4000; ++i) {
    SplitWords words = whole;
    for (int k = 0; k < 3; ++k)
      words[5 + random() % (words.size() - 5)] =
          static_cast<std::uint32_t>(random() % 5 == 0 ? random() : random() % 90);
    if (i % 3 == 0) words.resize(random() % words.size());
    static_cast<void>(spirv::split_selections(words));
    static_cast<void>(spirv::count_selections(words));
  }
}

}  // namespace
}  // namespace gloam::gpu
