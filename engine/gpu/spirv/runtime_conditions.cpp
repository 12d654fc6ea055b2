// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/runtime_conditions.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/gpu/spirv/control_flow.h"
#include "engine/gpu/spirv/value_sources.h"

namespace gloam::gpu::spirv {
namespace {

constexpr std::uint32_t kMostIds = 4194303;  // limit of the SPIR-V specification
constexpr std::uint32_t kMinusOneFloat = 0xbf800000u;

using Words = std::vector<std::uint32_t>;

/// A built-in input, and a comparison of its first component that always holds, which no compiler can know.
struct Input {
  spv::BuiltIn built_in;
  bool is_float;             ///< else a 32-bit integer
  bool is_signed;            ///< integers only
  std::uint32_t components;  ///< 1: a scalar
  spv::Op comparison;
  std::uint32_t bound;  ///< second operand of the comparison
};

std::optional<Input> input_of(std::uint32_t execution_model) {
  switch (execution_model) {
    case spv::ExecutionModelGLCompute:  // a dispatch without workgroups runs no invocation
      return Input{spv::BuiltInNumWorkgroups, false, false, 3, spv::OpINotEqual, 0};
    case spv::ExecutionModelFragment:
      return Input{spv::BuiltInFragCoord, true, false, 4, spv::OpFOrdGreaterThan, kMinusOneFloat};
    case spv::ExecutionModelVertex:
      return Input{spv::BuiltInVertexIndex, false, true, 1, spv::OpINotEqual, 0x80000000u};
    default:
      return std::nullopt;
  }
}

class Rewriter {
 public:
  explicit Rewriter(std::span<const std::uint32_t> words)
      : header_(words.first(kModuleHeaderWords)),
        instructions_(instructions_of(words.subspan(kModuleHeaderWords))),
        bound_(words[kBoundWord]) {}

  Words run() {
    if (instructions_.empty() || !find_entry() || !find_conditions()) return {};
    find_declarations();
    declare_input();
    Words out(header_.begin(), header_.end());
    for (std::size_t i = 0; i < instructions_.size(); ++i) emit(i, out);
    out[kBoundWord] = bound_;
    return out;
  }

 private:
  std::uint32_t new_id() { return bound_++; }

  bool find_entry() {
    for (const Instruction& instruction : instructions_)
      if (instruction.op == spv::OpEntryPoint) {
        if (entry_ != nullptr) return false;
        entry_ = &instruction;
      }
    const auto found = entry_ == nullptr ? std::nullopt : input_of(entry_->words[1]);
    if (!found) return false;
    input_ = *found;
    return true;
  }

  /// Marks the branches to change and the instruction before which each one's condition is changed.
  bool find_conditions() {
    const std::vector<ValueSource> sources = value_sources(instructions_, bound_);
    changes_.assign(instructions_.size(), nullptr);
    std::size_t function_start = 0;
    bool found = false;
    for (std::size_t i = 0; i < instructions_.size(); ++i) {
      const Instruction& instruction = instructions_[i];
      if (instruction.op == spv::OpFunction) function_start = i;
      if (instruction.op != spv::OpBranchConditional && instruction.op != spv::OpSwitch) continue;
      const std::uint32_t condition = instruction.words.size() > 1 ? instruction.words[1] : 0;
      if (condition >= sources.size() || sources[condition] != ValueSource::uniform) continue;
      const std::uint32_t before = i > 0 ? instructions_[i - 1].op : instruction.op;
      changes_[before == spv::OpSelectionMerge || before == spv::OpLoopMerge ? i - 1 : i] = &instruction;
      changed_functions_.push_back(function_start);
      found = true;
    }
    return found;
  }

  /// Finds the types and the input that the module has already: a type must not be declared twice.
  void find_declarations() {
    for (const Instruction& instruction : instructions_) {
      const auto w = instruction.words;
      const auto is = [&](spv::Op op, std::size_t size) { return instruction.op == op && w.size() >= size; };
      if (is(spv::OpTypeBool, 2)) bool_type_ = w[1];
      if (is(spv::OpTypeInt, 4) && !input_.is_float && w[2] == 32 && (w[3] != 0) == input_.is_signed)
        scalar_type_ = w[1];
      if (is(spv::OpTypeFloat, 3) && input_.is_float && w[2] == 32) scalar_type_ = w[1];
      if (is(spv::OpTypeVector, 4) && w[2] == scalar_type_ && w[3] == input_.components) vector_type_ = w[1];
      if (is(spv::OpTypePointer, 4) && w[2] == spv::StorageClassInput && w[3] == value_type()) pointer_type_ = w[1];
      if (is(spv::OpDecorate, 4) && w[2] == spv::DecorationBuiltIn && w[3] == input_.built_in) variable_ = w[1];
    }
    has_variable_ = decorated_ = variable_ != 0;
    if (has_variable_) use_types_of_input();
  }

  /// A module may declare the input with integers of the other signedness.
  void use_types_of_input() {
    std::uint32_t pointer = 0, value = 0;
    for (const Instruction& i : instructions_)
      if (i.op == spv::OpVariable && i.words.size() > 3 && i.words[2] == variable_) pointer = i.words[1];
    for (const Instruction& i : instructions_)
      if (i.op == spv::OpTypePointer && i.words.size() > 3 && i.words[1] == pointer) value = i.words[3];
    if (input_.components == 1) scalar_type_ = value;
    if (input_.components > 1) vector_type_ = value;
    for (const Instruction& i : instructions_)
      if (i.op == spv::OpTypeVector && i.words.size() > 3 && i.words[1] == value) scalar_type_ = i.words[2];
  }

