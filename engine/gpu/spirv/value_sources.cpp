// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Data flow to a fixed point: each id begins as `constant`, and each pass over the instructions may only raise ids. A
// pointer's source is that of what it points to.
#include "engine/gpu/spirv/value_sources.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace gloam::gpu::spirv {
namespace {

bool is_constant(std::uint32_t op) { return op >= spv::OpConstantTrue && op <= spv::OpSpecConstantOp; }

/// Results that differ between invocations or dispatches even if all operands are constant.
bool is_runtime(std::uint32_t op) {
  return (op >= spv::OpSampledImage && op <= spv::OpImageQuerySamples) ||
         (op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor) ||
         (op >= spv::OpGroupNonUniformElect && op <= spv::OpGroupNonUniformQuadSwap) || op == spv::OpArrayLength ||
         op == spv::OpImageTexelPointer || op == spv::OpImage;
}

/// Operands of an arithmetic or logical instruction that are ids; the rest are literals.
std::span<const std::uint32_t> value_operands(const Instruction& instruction) {
  constexpr std::size_t kResult = 3;  // opcode, type, result
  const auto words = instruction.words;
  if (words.size() <= kResult) return {};
  switch (instruction.op) {
    case spv::OpCompositeExtract:
      return words.subspan(kResult, 1);
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
      return words.subspan(kResult, std::min<std::size_t>(2, words.size() - kResult));
    case spv::OpExtInst:
      return words.subspan(std::min<std::size_t>(kResult + 2, words.size()));
    default:
      return words.subspan(kResult);
  }
}

ValueSource source_of_storage(std::uint32_t storage_class) {
  switch (storage_class) {
    case spv::StorageClassUniform:
    case spv::StorageClassPushConstant:
      return ValueSource::uniform;
    case spv::StorageClassFunction:
    case spv::StorageClassPrivate:
      return ValueSource::constant;  // raised by stores
    default:
      return ValueSource::runtime;
  }
}

class Flow {
 public:
  Flow(std::span<const Instruction> instructions, std::uint32_t bound)
      : instructions_(instructions), sources_(bound, ValueSource::constant), definitions_(bound), stores_(bound, 0) {
    read_structure();
  }

  std::vector<ValueSource> run() {
    do {
      changed_ = false;
      for (const Instruction& instruction : instructions_) visit(instruction);
    } while (changed_);
    return std::move(sources_);
  }

 private:
  struct Function {
    std::vector<std::uint32_t> parameters;
    std::vector<std::uint32_t> results;  ///< values that it returns
  };

  void read_structure() {
    std::uint32_t function = 0, label = 0;
    for (const Instruction& instruction : instructions_) {
      const auto words = instruction.words;
      bool typed = false, result = false;
      spv::HasResultAndType(static_cast<spv::Op>(instruction.op), &result, &typed);
      const std::size_t at = typed ? 2 : 1;
      if (result && words.size() > at && words[at] < definitions_.size()) definitions_[words[at]] = &instruction;
      if (instruction.op == spv::OpFunction && words.size() > 2) function = words[2];
      if (instruction.op == spv::OpLabel && words.size() > 1) label = words[1];
      if (instruction.op == spv::OpFunctionParameter && words.size() > 2)
        functions_[function].parameters.push_back(words[2]);
      if (instruction.op == spv::OpReturnValue && words.size() > 1) functions_[function].results.push_back(words[1]);
      if (instruction.op == spv::OpLoopMerge) loop_headers_.push_back(label);
      if (instruction.op == spv::OpPhi && words.size() > 2) blocks_of_phis_[words[2]] = label;
      if (instruction.op == spv::OpStore && words.size() > 2 && words[1] < stores_.size()) ++stores_[words[1]];
    }
    for (const Instruction& store : instructions_)
      if (store.op == spv::OpStore && store.words.size() > 2 && counts_up(store.words[1], store.words[2]))
        counters_.insert(store.words[1]);
  }

  [[nodiscard]] const Instruction* definition_of(std::uint32_t id) const {
    return id < definitions_.size() ? definitions_[id] : nullptr;
  }
  [[nodiscard]] ValueSource of(std::uint32_t id) const {
    return id < sources_.size() ? sources_[id] : ValueSource::constant;
  }
  void raise(std::uint32_t id, ValueSource source) {
    if (id >= sources_.size() || sources_[id] >= source) return;
    sources_[id] = source;
    changed_ = true;
  }

  /// The variable or parameter that a pointer points into.
  [[nodiscard]] std::uint32_t root_of(std::uint32_t pointer) const {
    constexpr int kMostSteps = 64;  // a damaged module may have circles
    for (int step = 0; step < kMostSteps; ++step) {
      const Instruction* made = definition_of(pointer);
      if (made == nullptr) break;
      const bool passes = made->op == spv::OpAccessChain || made->op == spv::OpInBoundsAccessChain ||
                          made->op == spv::OpCopyObject || made->op == spv::OpPtrAccessChain;
      if (!passes || made->words.size() < 4) break;
      pointer = made->words[3];
    }
    return pointer;
  }

