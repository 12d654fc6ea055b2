// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/module.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace gloam::gpu::spirv {
namespace {

constexpr std::uint32_t kHeaderWords = 5;
constexpr std::uint32_t kMaxBound = 1u << 22;  // the specification's universal limit for the id bound

constexpr std::uint32_t kPointerBytes = 8;  // size of a buffer reference

/// The words of an instruction after its first word (word count and opcode).
using Operands = std::span<const std::uint32_t>;

std::string literal_text(Operands words) {
  std::string text;
  for (std::uint32_t word : words) {
    for (int byte = 0; byte < 4; ++byte) {
      const char c = static_cast<char>((word >> (8 * byte)) & 0xff);
      if (c == '\0') return text;
      text += c;
    }
  }
  return text;
}

std::uint32_t clamp_bytes(std::uint64_t bytes) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(bytes, std::numeric_limits<std::uint32_t>::max()));
}

class Parser {
 public:
  explicit Parser(std::span<const std::uint32_t> words) : words_(words) {}

  Result<Module> run() {
    if (words_.size() < kHeaderWords) return fault("it is shorter than the header of a module");
    if (words_[0] != spv::MagicNumber) return fault("it does not begin with the magic number of SPIR-V");
    const std::uint32_t bound = words_[3];
    if (bound == 0 || bound > kMaxBound) return fault("its bound of ids is out of range");
    module_.ids.resize(bound);
    module_.used.resize(bound, false);
    for (std::size_t at = kHeaderWords; at < words_.size();) {
      const std::uint32_t op = words_[at] & spv::OpCodeMask;
      const std::size_t count = words_[at] >> spv::WordCountShift;
      if (count == 0 || count > words_.size() - at) return fault("an instruction runs past the end");
      if (!instruction(op, words_.subspan(at + 1, count - 1))) {
        return fault("the instruction at word " + std::to_string(at) + " is broken");
      }
      at += count;
    }
    resolve_local_size();
    return std::move(module_);
  }

 private:
  static Error fault(std::string clause) { return {ErrorKind::input, std::move(clause)}; }

  [[nodiscard]] bool known(std::uint32_t id) const { return id != 0 && id < module_.ids.size(); }
  [[nodiscard]] bool is_type(std::uint32_t id) const {
    return known(id) && module_.ids[id].type.kind != TypeKind::none;
  }

  bool instruction(std::uint32_t op, Operands o) {
    if (op >= spv::OpTypeBool && op <= spv::OpTypePointer) return type_instruction(op, o);
    switch (op) {
      case spv::OpName:
        return name(o);
      case spv::OpMemberName:
        return member_name(o);
      case spv::OpEntryPoint:
        return entry_point(o);
      case spv::OpExecutionMode:
      case spv::OpExecutionModeId:
        return execution_mode(o);
      case spv::OpDecorate:
        return decorate(o);
      case spv::OpMemberDecorate:
        return member_decorate(o);
      case spv::OpConstant:
        return constant(o);
      case spv::OpSpecConstant:
        return constant(o) && spec_constant(o, false);
      case spv::OpSpecConstantTrue:
      case spv::OpSpecConstantFalse:
        return spec_constant(o, true);
      case spv::OpConstantComposite:
      case spv::OpSpecConstantComposite:
        return constant_composite(o);
      case spv::OpVariable:
        return variable(o);
      default:
        return use(op, o);
    }
  }

  bool name(Operands o) {
    if (o.size() < 2 || !known(o[0])) return false;
    Id& id = module_.ids[o[0]];
    std::string text = literal_text(o.subspan(1));
    if (id.name.empty()) {
      id.name = std::move(text);
    } else if (!text.empty()) {
      id.other_names.push_back(std::move(text));
    }
    return true;
  }

  bool member_name(Operands o) {
    if (o.size() < 3 || !known(o[0])) return false;
    module_.ids[o[0]].members[o[1]].name = literal_text(o.subspan(2));
    return true;
  }

  bool entry_point(Operands o) {
    if (o.size() < 3) return false;
    if (literal_text(o.subspan(2)) != "main" || module_.has_entry) return true;
    module_.has_entry = true;
    module_.execution_model = o[0];
    return true;
  }

  bool execution_mode(Operands o) {
    if (o.size() < 2) return false;
    if (o[1] != spv::ExecutionModeLocalSize && o[1] != spv::ExecutionModeLocalSizeId) return true;
    if (o.size() < 5) return false;
    local_size_are_ids_ = o[1] == spv::ExecutionModeLocalSizeId;
    std::copy_n(o.begin() + 2, 3, module_.local_size.begin());
    return true;
  }

