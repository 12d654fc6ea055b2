// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Sparse conditional constant propagation (Wegman, Zadeck 1991), reduced to one pass in reverse postorder: control flow
// of shaders is structured, so all branches to a block but back edges are known when the pass comes to it. A value that
// a loop carries counts as unknown.
#include "engine/gpu/spirv/specialize.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "engine/gpu/spirv/control_flow.h"

namespace gloam::gpu::spirv {
namespace {

/// Whether an instruction has a type and a result, which are then its first two operands.
bool has_typed_result(std::uint32_t op) {
  bool result = false, type = false;
  spv::HasResultAndType(static_cast<spv::Op>(op), &result, &type);
  return result && type;
}

/// Values of scalars of booleans and 32-bit integers.
class Constants {
 public:
  void set(std::uint32_t id, std::uint32_t value) { values_.insert_or_assign(id, value); }
  [[nodiscard]] std::optional<std::uint32_t> of(std::uint32_t id) const {
    const auto found = values_.find(id);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }
  /// The result of an instruction with these operands; nullopt if it is not known.
  [[nodiscard]] std::optional<std::uint32_t> evaluate(std::uint32_t op, std::span<const std::uint32_t> operands) const;

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> values_;
};

std::optional<std::uint32_t> evaluate_pair(std::uint32_t op, std::uint32_t a, std::uint32_t b) {
  const auto s = static_cast<std::int32_t>(a), t = static_cast<std::int32_t>(b);
  switch (op) {
    case spv::OpIAdd:
      return a + b;
    case spv::OpISub:
      return a - b;
    case spv::OpIMul:
      return a * b;
    case spv::OpLogicalEqual:
    case spv::OpIEqual:
      return a == b;
    case spv::OpLogicalNotEqual:
    case spv::OpINotEqual:
      return a != b;
    case spv::OpLogicalOr:
    case spv::OpBitwiseOr:
      return a | b;
    case spv::OpLogicalAnd:
    case spv::OpBitwiseAnd:
      return a & b;
    case spv::OpBitwiseXor:
      return a ^ b;
    case spv::OpUGreaterThan:
      return a > b;
    case spv::OpSGreaterThan:
      return s > t;
    case spv::OpUGreaterThanEqual:
      return a >= b;
    case spv::OpSGreaterThanEqual:
      return s >= t;
    case spv::OpULessThan:
      return a < b;
    case spv::OpSLessThan:
      return s < t;
    case spv::OpULessThanEqual:
      return a <= b;
    case spv::OpSLessThanEqual:
      return s <= t;
    case spv::OpShiftRightLogical:
      return b < 32 ? std::optional(a >> b) : std::nullopt;
    case spv::OpShiftLeftLogical:
      return b < 32 ? std::optional(a << b) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<std::uint32_t> Constants::evaluate(std::uint32_t op, std::span<const std::uint32_t> operands) const {
  if (operands.empty()) return std::nullopt;
  const auto first = of(operands[0]);
  if (op == spv::OpCopyObject) return first;
  if (op == spv::OpLogicalNot && first) return *first ^ 1u;
  if (op == spv::OpNot && first) return ~*first;
  if (op == spv::OpSelect && operands.size() == 3 && first) return of(operands[*first != 0 ? 1 : 2]);
  if (operands.size() != 2) return std::nullopt;
  const auto second = of(operands[1]);
  if (first && second) return evaluate_pair(op, *first, *second);
  if (!first && !second) return std::nullopt;
  const std::uint32_t known = first ? *first : *second;
  if (op == spv::OpLogicalAnd && known == 0) return 0u;
  if (op == spv::OpLogicalOr && known == 1) return 1u;
  return std::nullopt;
}

/// Which part of a function can run.
struct LiveCode {
  FunctionBlocks function;
  std::vector<std::vector<std::uint32_t>> from;     ///< by block: live blocks that branch to it
  std::vector<bool> live;                           ///< by block
  std::vector<std::optional<std::uint32_t>> taken;  ///< by block: label that its conditional branch always takes
  std::vector<std::uint32_t> called;                ///< functions that live blocks call
  /// By block that is not live but must remain: 0, or the label of the loop header that it continues.
  std::unordered_map<std::uint32_t, std::uint32_t> stubs;
};

class Specializer {
 public:
  Specializer(std::span<const std::uint32_t> words, std::span<const NumberedConstant> given)
      : words_(words), given_(given), bound_(words[kBoundWord]) {}

  std::vector<std::uint32_t> run() {
    const std::vector<Instruction> all = instructions_of(words_.subspan(kModuleHeaderWords));
    if (all.empty()) return {};
    const std::vector<std::span<const Instruction>> functions = functions_of(all);
    const std::span<const Instruction> globals = globals_of(all);
    if (functions.empty() && globals.size() < all.size()) return {};
    if (!read_constants(globals)) return {};
    if (!find_live_functions(functions)) return {};
    for (const auto& function : functions) collect_removed(function);
    std::vector<std::uint32_t> bodies;
    for (const auto& function : functions)
      if (const auto found = live_.find(function.front().words[2]); found != live_.end()) write(found->second, bodies);
    out_.assign(words_.begin(), words_.begin() + kModuleHeaderWords);
    for (const Instruction& instruction : globals) write_global(instruction);
    for (const auto& [type, id] : undefined_) append(out_, spv::OpUndef, {type, id});
    out_.insert(out_.end(), bodies.begin(), bodies.end());
    out_[kBoundWord] = bound_;
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::uint32_t value_of(std::uint32_t id, std::uint32_t default_value) const {
    const auto spec = spec_ids_.find(id);
    if (spec == spec_ids_.end()) return default_value;
    const auto found = std::ranges::find(given_, spec->second, &NumberedConstant::id);
    return found == given_.end() ? default_value : found->value;
  }

  /// Reads the values of all constants. Returns false if none is a specialisation constant.
  bool read_constants(std::span<const Instruction> globals) {
    for (const Instruction& i : globals) {
      const auto& w = i.words;
      if (i.op == spv::OpEntryPoint) entries_.push_back(w[2]);
      if (i.op == spv::OpDecorate && w[2] == spv::DecorationSpecId && w.size() > 3) spec_ids_.emplace(w[1], w[3]);
      if (i.op == spv::OpTypeBool) bool_type_ = w[1];
      if (i.op == spv::OpTypeBool || (i.op == spv::OpTypeInt && w[2] == 32)) scalar_types_.push_back(w[1]);
      if (w.size() < 3 || std::ranges::find(scalar_types_, w[1]) == scalar_types_.end()) continue;
      if (i.op == spv::OpConstant) constants_.set(w[2], w[3]);
      if (i.op == spv::OpConstantTrue || i.op == spv::OpConstantFalse)
        constants_.set(w[2], i.op == spv::OpConstantTrue);
      if (i.op == spv::OpSpecConstant) constants_.set(w[2], value_of(w[2], w[3]));
      if (i.op == spv::OpSpecConstantTrue || i.op == spv::OpSpecConstantFalse)
        constants_.set(w[2], value_of(w[2], i.op == spv::OpSpecConstantTrue) != 0);
      if (i.op == spv::OpSpecConstantOp)
        if (const auto value = constants_.evaluate(w[3], w.subspan(4))) constants_.set(w[2], *value);
    }
    return !spec_ids_.empty();
  }

  bool find_live_functions(std::span<const std::span<const Instruction>> functions) {
    std::vector<std::uint32_t> waiting = entries_;
    while (!waiting.empty()) {
      const std::uint32_t id = waiting.back();
      waiting.pop_back();
      if (live_.contains(id)) continue;
      const auto found = std::ranges::find_if(functions, [&](const auto& f) { return f.front().words[2] == id; });
      if (found == functions.end()) return false;
      LiveCode& code = live_[id];
      if (!divide_into_blocks(*found, code.function)) return false;
      find_live_blocks(code);
      if (!find_stubs(code)) return false;
      waiting.insert(waiting.end(), code.called.begin(), code.called.end());
    }
    return true;
  }

  void find_live_blocks(LiveCode& code) {
    const std::size_t count = code.function.blocks.size();
    code.from.resize(count);
    code.live.resize(count, false);
    code.taken.resize(count);
    std::vector<bool> passed(count, false);
    code.live[0] = true;
    for (const std::uint32_t at : code.function.order) {
      const Block& block = code.function.blocks[at];
      passed[at] = true;
      if (!code.live[at]) continue;
      for (const Instruction& i : block.instructions) {
        if (i.op == spv::OpFunctionCall) code.called.push_back(i.words[3]);
        if (!has_typed_result(i.op) || i.words.size() < 4) continue;
        const auto value =
            i.op == spv::OpPhi ? joined_value(code, at, i, passed) : constants_.evaluate(i.op, i.words.subspan(3));
        if (value) constants_.set(i.words[2], *value);
      }
      const Instruction& last = block.instructions.back();
      if (last.op == spv::OpBranchConditional)
        if (const auto condition = constants_.of(last.words[1])) code.taken[at] = last.words[*condition != 0 ? 2 : 3];
      for (const std::uint32_t target : block.targets) {
        if (code.taken[at] && code.function.blocks[target].label != *code.taken[at]) continue;
        code.live[target] = true;
        code.from[target].push_back(at);
      }
    }
  }

  /// The value of an OpPhi if all live branches bring the same one and none is a back edge.
  std::optional<std::uint32_t> joined_value(const LiveCode& code, std::uint32_t at, const Instruction& phi,
                                            const std::vector<bool>& passed) const {
    std::optional<std::uint32_t> joined;
    for (std::size_t i = 3; i + 1 < phi.words.size(); i += 2) {
      const std::uint32_t from = code.function.block_of_label.at(phi.words[i + 1]);
      if (!passed[from] || from == at) return std::nullopt;
      if (std::ranges::find(code.from[at], from) == code.from[at].end()) continue;
      const auto value = constants_.of(phi.words[i]);
      if (!value || (joined && *joined != *value)) return std::nullopt;
      joined = value;
    }
    return joined;
  }

  /// Finds the merge blocks and continue targets that live code names but does not reach. Returns false if a loop would
  /// be left without its back edge.
  static bool find_stubs(LiveCode& code) {
    const auto& function = code.function;
    std::vector<std::size_t> rank(function.blocks.size(), 0);
    for (std::size_t i = 0; i < function.order.size(); ++i) rank[function.order[i]] = i;
    for (const std::uint32_t at : function.order) {
      const Block& block = function.blocks[at];
      if (!code.live[at] || block.merge == nullptr) continue;
      const bool loop = block.merge->op == spv::OpLoopMerge;
      if (!loop && code.taken[at]) continue;
      const auto merge = function.block_of_label.find(block.merge->words[1]);
      if (merge == function.block_of_label.end()) return false;
      if (!code.live[merge->second]) code.stubs.emplace(merge->second, 0);
      if (!loop) continue;
      const auto next = function.block_of_label.find(block.merge->words[2]);
      if (next == function.block_of_label.end()) return false;
      const bool continues = code.live[next->second];
      const bool repeats = std::ranges::any_of(code.from[at], [&](std::uint32_t f) { return rank[f] >= rank[at]; });
      if (continues != repeats) return false;
      if (!continues) code.stubs.emplace(next->second, block.label);
    }
    return true;
  }

  /// Collects the results of the code that is left out.
  void collect_removed(std::span<const Instruction> function) {
    const auto found = live_.find(function.front().words[2]);
    const auto remove = [&](std::span<const Instruction> instructions) {
      for (const Instruction& i : instructions)
        if (i.op == spv::OpLabel) {
          removed_.emplace(i.words[1], true);
        } else if (has_typed_result(i.op) && i.words.size() > 2) {
          removed_.emplace(i.words[2], true);
        }
    };
    if (found == live_.end()) return remove(function);
    const LiveCode& code = found->second;
    for (std::uint32_t at = 0; at < code.function.blocks.size(); ++at) {
      if (code.live[at]) continue;
      remove(code.function.blocks[at].instructions);
      if (!code.stubs.contains(at)) removed_.emplace(code.function.blocks[at].label, true);
    }
  }

  /// The written instruction that defines a constant; empty if no constant has this id.
  [[nodiscard]] std::span<const std::uint32_t> definition_of(std::uint32_t id) const {
    const auto found = places_.find(id);
    if (found == places_.end()) return {};
    const auto words = std::span(out_).subspan(found->second);
    return words.first(words[0] >> spv::WordCountShift);
  }

  /// Ids of the components of a vector constant; empty if the constant is not an OpConstantComposite.
  [[nodiscard]] std::span<const std::uint32_t> components_of(std::uint32_t id) const {
    const auto words = definition_of(id);
    if (words.empty() || (words[0] & spv::OpCodeMask) != spv::OpConstantComposite) return {};
    return words.subspan(3);
  }

  /// The constant in place of an OpSpecConstantOp with OpSelect, `w`, whose operands are not all scalars of Constants;
  /// empty if its condition is not known, or components of something other than an OpConstantComposite are chosen.
  [[nodiscard]] std::vector<std::uint32_t> chosen_constant(std::span<const std::uint32_t> w) const {
    if (w.size() != 7 || w[3] != spv::OpSelect) return {};
    const auto conditions = constants_.of(w[4]) ? w.subspan(4, 1) : components_of(w[4]);
    std::vector<std::uint32_t> sources;  // the chosen operands: one a component, or one for all
    for (const std::uint32_t condition : conditions) {
      const auto value = constants_.of(condition);
      if (!value) return {};
      sources.push_back(w[*value != 0 ? 5 : 6]);
    }
    if (sources.empty()) return {};
    if (std::ranges::count(sources, sources[0]) == std::ssize(sources)) {
      const auto words = definition_of(sources[0]);
      std::vector<std::uint32_t> copy(words.begin(), words.end());
      if (!copy.empty()) copy[2] = w[2];
      return copy;
    }
    std::vector<std::uint32_t> mixed = {
        (static_cast<std::uint32_t>(sources.size()) + 3) << spv::WordCountShift | spv::OpConstantComposite, w[1], w[2]};
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto components = components_of(sources[i]);
      if (components.size() != sources.size()) return {};
      mixed.push_back(components[i]);
    }
    return mixed;
  }

  void write_global(const Instruction& i) {
    const std::size_t place = out_.size();
    write_specialized(i);
    if (i.op >= spv::OpConstantTrue && i.op <= spv::OpSpecConstantOp && i.words.size() > 2) places_[i.words[2]] = place;
  }

  void write_specialized(const Instruction& i) {
    const auto& w = i.words;
    if (i.op == spv::OpDecorate && w[2] == spv::DecorationSpecId) return;
    if ((i.op == spv::OpName || i.op == spv::OpDecorate) && removed_.contains(w[1])) return;
    const bool spec = i.op >= spv::OpSpecConstantTrue && i.op <= spv::OpSpecConstantOp;
    if (!spec) return append(out_, i);
    if (i.op == spv::OpSpecConstantComposite) {
      append(out_, i);
      out_[out_.size() - w.size()] =
          static_cast<std::uint32_t>(w.size()) << spv::WordCountShift | spv::OpConstantComposite;
      return;
    }
    if (const auto value = constants_.of(w[2])) {
      if (w[1] == bool_type_)
        return append(out_, *value != 0 ? spv::OpConstantTrue : spv::OpConstantFalse, {w[1], w[2]});
      return append(out_, spv::OpConstant, {w[1], w[2], *value});
    }
    if (i.op == spv::OpSpecConstantOp) {
      const auto chosen = chosen_constant(w);
      if (!chosen.empty()) return static_cast<void>(out_.insert(out_.end(), chosen.begin(), chosen.end()));
    }
    append(out_, i);
    // Not a boolean or 32-bit integer: the given value replaces the first word.
    if (i.op != spv::OpSpecConstant) return;
    const std::size_t at = out_.size() - w.size();
    out_[at] = static_cast<std::uint32_t>(w.size()) << spv::WordCountShift | spv::OpConstant;
    out_[at + 3] = value_of(w[2], w[3]);
  }

  void write(const LiveCode& code, std::vector<std::uint32_t>& to) {
    for (const Instruction& i : code.function.head) append(to, i);
    for (std::uint32_t at = 0; at < code.function.blocks.size(); ++at) {
      const Block& block = code.function.blocks[at];
      if (code.live[at]) {
        append(to, spv::OpLabel, {block.label});
        write_block(code, at, to);
      } else if (const auto stub = code.stubs.find(at); stub != code.stubs.end()) {
        append(to, spv::OpLabel, {block.label});
        if (stub->second != 0) {
          append(to, spv::OpBranch, {stub->second});
        } else {
          append(to, spv::OpUnreachable, {});
        }
      }
    }
    append(to, spv::OpFunctionEnd, {});
  }

  void write_block(const LiveCode& code, std::uint32_t at, std::vector<std::uint32_t>& to) {
    const Block& block = code.function.blocks[at];
    for (const Instruction& i : block.instructions) {
      if (i.op == spv::OpPhi) {
        write_phi(code, at, i, to);
      } else if (code.taken[at] && &i == &block.instructions.back()) {
        append(to, spv::OpBranch, {*code.taken[at]});
      } else if (!(code.taken[at] && i.op == spv::OpSelectionMerge)) {
        append(to, i);
      }
    }
  }

  void write_phi(const LiveCode& code, std::uint32_t at, const Instruction& phi, std::vector<std::uint32_t>& to) {
    const std::size_t start = to.size();
    to.insert(to.end(), phi.words.begin(), phi.words.begin() + 3);
    const auto& from = code.from[at];
    for (std::size_t i = 3; i + 1 < phi.words.size(); i += 2)
      if (std::ranges::find(from, code.function.block_of_label.at(phi.words[i + 1])) != from.end())
        to.insert(to.end(), {phi.words[i], phi.words[i + 1]});
    for (const auto& [stub, header] : code.stubs)
      if (header == code.function.blocks[at].label)
        to.insert(to.end(), {undefined(phi.words[1]), code.function.blocks[stub].label});
    to[start] = static_cast<std::uint32_t>(to.size() - start) << spv::WordCountShift | spv::OpPhi;
  }

  std::uint32_t undefined(std::uint32_t type) {
    const auto [place, fresh] = undefined_.try_emplace(type, bound_);
    if (fresh) ++bound_;
    return place->second;
  }

  std::span<const std::uint32_t> words_;
  std::span<const NumberedConstant> given_;
  std::uint32_t bound_;
  std::vector<std::uint32_t> entries_;
  std::uint32_t bool_type_ = 0;
  std::vector<std::uint32_t> scalar_types_;  ///< booleans and 32-bit integers
  std::unordered_map<std::uint32_t, std::uint32_t> spec_ids_;
  Constants constants_;
  std::unordered_map<std::uint32_t, LiveCode> live_;  ///< by function
  std::unordered_map<std::uint32_t, bool> removed_;
  std::unordered_map<std::uint32_t, std::size_t> places_;       ///< by constant: index of its instruction in out_
  std::unordered_map<std::uint32_t, std::uint32_t> undefined_;  ///< by type: id of an OpUndef
  std::vector<std::uint32_t> out_;
};

}  // namespace

std::vector<std::uint32_t> specialize(std::span<const std::uint32_t> words,
                                      std::span<const NumberedConstant> constants) {
  if (words.size() <= kModuleHeaderWords) return {};
  return Specializer(words, constants).run();
}

}  // namespace gloam::gpu::spirv
