// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/many_selections.h"

#include <spirv/unified1/spirv.hpp>

#include <initializer_list>

#include "engine/gpu/spirv/control_flow.h"

namespace gloam::gpu::spirv {
namespace {

constexpr std::uint32_t kVersion15 = 0x00010500;
constexpr std::uint32_t kMainName[] = {0x6e69616d, 0};  // "main" and the end of the text

enum Name : std::uint32_t {
  kMain = 1,
  kVoid,
  kFunction,
  kUint,
  kBool,
  kBlock,
  kBlockPointer,
  kBuffer,
  kUintPointer,
  kZero,
  kOne,
  kEntry,
  kHeader,
  kLast,
  kContinue,
  kMerge,
  kTurns,
  kTurn,
  kNextTurn,
  kRepeats,
  kPlace,
  kFirstFree,
};

/// Ids of one if.
struct Ids {
  explicit Ids(std::uint32_t at)
      : header(kFirstFree + at * 6),
        value(header + 1),
        differs(header + 2),
        first(header + 3),
        second(header + 4),
        constant(header + 5) {}
  std::uint32_t header, value, differs, first, second, constant;
};

class Writer {
 public:
  void add(std::uint32_t op, std::initializer_list<std::uint32_t> operands) {
    words.push_back((static_cast<std::uint32_t>(operands.size()) + 1) << spv::WordCountShift | op);
    words.insert(words.end(), operands);
  }
  std::vector<std::uint32_t> words;
};

void declare(Writer& w, std::uint32_t count) {
  w.add(spv::OpCapability, {spv::CapabilityShader});
  w.add(spv::OpMemoryModel, {spv::AddressingModelLogical, spv::MemoryModelGLSL450});
  w.add(spv::OpEntryPoint, {spv::ExecutionModelGLCompute, kMain, kMainName[0], kMainName[1], kBuffer});
  w.add(spv::OpExecutionMode, {kMain, spv::ExecutionModeLocalSize, 1, 1, 1});
  w.add(spv::OpDecorate, {kBlock, spv::DecorationBlock});
  w.add(spv::OpMemberDecorate, {kBlock, 0, spv::DecorationOffset, 0});
  w.add(spv::OpDecorate, {kBuffer, spv::DecorationDescriptorSet, 0});
  w.add(spv::OpDecorate, {kBuffer, spv::DecorationBinding, 0});
  w.add(spv::OpTypeVoid, {kVoid});
  w.add(spv::OpTypeFunction, {kFunction, kVoid});
  w.add(spv::OpTypeInt, {kUint, 32, 0});
  w.add(spv::OpTypeBool, {kBool});
  w.add(spv::OpTypeStruct, {kBlock, kUint});
  w.add(spv::OpTypePointer, {kBlockPointer, spv::StorageClassStorageBuffer, kBlock});
  w.add(spv::OpVariable, {kBlockPointer, kBuffer, spv::StorageClassStorageBuffer});
  w.add(spv::OpTypePointer, {kUintPointer, spv::StorageClassStorageBuffer, kUint});
  w.add(spv::OpConstant, {kUint, kZero, 0});
  w.add(spv::OpConstant, {kUint, kOne, 1});
  for (std::uint32_t i = 0; i < count; ++i) w.add(spv::OpConstant, {kUint, Ids(i).constant, i + 2});
}

void write_if(Writer& w, const Ids& ids, std::uint32_t after) {
  w.add(spv::OpLabel, {ids.header});
  w.add(spv::OpLoad, {kUint, ids.value, kPlace});
  w.add(spv::OpINotEqual, {kBool, ids.differs, ids.value, ids.constant});
  w.add(spv::OpSelectionMerge, {after, spv::SelectionControlMaskNone});
  w.add(spv::OpBranchConditional, {ids.differs, ids.first, ids.second});
  w.add(spv::OpLabel, {ids.first});
  w.add(spv::OpStore, {kPlace, ids.constant});
  w.add(spv::OpBranch, {after});
  w.add(spv::OpLabel, {ids.second});
  w.add(spv::OpStore, {kPlace, kOne});
  w.add(spv::OpBranch, {after});
}

}  // namespace

std::vector<std::uint32_t> many_selections(std::uint32_t count) {
  Writer w;
  w.words = {spv::MagicNumber, kVersion15, 0, Ids(count).header, 0};
  declare(w, count);
  const std::uint32_t first = count > 0 ? Ids(0).header : kLast;
  w.add(spv::OpFunction, {kVoid, kMain, spv::FunctionControlMaskNone, kFunction});
  w.add(spv::OpLabel, {kEntry});
  w.add(spv::OpAccessChain, {kUintPointer, kPlace, kBuffer, kZero});
  w.add(spv::OpLoad, {kUint, kTurns, kPlace});
  w.add(spv::OpBranch, {kHeader});
  w.add(spv::OpLabel, {kHeader});
  w.add(spv::OpPhi, {kUint, kTurn, kZero, kEntry, kNextTurn, kContinue});
  w.add(spv::OpLoopMerge, {kMerge, kContinue, spv::LoopControlMaskNone});
  w.add(spv::OpBranch, {first});
  for (std::uint32_t i = 0; i < count; ++i) write_if(w, Ids(i), i + 1 < count ? Ids(i + 1).header : kLast);
  w.add(spv::OpLabel, {kLast});
  w.add(spv::OpBranch, {kContinue});
  w.add(spv::OpLabel, {kContinue});
  w.add(spv::OpIAdd, {kUint, kNextTurn, kTurn, kOne});
  w.add(spv::OpULessThan, {kBool, kRepeats, kNextTurn, kTurns});
  w.add(spv::OpBranchConditional, {kRepeats, kHeader, kMerge});
  w.add(spv::OpLabel, {kMerge});
  w.add(spv::OpReturn, {});
  w.add(spv::OpFunctionEnd, {});
  return w.words;
}

}  // namespace gloam::gpu::spirv