  void visit(const Instruction& instruction) {
    const auto words = instruction.words;
    if (instruction.op == spv::OpStore && words.size() > 2) return visit_store(words[1], words[2]);
    if (instruction.op == spv::OpCopyMemory && words.size() > 2) return raise(root_of(words[1]), of(words[2]));
    bool typed = false, result = false;
    spv::HasResultAndType(static_cast<spv::Op>(instruction.op), &result, &typed);
    if (!result || !typed || words.size() < 3 || is_constant(instruction.op)) return;
    switch (instruction.op) {
      case spv::OpVariable:
        return raise(words[2], source_of_storage(words.size() > 3 ? words[3] : 0));
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
        return visit_access(words);
      case spv::OpLoad:
        return raise(words[2], words.size() > 3 ? of(words[3]) : ValueSource::runtime);
      case spv::OpPhi:
        return visit_phi(words);
      case spv::OpFunctionCall:
        return visit_call(words);
      case spv::OpFunction:
      case spv::OpFunctionParameter:
        return;
      default:
        break;
    }
    if (is_runtime(instruction.op)) return raise(words[2], ValueSource::runtime);
    for (const std::uint32_t operand : value_operands(instruction)) raise(words[2], of(operand));
  }

  void visit_store(std::uint32_t pointer, std::uint32_t value) {
    const std::uint32_t root = root_of(pointer);
    raise(root, of(value));
    raise(pointer, of(value));
    // Branches may choose which of several stores a load sees, unless they are the start and the step of a counter.
    if (root < stores_.size() && stores_[root] > 1 && !counters_.contains(root)) raise(root, ValueSource::uniform);
  }

  /// Whether this store gives a local variable its own value with a step added.
  [[nodiscard]] bool counts_up(std::uint32_t variable, std::uint32_t value) const {
    const Instruction* step = definition_of(value);
    if (step == nullptr || (step->op != spv::OpIAdd && step->op != spv::OpISub) || step->words.size() < 5) return false;
    const Instruction* load = definition_of(step->words[3]);
    return load != nullptr && load->op == spv::OpLoad && load->words.size() > 3 && load->words[3] == variable;
  }

  /// An element at an offset that is not constant is no uniform that a driver could read beforehand.
  void visit_access(std::span<const std::uint32_t> words) {
    if (words.size() < 4) return;
    raise(words[2], of(root_of(words[3])));
    for (const std::uint32_t index : words.subspan(4))
      if (of(index) != ValueSource::constant && of(words[2]) == ValueSource::uniform)
        raise(words[2], of(index) == ValueSource::runtime ? ValueSource::runtime : ValueSource::uniform);
  }

  void visit_phi(std::span<const std::uint32_t> words) {
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) raise(words[2], of(words[i]));
    const auto block = blocks_of_phis_.find(words[2]);
    const bool in_loop_header =
        block != blocks_of_phis_.end() && std::ranges::find(loop_headers_, block->second) != loop_headers_.end();
    if (!in_loop_header) raise(words[2], ValueSource::uniform);
  }

  void visit_call(std::span<const std::uint32_t> words) {
    if (words.size() < 4) return;
    const auto found = functions_.find(words[3]);
    if (found == functions_.end()) return;
    const Function& function = found->second;
    for (std::size_t i = 0; i < function.parameters.size() && 4 + i < words.size(); ++i) {
      const std::uint32_t argument = words[4 + i], parameter = function.parameters[i];
      raise(parameter, of(argument));
      if (parameter < stores_.size() && stores_[parameter] > 0) raise(root_of(argument), of(parameter));
    }
    for (const std::uint32_t value : function.results) raise(words[2], of(value));
    // Branches choose among several results.
    if (function.results.size() > 1) raise(words[2], ValueSource::uniform);
  }

  std::span<const Instruction> instructions_;
  std::vector<ValueSource> sources_;
  std::vector<const Instruction*> definitions_;  ///< by id
  std::vector<std::uint32_t> stores_;            ///< by id of a pointer: stores through it
  std::unordered_set<std::uint32_t> counters_;   ///< local variables that a store steps on
  std::unordered_map<std::uint32_t, Function> functions_;
  std::vector<std::uint32_t> loop_headers_;  ///< labels
  std::unordered_map<std::uint32_t, std::uint32_t> blocks_of_phis_;
  bool changed_ = false;
};

}  // namespace

std::vector<ValueSource> value_sources(std::span<const Instruction> instructions, std::uint32_t bound) {
  return Flow(instructions, bound).run();
}

}  // namespace gloam::gpu::spirv
