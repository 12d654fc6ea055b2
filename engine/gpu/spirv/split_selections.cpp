// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/split_selections.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "engine/gpu/spirv/control_flow.h"

namespace gloam::gpu::spirv {
namespace {

/// Whether a block begins an if that has an else.
bool has_else(const FunctionBlocks& function, const Block& block) {
  if (block.merge == nullptr || block.merge->op != spv::OpSelectionMerge || block.targets.size() != 2) return false;
  const std::uint32_t merge = block.merge->words[1];
  return std::ranges::none_of(block.targets,
                              [&](std::uint32_t target) { return function.blocks[target].label == merge; });
}

/// An if with an else.
struct Selection {
  std::uint32_t header = 0;
  std::uint32_t merge = 0;
  std::uint32_t first_end = 0;  ///< block that ends the arm of the true condition
  std::uint32_t between = 0;    ///< label of the block between both ifs
};

class SelectionSplitter {
 public:
  explicit SelectionSplitter(std::span<const std::uint32_t> words)
      : words_(words), all_(instructions_of(words.subspan(kModuleHeaderWords))), bound_(words[kBoundWord]) {}

  std::vector<std::uint32_t> run() {
    const auto functions = functions_of(all_);
    if (functions.empty()) return {};
    const std::span<const Instruction> globals = globals_of(all_);
    const auto boolean = std::ranges::find(globals, std::uint32_t{spv::OpTypeBool}, &Instruction::op);
    if (boolean == globals.end()) return {};
    bool_type_ = boolean->words[1];
    for (const auto& instructions : functions) {
      FunctionBlocks function;
      if (!divide_into_blocks(instructions, function)) return {};
      write(function);
    }
    if (!any_) return {};
    std::vector<std::uint32_t> out(words_.begin(), words_.begin() + kModuleHeaderWords);
    out[kBoundWord] = bound_;
    for (const Instruction& i : globals) append(out, i);
    for (const auto& [type, id] : nulls_) append(out, spv::OpConstantNull, {type, id});
    out.insert(out.end(), bodies_.begin(), bodies_.end());
    return out;
  }

 private:
  /// The ifs with an else whose arms both come to the merge block.
  void find_selections(const FunctionBlocks& function) {
    headers_.clear();
    merges_.clear();
    std::vector<std::vector<std::uint32_t>> from(function.blocks.size());
    for (const std::uint32_t at : function.order)
      for (const std::uint32_t target : function.blocks[at].targets) from[target].push_back(at);
    for (const std::uint32_t at : function.order) {
      const Block& block = function.blocks[at];
      if (!has_else(function, block)) continue;
      const auto merge = function.block_of_label.find(block.merge->words[1]);
      if (merge == function.block_of_label.end() || from[merge->second].size() != 2) continue;
      const std::uint32_t first = function.block_of_label.at(block.instructions.back().words[2]);
      const std::uint32_t second = function.block_of_label.at(block.instructions.back().words[3]);
      if (function.blocks[second].instructions.front().op == spv::OpPhi) continue;
      const auto& ends = from[merge->second];
      const std::vector<bool> arm = reached(function, first, merge->second);
      if (arm[ends[0]] == arm[ends[1]]) continue;
      headers_[at] = {at, merge->second, arm[ends[0]] ? ends[0] : ends[1], bound_++};
      merges_[merge->second] = headers_[at];
    }
  }

  /// By block: whether a path leads to it from `from` that does not pass through `merge`.
  static std::vector<bool> reached(const FunctionBlocks& function, std::uint32_t from, std::uint32_t merge) {
    std::vector<bool> seen(function.blocks.size(), false);
    std::vector<std::uint32_t> waiting{from};
    seen[from] = seen[merge] = true;
    while (!waiting.empty()) {
      const std::uint32_t at = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t target : function.blocks[at].targets)
        if (!seen[target]) {
          seen[target] = true;
          waiting.push_back(target);
        }
    }
    return seen;
  }

  void write(const FunctionBlocks& function) {
    find_selections(function);
    any_ = any_ || !headers_.empty();
    for (const Instruction& i : function.head) append(bodies_, i);
    for (std::uint32_t at = 0; at < function.blocks.size(); ++at) {
      append(bodies_, spv::OpLabel, {function.blocks[at].label});
      write_block(function, at);
      if (const auto split = headers_.find(at); split != headers_.end()) write_between(function, split->second);
    }
    append(bodies_, spv::OpFunctionEnd, {});
  }

