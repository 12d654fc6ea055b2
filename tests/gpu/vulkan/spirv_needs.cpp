// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/gpu/vulkan/spirv_needs.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace gloam::test {
namespace {

/// Features by capability; empty: Vulkan 1.3 has the capability without a feature.
const std::map<std::uint32_t, std::string> kCapabilities = {
    {spv::CapabilityMatrix, ""},
    {spv::CapabilityShader, ""},
    {spv::CapabilityFloat16, "shaderFloat16"},
    {spv::CapabilityFloat64, "shaderFloat64"},
    {spv::CapabilityInt64, "shaderInt64"},
    {spv::CapabilityInt16, "shaderInt16"},
    {spv::CapabilityImageGatherExtended, "shaderImageGatherExtended"},
    {spv::CapabilityUniformBufferArrayDynamicIndexing, "shaderUniformBufferArrayDynamicIndexing"},
    {spv::CapabilitySampledImageArrayDynamicIndexing, "shaderSampledImageArrayDynamicIndexing"},
    {spv::CapabilityStorageBufferArrayDynamicIndexing, "shaderStorageBufferArrayDynamicIndexing"},
    {spv::CapabilityStorageImageArrayDynamicIndexing, "shaderStorageImageArrayDynamicIndexing"},
    {spv::CapabilityClipDistance, "shaderClipDistance"},
    {spv::CapabilityCullDistance, "shaderCullDistance"},
    {spv::CapabilityImageCubeArray, "imageCubeArray"},
    {spv::CapabilitySampleRateShading, "sampleRateShading"},
    {spv::CapabilityInt8, "shaderInt8"},
    {spv::CapabilityInputAttachment, "inputAttachment"},
    {spv::CapabilitySampled1D, ""},
    {spv::CapabilityImage1D, ""},
    {spv::CapabilitySampledCubeArray, "imageCubeArray"},
    {spv::CapabilitySampledBuffer, ""},
    {spv::CapabilityImageBuffer, ""},
    {spv::CapabilityStorageImageExtendedFormats, "shaderStorageImageExtendedFormats"},
    {spv::CapabilityImageQuery, ""},
    {spv::CapabilityDerivativeControl, ""},
    {spv::CapabilityStorageImageReadWithoutFormat, "shaderStorageImageReadWithoutFormat"},
    {spv::CapabilityStorageImageWriteWithoutFormat, "shaderStorageImageWriteWithoutFormat"},
    {spv::CapabilityMultiViewport, "multiViewport"},
    {spv::CapabilityShaderLayer, "shaderOutputLayer"},
    {spv::CapabilityShaderViewportIndex, "shaderOutputViewportIndex"},
    {spv::CapabilityDrawParameters, "shaderDrawParameters"},
    {spv::CapabilityDemoteToHelperInvocation, "shaderDemoteToHelperInvocation"},
};

constexpr std::uint32_t kStorageImage = 2;  // operand Sampled of OpTypeImage, which has no enumeration

struct Type {
  std::uint32_t op = 0;
  std::vector<std::uint32_t> operands;  ///< without the result id
};

struct Variable {
  std::uint32_t id, pointer, storage;
};

class Module {
 public:
  explicit Module(std::span<const std::uint32_t> words) {
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t i = kHeaderWords; i < words.size(); i += words[i] >> spv::WordCountShift) {
      read(words[i] & spv::OpCodeMask, words.subspan(i + 1, (words[i] >> spv::WordCountShift) - 1));
    }
  }

  [[nodiscard]] SpirvNeeds needs() const {
    SpirvNeeds result = needs_;
    for (const Variable& variable : variables_) {
      const std::uint32_t type = without_arrays(types_.at(variable.pointer).operands.at(1));
      if (writable(variable, type)) {
        if (model_ == spv::ExecutionModelFragment) result.features.emplace("fragmentStoresAndAtomics");
        if (model_ == spv::ExecutionModelVertex) result.features.emplace("vertexPipelineStoresAndAtomics");
      }
      const bool block = variable.storage == spv::StorageClassUniform ||
                         variable.storage == spv::StorageClassPushConstant ||
                         variable.storage == spv::StorageClassStorageBuffer;
      if (block && !laid_out(type, variable.storage == spv::StorageClassUniform))
        result.features.emplace("scalarBlockLayout");
    }
    return result;
  }

 private:
  void read(std::uint32_t op, std::span<const std::uint32_t> w) {
    switch (op) {
      case spv::OpCapability:
        add_capability(w[0]);
        break;
      case spv::OpExtension:
        needs_.unknown.insert("an extension that begins with word " + std::to_string(w[0]));
        break;
      case spv::OpEntryPoint:
        model_ = w[0];
        break;
      case spv::OpExecutionMode:
      case spv::OpExecutionModeId:
        if (w[1] == spv::ExecutionModeLocalSizeId) needs_.features.emplace("maintenance4");
        break;
      case spv::OpTypeInt:
      case spv::OpTypeFloat:
      case spv::OpTypeVector:
      case spv::OpTypeMatrix:
      case spv::OpTypeImage:
      case spv::OpTypeArray:
      case spv::OpTypeRuntimeArray:
      case spv::OpTypeStruct:
      case spv::OpTypePointer:
        types_[w[0]] = {op, {w.begin() + 1, w.end()}};
        break;
      case spv::OpVariable:
        variables_.push_back({w[1], w[0], w[2]});
        break;
      case spv::OpDecorate:
        decorations_[{w[0], w[1]}] = w.size() > 2 ? w[2] : 1;
        break;
      case spv::OpMemberDecorate:
        members_[{w[0], w[1], w[2]}] = w.size() > 3 ? w[3] : 1;
        break;
      default:
        break;
    }
  }

