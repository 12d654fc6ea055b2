// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/control_flow.h"

#include <algorithm>

#include "engine/gpu/spirv/opcodes.h"

namespace gloam::gpu::spirv {
namespace {

bool find_targets(FunctionBlocks& function, Block& block) {
  const Instruction& last = block.instructions.back();
  if (last.op == op_switch) return false;
  if (last.op != op_branch && last.op != op_branch_conditional) return true;
  const std::size_t first = last.op == op_branch ? 1 : 2;
  for (std::size_t i = first; i < first + (last.op == op_branch ? 1 : 2); ++i) {
    const auto found = function.block_of_label.find(last.words[i]);
    if (found == function.block_of_label.end()) return false;
    if (std::ranges::find(block.targets, found->second) == block.targets.end()) block.targets.push_back(found->second);
  }
  return true;
}

/// The fewest words of an instruction whose operands are read.
std::size_t least_words(std::uint32_t op) {
  switch (op) {
    case op_function:
      return 5;
    case op_entry_point:
    case op_type_int:
    case op_constant:
    case op_spec_constant:
    case op_spec_constant_op:
    case op_function_call:
    case op_loop_merge:
    case op_branch_conditional:
      return 4;
    case op_decorate:
    case op_constant_true:
    case op_constant_false:
    case op_spec_constant_true:
    case op_spec_constant_false:
    case op_spec_constant_composite:
    case op_phi:
    case op_selection_merge:
      return 3;
    case op_name:
    case op_type_bool:
    case op_label:
    case op_branch:
      return 2;
    default:
      return 1;
  }
}

bool names_known_blocks(const FunctionBlocks& function, const Instruction& phi) {
  for (std::size_t i = 4; i < phi.words.size(); i += 2)
    if (!function.block_of_label.contains(phi.words[i])) return false;
  return true;
}

/// Fills function.order by a depth-first search that keeps its own stack.
void sort_blocks(FunctionBlocks& function) {
  struct Visit {
    std::uint32_t block = 0;
    std::size_t next = 0;  // target to visit next
  };
  std::vector<bool> seen(function.blocks.size(), false);
  std::vector<Visit> stack{{}};
  seen[0] = true;
  while (!stack.empty()) {
    Visit& visit = stack.back();
    const std::vector<std::uint32_t>& targets = function.blocks[visit.block].targets;
    if (visit.next == targets.size()) {
      function.order.push_back(visit.block);
      stack.pop_back();
      continue;
    }
    const std::uint32_t target = targets[visit.next++];
    if (seen[target]) continue;
    seen[target] = true;
    stack.push_back({target, 0});
  }
  std::ranges::reverse(function.order);
}

}  // namespace

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> words) {
  std::vector<Instruction> instructions;
  instructions.reserve(words.size() / 4);
  while (!words.empty()) {
    const std::size_t count = words[0] >> 16;
    if (count < least_words(words[0] & 0xffff) || count > words.size()) return {};
    instructions.push_back({words[0] & 0xffff, words.first(count)});
    words = words.subspan(count);
  }
  return instructions;
}

bool divide_into_blocks(std::span<const Instruction> function, FunctionBlocks& result) {
  const auto is_label = [](const Instruction& instruction) { return instruction.op == op_label; };
  const auto begin = function.begin(), end = function.end();
  auto at = std::find_if(begin, end, is_label);
  result.head = {begin, at};
  while (at != end) {
    const auto next = std::find_if(at + 1, end, is_label);
    if (next == at + 1) return false;
    Block block{.label = at->words[1], .instructions = {at + 1, next}, .targets = {}};
    if (const auto before = block.instructions.size(); before > 1) {
      const Instruction& merge = block.instructions[before - 2];
      if (merge.op == op_selection_merge || merge.op == op_loop_merge) block.merge = &merge;
    }
    result.block_of_label.emplace(block.label, static_cast<std::uint32_t>(result.blocks.size()));
    result.blocks.push_back(std::move(block));
    at = next;
  }
  if (result.blocks.empty()) return false;
  for (Block& block : result.blocks) {
    if (!find_targets(result, block)) return false;
    for (const Instruction& instruction : block.instructions)
      if (instruction.op == op_phi && !names_known_blocks(result, instruction)) return false;
  }
  sort_blocks(result);
  return true;
}

}  // namespace gloam::gpu::spirv
