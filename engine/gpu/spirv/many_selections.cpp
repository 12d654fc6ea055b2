// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/many_selections.h"

#include <spirv/unified1/spirv.hpp>

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

using Words = std::vector<std::uint32_t>;

void declare(Words& w, std::uint32_t count) {
  append(w, spv::OpCapability, {spv::CapabilityShader});
  append(w, spv::OpMemoryModel, {spv::AddressingModelLogical, spv::MemoryModelGLSL450});
  append(w, spv::OpEntryPoint, {spv::ExecutionModelGLCompute, kMain, kMainName[0], kMainName[1], kBuffer});
  append(w, spv::OpExecutionMode, {kMain, spv::ExecutionModeLocalSize, 1, 1, 1});
  append(w, spv::OpDecorate, {kBlock, spv::DecorationBlock});
  append(w, spv::OpMemberDecorate, {kBlock, 0, spv::DecorationOffset, 0});
  append(w, spv::OpDecorate, {kBuffer, spv::DecorationDescriptorSet, 0});
  append(w, spv::OpDecorate, {kBuffer, spv::DecorationBinding, 0});
  append(w, spv::OpTypeVoid, {kVoid});
  append(w, spv::OpTypeFunction, {kFunction, kVoid});
  append(w, spv::OpTypeInt, {kUint, 32, 0});
  append(w, spv::OpTypeBool, {kBool});
  append(w, spv::OpTypeStruct, {kBlock, kUint});
  append(w, spv::OpTypePointer, {kBlockPointer, spv::StorageClassStorageBuffer, kBlock});
  append(w, spv::OpVariable, {kBlockPointer, kBuffer, spv::StorageClassStorageBuffer});
  append(w, spv::OpTypePointer, {kUintPointer, spv::StorageClassStorageBuffer, kUint});
  append(w, spv::OpConstant, {kUint, kZero, 0});
  append(w, spv::OpConstant, {kUint, kOne, 1});
  for (std::uint32_t i = 0; i < count; ++i) append(w, spv::OpConstant, {kUint, Ids(i).constant, i + 2});
}

void write_if(Words& w, const Ids& ids, std::uint32_t after) {
  append(w, spv::OpLabel, {ids.header});
  append(w, spv::OpLoad, {kUint, ids.value, kPlace});
  append(w, spv::OpINotEqual, {kBool, ids.differs, ids.value, ids.constant});
  append(w, spv::OpSelectionMerge, {after, spv::SelectionControlMaskNone});
  append(w, spv::OpBranchConditional, {ids.differs, ids.first, ids.second});
  append(w, spv::OpLabel, {ids.first});
  append(w, spv::OpStore, {kPlace, ids.constant});
  append(w, spv::OpBranch, {after});
  append(w, spv::OpLabel, {ids.second});
  append(w, spv::OpStore, {kPlace, kOne});
  append(w, spv::OpBranch, {after});
}

}  // namespace

std::vector<std::uint32_t> many_selections(std::uint32_t count) {
  Words w = {spv::MagicNumber, kVersion15, 0, Ids(count).header, 0};
  declare(w, count);
  const std::uint32_t first = count > 0 ? Ids(0).header : kLast;
  append(w, spv::OpFunction, {kVoid, kMain, spv::FunctionControlMaskNone, kFunction});
  append(w, spv::OpLabel, {kEntry});
  append(w, spv::OpAccessChain, {kUintPointer, kPlace, kBuffer, kZero});
  append(w, spv::OpLoad, {kUint, kTurns, kPlace});
  append(w, spv::OpBranch, {kHeader});
  append(w, spv::OpLabel, {kHeader});
  append(w, spv::OpPhi, {kUint, kTurn, kZero, kEntry, kNextTurn, kContinue});
  append(w, spv::OpLoopMerge, {kMerge, kContinue, spv::LoopControlMaskNone});
  append(w, spv::OpBranch, {first});
  for (std::uint32_t i = 0; i < count; ++i) write_if(w, Ids(i), i + 1 < count ? Ids(i + 1).header : kLast);
  append(w, spv::OpLabel, {kLast});
  append(w, spv::OpBranch, {kContinue});
  append(w, spv::OpLabel, {kContinue});
  append(w, spv::OpIAdd, {kUint, kNextTurn, kTurn, kOne});
  append(w, spv::OpULessThan, {kBool, kRepeats, kNextTurn, kTurns});
  append(w, spv::OpBranchConditional, {kRepeats, kHeader, kMerge});
  append(w, spv::OpLabel, {kMerge});
  append(w, spv::OpReturn, {});
  append(w, spv::OpFunctionEnd, {});
  return w;
}

}  // namespace gloam::gpu::spirv