  bool decorate(Operands o) {
    if (o.size() < 2 || !known(o[0])) return false;
    const auto id = [&]() -> Id& { return module_.ids[o[0]]; };  // other decorations make no properties
    const bool has_value = o.size() >= 3;
    switch (o[1]) {
      case spv::DecorationBlock:
        id().block = true;
        return true;
      case spv::DecorationBufferBlock:
        id().buffer_block = true;
        return true;
      case spv::DecorationArrayStride:
        if (has_value) id().array_stride = o[2];
        return has_value;
      case spv::DecorationBuiltIn:
        if (has_value) id().is_workgroup_size = o[2] == spv::BuiltInWorkgroupSize;
        return has_value;
      case spv::DecorationSpecId:
        id().has_spec_id = has_value;
        if (has_value) id().spec_id = o[2];
        return has_value;
      case spv::DecorationNonWritable:
        id().non_writable = true;
        return true;
      case spv::DecorationBinding:
        id().has_binding = has_value;
        if (has_value) id().binding = o[2];
        return has_value;
      case spv::DecorationDescriptorSet:
        id().has_set = has_value;
        if (has_value) id().set = o[2];
        return has_value;
      default:
        return true;
    }
  }

  bool member_decorate(Operands o) {
    if (o.size() < 3 || !known(o[0])) return false;
    if (o[2] == spv::DecorationNonWritable) module_.ids[o[0]].members[o[1]].non_writable = true;
    if (o[2] != spv::DecorationOffset && o[2] != spv::DecorationMatrixStride) return true;
    if (o.size() < 4) return false;
    MemberDecorations& member = module_.ids[o[0]].members[o[1]];
    if (o[2] == spv::DecorationOffset) {
      member.offset = o[3];
      member.has_offset = true;
    } else {
      member.matrix_stride = o[3];
    }
    return true;
  }

  bool constant(Operands o) {
    if (o.size() < 3 || !known(o[1])) return false;
    module_.ids[o[1]].constant = o[2];
    module_.ids[o[1]].has_constant = true;
    module_.ids[o[1]].value_type = o[0];
    return true;
  }

  bool spec_constant(Operands o, bool boolean) {
    if (o.size() < 2 || !known(o[1])) return false;
    module_.ids[o[1]].is_boolean = boolean;
    module_.spec_constants.push_back(o[1]);
    return true;
  }

  bool constant_composite(Operands o) {
    if (o.size() < 2 || !known(o[1])) return false;
    Id& id = module_.ids[o[1]];
    for (std::size_t i = 0; i < 3 && i + 2 < o.size(); ++i) {
      if (!known(o[i + 2])) return false;
      id.composite[i] = module_.ids[o[i + 2]].constant;
      id.parts[i] = o[i + 2];
    }
    if (!id.is_workgroup_size) return true;
    workgroup_size_ = id.composite;
    module_.local_size_ids = id.parts;
    return true;
  }

  bool variable(Operands o) {
    if (o.size() < 3 || !known(o[1]) || !is_type(o[0])) return false;
    if (o[2] == spv::StorageClassFunction) return true;
    Id& id = module_.ids[o[1]];
    id.variable_type = o[0];
    id.storage_class = o[2];
    module_.variables.push_back(o[1]);
    return true;
  }