  void write_block(const FunctionBlocks& function, std::uint32_t at) {
    const auto header = headers_.find(at);
    const auto merged = merges_.find(at);
    for (const Instruction& i : function.blocks[at].instructions) {
      const std::size_t start = bodies_.size();
      append(bodies_, i);
      if (i.op == spv::OpPhi && merged != merges_.end()) {
        const std::uint32_t end = function.blocks[merged->second.first_end].label;
        for (std::size_t w = 3; w + 1 < i.words.size(); w += 2)
          if (i.words[w + 1] == end) {
            bodies_[start + w] = joined(i.words[2]);
            bodies_[start + w + 1] = merged->second.between;
          }
      }
      if (header != headers_.end() && i.op == spv::OpSelectionMerge) bodies_[start + 1] = header->second.between;
      if (header != headers_.end() && i.op == spv::OpBranchConditional) bodies_[start + 3] = header->second.between;
      // The arm of the true condition ends at the block between both ifs.
      if (i.op == spv::OpBranch || i.op == spv::OpBranchConditional) leave_first_arm(function, at, start);
    }
  }

  void leave_first_arm(const FunctionBlocks& function, std::uint32_t at, std::size_t start) {
    for (const std::uint32_t target : function.blocks[at].targets) {
      const auto merged = merges_.find(target);
      if (merged == merges_.end() || merged->second.first_end != at) continue;
      for (std::size_t w = start + 1; w < bodies_.size(); ++w)
        if (bodies_[w] == function.blocks[target].label) bodies_[w] = merged->second.between;
    }
  }

  /// The value that a phi of the merge block gets from the block between both ifs.
  std::uint32_t joined(std::uint32_t phi) {
    const auto [place, fresh] = joined_.try_emplace(phi, bound_);
    if (fresh) ++bound_;
    return place->second;
  }

  std::uint32_t null_of(std::uint32_t type) {
    const auto [place, fresh] = nulls_.try_emplace(type, bound_);
    if (fresh) ++bound_;
    return place->second;
  }

  void write_between(const FunctionBlocks& function, const Selection& selection) {
    const Block& header = function.blocks[selection.header];
    const std::uint32_t end = function.blocks[selection.first_end].label;
    append(bodies_, spv::OpLabel, {selection.between});
    for (const Instruction& i : function.blocks[selection.merge].instructions) {
      if (i.op != spv::OpPhi) continue;
      for (std::size_t w = 3; w + 1 < i.words.size(); w += 2)
        if (i.words[w + 1] == end)
          append(bodies_, spv::OpPhi,
                 {i.words[1], joined(i.words[2]), i.words[w], end, null_of(i.words[1]), header.label});
    }
    const std::uint32_t opposite = bound_++;
    const Instruction& branch = header.instructions.back();
    append(bodies_, spv::OpLogicalNot, {bool_type_, opposite, branch.words[1]});
    append(bodies_, spv::OpSelectionMerge, {function.blocks[selection.merge].label, header.merge->words[2]});
    append(bodies_, spv::OpBranchConditional, {opposite, branch.words[3], function.blocks[selection.merge].label});
  }

  std::span<const std::uint32_t> words_;
  std::vector<Instruction> all_;
  std::uint32_t bound_;
  std::uint32_t bool_type_ = 0;
  bool any_ = false;
  std::unordered_map<std::uint32_t, Selection> headers_;     ///< of the current function, by header
  std::unordered_map<std::uint32_t, Selection> merges_;      ///< of the current function, by merge block
  std::unordered_map<std::uint32_t, std::uint32_t> joined_;  ///< by phi
  std::map<std::uint32_t, std::uint32_t> nulls_;             ///< by type
  std::vector<std::uint32_t> bodies_;
};

}  // namespace

std::uint64_t count_selections(std::span<const std::uint32_t> words) {
  if (words.size() <= kModuleHeaderWords) return 0;
  const std::vector<Instruction> all = instructions_of(words.subspan(kModuleHeaderWords));
  struct Function {
    std::uint64_t own = 0;
    std::vector<std::uint32_t> calls;
  };
  std::unordered_map<std::uint32_t, Function> functions;
  for (const auto& instructions : functions_of(all)) {
    FunctionBlocks blocks;
    if (!divide_into_blocks(instructions, blocks)) return 0;
    Function& function = functions[instructions.front().words[2]];
    for (const Block& block : blocks.blocks) {
      if (has_else(blocks, block)) ++function.own;
      for (const Instruction& i : block.instructions)
        if (i.op == spv::OpFunctionCall) function.calls.push_back(i.words[3]);
    }
  }
  const auto entry = std::ranges::find(all, std::uint32_t{spv::OpEntryPoint}, &Instruction::op);
  if (entry == all.end()) return 0;
  constexpr std::uint64_t kEnough = 1u << 16;
  std::uint64_t count = 0;
  std::vector<std::uint32_t> waiting{entry->words[2]};
  for (std::size_t steps = 0; !waiting.empty() && steps < kEnough; ++steps) {
    const Function& function = functions[waiting.back()];
    waiting.pop_back();
    count += function.own;
    waiting.insert(waiting.end(), function.calls.begin(), function.calls.end());
  }
  return count;
}

std::vector<std::uint32_t> split_selections(std::span<const std::uint32_t> words) {
  if (words.size() <= kModuleHeaderWords) return {};
  return SelectionSplitter(words).run();
}

}  // namespace gloam::gpu::spirv