  void add_capability(std::uint32_t capability) {
    const auto found = kCapabilities.find(capability);
    if (found == kCapabilities.end()) {
      needs_.unknown.insert("capability " + std::to_string(capability));
    } else if (!found->second.empty()) {
      needs_.features.insert(found->second);
    }
  }

  [[nodiscard]] const Type& type(std::uint32_t id) const {
    static const Type none;
    const auto found = types_.find(id);
    return found == types_.end() ? none : found->second;
  }
  [[nodiscard]] std::uint32_t without_arrays(std::uint32_t id) const {
    while (type(id).op == spv::OpTypeArray || type(id).op == spv::OpTypeRuntimeArray) id = type(id).operands[0];
    return id;
  }
  [[nodiscard]] std::uint32_t member(std::uint32_t id, std::uint32_t index, spv::Decoration decoration) const {
    const auto found = members_.find({id, index, decoration});
    return found == members_.end() ? 0 : found->second;
  }

  [[nodiscard]] bool writable(const Variable& variable, std::uint32_t resource) const {
    if (decorations_.count({variable.id, spv::DecorationNonWritable}) != 0) return false;
    const Type& t = type(resource);
    if (variable.storage == spv::StorageClassUniformConstant)
      return t.op == spv::OpTypeImage && t.operands[5] == kStorageImage;
    if (variable.storage != spv::StorageClassStorageBuffer) return false;
    for (std::uint32_t i = 0; i < t.operands.size(); ++i) {
      if (member(resource, i, spv::DecorationNonWritable) == 0) return true;
    }
    return false;
  }

  [[nodiscard]] std::uint32_t scalar_bytes(std::uint32_t id) const {
    const Type& t = type(id);
    return t.op == spv::OpTypeVector || t.op == spv::OpTypeMatrix ? scalar_bytes(t.operands[0]) : t.operands[0] / 8;
  }

  /// The base alignment; of arrays and structures in uniform buffers the extended alignment.
  [[nodiscard]] std::uint32_t alignment(std::uint32_t id, bool in_uniform) const {
    const Type& t = type(id);
    std::uint32_t result = 1;
    switch (t.op) {
      case spv::OpTypeVector:
        return scalar_bytes(id) * (t.operands[1] == 2 ? 2 : 4);
      case spv::OpTypeMatrix:
        result = alignment(t.operands[0], in_uniform);
        break;
      case spv::OpTypeArray:
      case spv::OpTypeRuntimeArray:
        result = alignment(t.operands[0], in_uniform);
        break;
      case spv::OpTypeStruct:
        for (const std::uint32_t m : t.operands) result = std::max(result, alignment(m, in_uniform));
        break;
      default:
        return scalar_bytes(id);
    }
    return in_uniform ? (result + 15) / 16 * 16 : result;
  }

  /// Whether the rules without scalarBlockLayout allow a member of this type at this offset.
  [[nodiscard]] bool may_lie_at(std::uint32_t id, std::uint32_t at, bool in_uniform) const {
    const Type& t = type(id);
    if (t.op != spv::OpTypeVector) return at % alignment(id, in_uniform) == 0;
    const std::uint32_t bytes = scalar_bytes(id) * t.operands[1];
    if (at % scalar_bytes(id) != 0) return false;
    return bytes <= 16 ? at / 16 == (at + bytes - 1) / 16 : at % 16 == 0;
  }

  [[nodiscard]] bool strides_fit(std::uint32_t id, bool in_uniform) const {
    for (; type(id).op == spv::OpTypeArray || type(id).op == spv::OpTypeRuntimeArray; id = type(id).operands[0]) {
      const auto stride = decorations_.find({id, spv::DecorationArrayStride});
      if (stride != decorations_.end() && stride->second % alignment(id, in_uniform) != 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool laid_out(std::uint32_t structure, bool in_uniform) const {
    const Type& t = type(structure);
    if (t.op != spv::OpTypeStruct) return true;
    for (std::uint32_t i = 0; i < t.operands.size(); ++i) {
      const std::uint32_t id = t.operands[i];
      const std::uint32_t columns = member(structure, i, spv::DecorationMatrixStride);
      if (!may_lie_at(id, member(structure, i, spv::DecorationOffset), in_uniform) || !strides_fit(id, in_uniform))
        return false;
      if (columns != 0 && columns % alignment(without_arrays(id), in_uniform) != 0) return false;
      if (!laid_out(without_arrays(id), in_uniform)) return false;
    }
    return true;
  }

  SpirvNeeds needs_;
  std::uint32_t model_ = 0;
  std::map<std::uint32_t, Type> types_;
  std::vector<Variable> variables_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> decorations_;  ///< by id and decoration
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t>
      members_;  ///< by structure, member and decoration
};

}  // namespace

SpirvNeeds find_spirv_needs(std::span<const std::uint32_t> words) { return Module(words).needs(); }

}  // namespace gloam::test