  bool type_instruction(std::uint32_t op, Operands o) {
    if (o.empty() || !known(o[0]) || is_type(o[0])) return false;
    Type& type = module_.ids[o[0]].type;
    switch (op) {
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
        if (o.size() < 2 || o[1] > 64) return false;
        type = {.kind = TypeKind::scalar, .bytes = o[1] / 8};
        type.is_float = op == spv::OpTypeFloat;
        type.is_signed = op == spv::OpTypeInt && o.size() >= 3 && o[2] != 0;
        return true;
      case spv::OpTypeVector:
        if (o.size() < 3 || !is_type(o[1])) return false;
        type = {.kind = TypeKind::vector, .element = o[1], .count = o[2]};
        type.bytes = clamp_bytes(std::uint64_t{o[2]} * module_.ids[o[1]].type.bytes);
        return true;
      case spv::OpTypeMatrix:
        if (o.size() < 3 || !is_type(o[1])) return false;
        type = {.kind = TypeKind::matrix, .element = o[1], .count = o[2]};
        return true;
      case spv::OpTypeImage:
        if (o.size() < 8) return false;
        type.kind = TypeKind::image;
        type.element = known(o[1]) ? o[1] : 0;
        type.image_dimension = o[2];
        type.image_arrayed = o[4] != 0;
        type.image_sampled = o[6];
        return true;
      case spv::OpTypeSampledImage:
      case spv::OpTypeRuntimeArray:
        if (o.size() < 2 || !is_type(o[1])) return false;
        type.kind = op == spv::OpTypeSampledImage ? TypeKind::sampled_image : TypeKind::runtime_array;
        type.element = o[1];
        return true;
      case spv::OpTypeArray:
        if (o.size() < 3 || !is_type(o[1]) || !known(o[2])) return false;
        type = {.kind = TypeKind::array, .element = o[1], .count = module_.ids[o[2]].constant};
        type.bytes = clamp_bytes(std::uint64_t{type.count} * module_.ids[o[0]].array_stride);
        return true;
      case spv::OpTypeStruct:
        return structure(o);
      case spv::OpTypePointer:
        if (o.size() < 3 || !known(o[2])) return false;
        type = {.kind = TypeKind::pointer, .element = o[2], .bytes = kPointerBytes, .storage_class = o[1]};
        return true;
      default:
        type.kind = TypeKind::other;
        return true;
    }
  }

  bool structure(Operands o) {
    Id& id = module_.ids[o[0]];
    for (std::uint32_t i = 1; i < o.size(); ++i) {
      if (!known(o[i])) return false;
      id.type.members.push_back(o[i]);
      const auto member = id.members.find(i - 1);
      if (member == id.members.end() || !member->second.has_offset) continue;
      // Only a pointer type may be declared after the structure that contains it.
      const std::uint32_t bytes = is_type(o[i]) ? module_.bytes_of(o[i], member->second.matrix_stride) : kPointerBytes;
      id.type.bytes = std::max(id.type.bytes, clamp_bytes(std::uint64_t{member->second.offset} + bytes));
    }
    id.type.kind = TypeKind::structure;
    module_.structures.push_back(o[0]);
    return true;
  }

  /// Marks the ids that an instruction of a function body reads or writes through. Looks only at operands that are ids.
  bool use(std::uint32_t op, Operands o) {
    std::size_t first = o.size();
    std::size_t last = o.size();
    switch (op) {
      case spv::OpLoad:
      case spv::OpCopyObject:
      case spv::OpImageTexelPointer:
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain:
      case spv::OpPtrAccessChain:
      case spv::OpArrayLength:
        first = 2;
        last = 3;
        break;
      case spv::OpFunctionCall:
        first = 3;
        break;
      case spv::OpStore:
      case spv::OpAtomicStore:
        first = 0;
        last = 1;
        break;
      case spv::OpCopyMemory:
        first = 0;
        last = 2;
        break;
      default:
        if (op < spv::OpAtomicLoad || op > spv::OpAtomicXor) return true;
        first = 2;
        last = 3;
        break;
    }
    for (std::size_t i = first; i < last && i < o.size(); ++i) {
      if (!known(o[i])) return false;
      module_.used[o[i]] = true;
    }
    return true;
  }

  void resolve_local_size() {
    if (local_size_are_ids_) {
      module_.local_size_ids = module_.local_size;
      for (std::uint32_t& size : module_.local_size) size = known(size) ? module_.ids[size].constant : 0;
    }
    if (workgroup_size_[0] != 0) module_.local_size = workgroup_size_;
    for (std::uint32_t& id : module_.local_size_ids)
      if (!known(id)) id = 0;
  }

  std::span<const std::uint32_t> words_;
  Module module_;
  bool local_size_are_ids_ = false;
  std::array<std::uint32_t, 3> workgroup_size_ = {0, 0, 0};
};

}  // namespace

std::uint32_t Module::bytes_of(std::uint32_t type, std::uint32_t matrix_stride) const {
  const Type& t = ids[type].type;
  if (t.kind != TypeKind::matrix) return t.bytes;
  return t.count == 0 ? 0 : clamp_bytes(std::uint64_t{t.count - 1} * matrix_stride + ids[t.element].type.bytes);
}

Result<Module> parse_module(std::span<const std::uint32_t> words) { return Parser(words).run(); }

}  // namespace gloam::gpu::spirv