  [[nodiscard]] std::uint32_t value_type() const { return input_.components == 1 ? scalar_type_ : vector_type_; }

  /// Writes the declarations that the module lacks.
  void declare_input() {
    if (bool_type_ == 0) append(declarations_, spv::OpTypeBool, {bool_type_ = new_id()});
    if (scalar_type_ == 0) {
      scalar_type_ = new_id();
      if (input_.is_float) append(declarations_, spv::OpTypeFloat, {scalar_type_, 32});
      if (!input_.is_float) append(declarations_, spv::OpTypeInt, {scalar_type_, 32, input_.is_signed ? 1u : 0u});
    }
    if (input_.components > 1 && vector_type_ == 0)
      append(declarations_, spv::OpTypeVector, {vector_type_ = new_id(), scalar_type_, input_.components});
    append(declarations_, spv::OpConstant, {scalar_type_, bound_constant_ = new_id(), input_.bound});
    if (has_variable_) return;
    if (pointer_type_ == 0)
      append(declarations_, spv::OpTypePointer, {pointer_type_ = new_id(), spv::StorageClassInput, value_type()});
    append(declarations_, spv::OpVariable, {pointer_type_, variable_ = new_id(), spv::StorageClassInput});
  }

  void emit(std::size_t index, Words& out) {
    const Instruction& instruction = instructions_[index];
    if (!decorated_ && instruction.op >= spv::OpTypeVoid && instruction.op <= spv::OpTypeForwardPointer) {
      append(out, spv::OpDecorate, {variable_, spv::DecorationBuiltIn, static_cast<std::uint32_t>(input_.built_in)});
      decorated_ = true;
    }
    if (instruction.op == spv::OpFunction) {
      out.insert(out.end(), declarations_.begin(), declarations_.end());
      declarations_.clear();
      reads_input_ = std::ranges::find(changed_functions_, index) != changed_functions_.end();
    }
    if (reads_input_ && in_entry_block_ && instruction.op != spv::OpVariable && instruction.op != spv::OpLine &&
        instruction.op != spv::OpNoLine) {
      read_input(out);
      reads_input_ = false;
    }
    in_entry_block_ = instruction.op == spv::OpLabel || (in_entry_block_ && reads_input_);
    if (changes_[index] != nullptr) change_condition(*changes_[index], out);
    const std::size_t start = out.size();
    out.insert(out.end(), instruction.words.begin(), instruction.words.end());
    if (&instruction == entry_ && !has_variable_) {
      out.push_back(variable_);
      out[start] += 1u << spv::WordCountShift;
    }
    if (instruction.op == spv::OpBranchConditional || instruction.op == spv::OpSwitch)
      if (const std::uint32_t condition = std::exchange(condition_, 0); condition != 0) out[start + 1] = condition;
  }

  /// At the start of a function: holds_ is true in every invocation.
  void read_input(Words& out) {
    std::uint32_t value = new_id();
    append(out, spv::OpLoad, {value_type(), value, variable_});
    if (input_.components > 1) {
      const std::uint32_t first = new_id();
      append(out, spv::OpCompositeExtract, {scalar_type_, first, value, 0});
      value = first;
    }
    append(out, input_.comparison, {bool_type_, holds_ = new_id(), value, bound_constant_});
  }

  void change_condition(const Instruction& branch, Words& out) {
    condition_ = new_id();
    if (branch.op == spv::OpBranchConditional)
      return append(out, spv::OpLogicalAnd, {bool_type_, condition_, branch.words[1], holds_});
    const std::uint32_t type = type_of(branch.words[1]), zero = new_id();
    append(out, spv::OpBitwiseXor, {type, zero, branch.words[1], branch.words[1]});
    append(out, spv::OpSelect, {type, condition_, holds_, branch.words[1], zero});
  }

  [[nodiscard]] std::uint32_t type_of(std::uint32_t id) const {
    for (const Instruction& instruction : instructions_) {
      bool typed = false, result = false;
      spv::HasResultAndType(static_cast<spv::Op>(instruction.op), &result, &typed);
      if (typed && instruction.words.size() > 2 && instruction.words[2] == id) return instruction.words[1];
    }
    return scalar_type_;
  }

  std::span<const std::uint32_t> header_;
  std::vector<Instruction> instructions_;
  std::uint32_t bound_ = 0;
  const Instruction* entry_ = nullptr;
  Input input_ = {};
  std::vector<const Instruction*> changes_;  ///< by instruction: the branch whose condition is changed before it
  std::vector<std::size_t> changed_functions_;
  std::uint32_t bool_type_ = 0, scalar_type_ = 0, vector_type_ = 0, pointer_type_ = 0, variable_ = 0;
  std::uint32_t bound_constant_ = 0;
  bool has_variable_ = false;
  Words declarations_;
  bool decorated_ = false;
  bool reads_input_ = false;     ///< the current function reads the input and has not done so yet
  bool in_entry_block_ = false;  ///< between a function's first label and the place where it reads the input
  std::uint32_t holds_ = 0;
  std::uint32_t condition_ = 0;  ///< takes the place of the next branch's condition
};

}  // namespace

Words hide_uniform_conditions(std::span<const std::uint32_t> words) {
  if (words.size() <= kModuleHeaderWords || words[kBoundWord] > kMostIds) return {};
  return Rewriter(words).run();
}

}  // namespace gloam::gpu::spirv
