// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/control_flow.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>

namespace gloam::gpu::spirv {
namespace {

bool find_targets(FunctionBlocks& function, Block& block) {
  const Instruction& last = block.instructions.back();
  if (last.op == spv::OpSwitch) return false;
  if (last.op != spv::OpBranch && last.op != spv::OpBranchConditional) return true;
  const std::size_t first = last.op == spv::OpBranch ? 1 : 2;
  for (std::size_t i = first; i < first + (last.op == spv::OpBranch ? 1 : 2); ++i) {
    const auto found = function.block_of_label.find(last.words[i]);
    if (found == function.block_of_label.end()) return false;
    if (std::ranges::find(block.targets, found->second) == block.targets.end()) block.targets.push_back(found->second);
  }
  return true;
}

/// The fewest words of an instruction whose operands are read.
std::size_t least_words(std::uint32_t op) {
  switch (op) {
    case spv::OpFunction:
      return 5;
    case spv::OpEntryPoint:
    case spv::OpTypeInt:
    case spv::OpConstant:
    case spv::OpSpecConstant:
    case spv::OpSpecConstantOp:
    case spv::OpFunctionCall:
    case spv::OpLoopMerge:
    case spv::OpBranchConditional:
      return 4;
    case spv::OpDecorate:
    case spv::OpConstantTrue:
    case spv::OpConstantFalse:
    case spv::OpSpecConstantTrue:
    case spv::OpSpecConstantFalse:
    case spv::OpSpecConstantComposite:
    case spv::OpPhi:
    case spv::OpSelectionMerge:
      return 3;
    case spv::OpName:
    case spv::OpTypeBool:
    case spv::OpLabel:
    case spv::OpBranch:
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
    const std::size_t count = words[0] >> spv::WordCountShift;
    if (count < least_words(words[0] & spv::OpCodeMask) || count > words.size()) return {};
    instructions.push_back({words[0] & spv::OpCodeMask, words.first(count)});
    words = words.subspan(count);
  }
  return instructions;
}

std::span<const Instruction> globals_of(std::span<const Instruction> instructions) {
  return {instructions.begin(), std::ranges::find(instructions, std::uint32_t{spv::OpFunction}, &Instruction::op)};
}

std::vector<std::span<const Instruction>> functions_of(std::span<const Instruction> instructions) {
  std::vector<std::span<const Instruction>> functions;
  const auto begins = [](const Instruction& i) { return i.op == spv::OpFunction; };
  const auto ends = [](const Instruction& i) { return i.op == spv::OpFunctionEnd; };
  for (auto at = std::ranges::find_if(instructions, begins); at != instructions.end();) {
    const auto end = std::find_if(at, instructions.end(), ends);
    if (end == instructions.end()) return {};
    functions.emplace_back(at, end);
    at = std::find_if(end, instructions.end(), begins);
  }
  return functions;
}

void append(std::vector<std::uint32_t>& to, std::uint32_t op, std::initializer_list<std::uint32_t> operands) {
  to.push_back((static_cast<std::uint32_t>(operands.size()) + 1) << spv::WordCountShift | op);
  to.insert(to.end(), operands);
}

void append(std::vector<std::uint32_t>& to, const Instruction& instruction) {
  to.insert(to.end(), instruction.words.begin(), instruction.words.end());
}

bool divide_into_blocks(std::span<const Instruction> function, FunctionBlocks& result) {
  const auto is_label = [](const Instruction& instruction) { return instruction.op == spv::OpLabel; };
  const auto begin = function.begin(), end = function.end();
  auto at = std::find_if(begin, end, is_label);
  result.head = {begin, at};
  while (at != end) {
    const auto next = std::find_if(at + 1, end, is_label);
    if (next == at + 1) return false;
    Block block{.label = at->words[1], .instructions = {at + 1, next}, .targets = {}};
    if (const auto before = block.instructions.size(); before > 1) {
      const Instruction& merge = block.instructions[before - 2];
      if (merge.op == spv::OpSelectionMerge || merge.op == spv::OpLoopMerge) block.merge = &merge;
    }
    result.block_of_label.emplace(block.label, static_cast<std::uint32_t>(result.blocks.size()));
    result.blocks.push_back(std::move(block));
    at = next;
  }
  if (result.blocks.empty()) return false;
  for (Block& block : result.blocks) {
    if (!find_targets(result, block)) return false;
    for (const Instruction& instruction : block.instructions)
      if (instruction.op == spv::OpPhi && !names_known_blocks(result, instruction)) return false;
  }
  sort_blocks(result);
  return true;
}

}  // namespace gloam::gpu::spirv
