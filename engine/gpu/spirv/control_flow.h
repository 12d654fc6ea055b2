// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <unordered_map>
#include <vector>

namespace gloam::gpu::spirv {

constexpr std::size_t kModuleHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;  ///< word of the header: ids are below its value

/// One instruction: its opcode and all its words, the first one included.
struct Instruction {
  std::uint32_t op = 0;
  std::span<const std::uint32_t> words;
};

/// The instructions of a module after its header. Empty if one runs past the end, or is too short for the operands that
/// this folder reads.
[[nodiscard]] std::vector<Instruction> instructions_of(std::span<const std::uint32_t> words);

/// What stands before a module's first function.
[[nodiscard]] std::span<const Instruction> globals_of(std::span<const Instruction> instructions);
/// A module's functions, each from OpFunction to the instruction before OpFunctionEnd. Empty if one does not end.
[[nodiscard]] std::vector<std::span<const Instruction>> functions_of(std::span<const Instruction> instructions);

/// Writes an instruction.
void append(std::vector<std::uint32_t>& to, std::uint32_t op, std::initializer_list<std::uint32_t> operands);
void append(std::vector<std::uint32_t>& to, const Instruction& instruction);

/// A basic block. Blocks are named by their index in the function.
struct Block {
  std::uint32_t label = 0;
  std::span<const Instruction> instructions;  ///< without the label; the last one is the terminator
  std::vector<std::uint32_t> targets;         ///< blocks that the terminator may branch to
  const Instruction* merge = nullptr;         ///< OpSelectionMerge or OpLoopMerge
};

/// The blocks of a function.
struct FunctionBlocks {
  std::span<const Instruction> head;  ///< OpFunction and its parameters
  std::vector<Block> blocks;          ///< in the module's order; the first is the entry
  std::unordered_map<std::uint32_t, std::uint32_t> block_of_label;
  /// Blocks that the entry reaches, in reverse postorder: each block after all blocks that branch to it, back edges
  /// excepted.
  std::vector<std::uint32_t> order;
};

/// Divides a function into blocks. function: from OpFunction to the instruction before OpFunctionEnd. Returns false if
/// it holds an OpSwitch or names an unknown block.
[[nodiscard]] bool divide_into_blocks(std::span<const Instruction> function, FunctionBlocks& result);

}  // namespace gloam::gpu::spirv
