// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/gpu/vulkan/spirv_needs.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace gloam::test {
namespace {

/// Features by capability; empty: Vulkan 1.3 has the capability without a feature.
const std::map<std::uint32_t, std::string> kCapabilities = {
    {0, ""},                            // Matrix
    {1, ""},                            // Shader
    {9, "shaderFloat16"},               // Float16
    {10, "shaderFloat64"},              // Float64
    {11, "shaderInt64"},                // Int64
    {22, "shaderInt16"},                // Int16
    {25, "shaderImageGatherExtended"},  // ImageGatherExtended
    {28, "shaderUniformBufferArrayDynamicIndexing"},
    {29, "shaderSampledImageArrayDynamicIndexing"},
    {30, "shaderStorageBufferArrayDynamicIndexing"},
    {31, "shaderStorageImageArrayDynamicIndexing"},
    {32, "shaderClipDistance"},                    // ClipDistance
    {33, "shaderCullDistance"},                    // CullDistance
    {34, "imageCubeArray"},                        // ImageCubeArray
    {35, "sampleRateShading"},                     // SampleRateShading
    {39, "shaderInt8"},                            // Int8
    {40, "inputAttachment"},                       // InputAttachment
    {43, ""},                                      // Sampled1D
    {44, ""},                                      // Image1D
    {45, "imageCubeArray"},                        // SampledCubeArray
    {46, ""},                                      // SampledBuffer
    {47, ""},                                      // ImageBuffer
    {49, "shaderStorageImageExtendedFormats"},     // StorageImageExtendedFormats
    {50, ""},                                      // ImageQuery
    {51, ""},                                      // DerivativeControl
    {55, "shaderStorageImageReadWithoutFormat"},   // StorageImageReadWithoutFormat
    {56, "shaderStorageImageWriteWithoutFormat"},  // StorageImageWriteWithoutFormat
    {57, "multiViewport"},                         // MultiViewport
    {69, "shaderOutputLayer"},                     // ShaderLayer
    {70, "shaderOutputViewportIndex"},             // ShaderViewportIndex
    {4427, "shaderDrawParameters"},                // DrawParameters
    {5379, "shaderDemoteToHelperInvocation"},      // DemoteToHelperInvocation
};

enum Op : std::uint32_t {
  op_extension = 10,
  op_entry_point = 15,
  op_execution_mode = 16,
  op_capability = 17,
  op_type_int = 21,
  op_type_float = 22,
  op_type_vector = 23,
  op_type_matrix = 24,
  op_type_image = 25,
  op_type_array = 28,
  op_type_runtime_array = 29,
  op_type_struct = 30,
  op_type_pointer = 32,
  op_variable = 59,
  op_decorate = 71,
  op_member_decorate = 72,
  op_execution_mode_id = 331,
};
enum Decoration : std::uint32_t {
  array_stride = 6,
  matrix_stride = 7,
  non_writable = 24,
  offset = 35,
};
enum StorageClass : std::uint32_t { uniform_constant = 0, uniform = 2, push_constant = 9, storage_buffer = 12 };
constexpr std::uint32_t kLocalSizeId = 38;
constexpr std::uint32_t kVertex = 0;
constexpr std::uint32_t kFragment = 4;
constexpr std::uint32_t kStorageImage = 2;

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
    for (std::size_t i = kHeaderWords; i < words.size(); i += words[i] >> 16) {
      read(words[i] & 0xffffu, words.subspan(i + 1, (words[i] >> 16) - 1));
    }
  }

  [[nodiscard]] SpirvNeeds needs() const {
    SpirvNeeds result = needs_;
    for (const Variable& variable : variables_) {
      const std::uint32_t type = without_arrays(types_.at(variable.pointer).operands.at(1));
      if (writable(variable, type)) {
        if (model_ == kFragment) result.features.emplace("fragmentStoresAndAtomics");
        if (model_ == kVertex) result.features.emplace("vertexPipelineStoresAndAtomics");
      }
      const bool block =
          variable.storage == uniform || variable.storage == push_constant || variable.storage == storage_buffer;
      if (block && !laid_out(type, variable.storage == uniform)) result.features.emplace("scalarBlockLayout");
    }
    return result;
  }

 private:
  void read(std::uint32_t op, std::span<const std::uint32_t> w) {
    switch (op) {
      case op_capability:
        add_capability(w[0]);
        break;
      case op_extension:
        needs_.unknown.insert("an extension that begins with word " + std::to_string(w[0]));
        break;
      case op_entry_point:
        model_ = w[0];
        break;
      case op_execution_mode:
      case op_execution_mode_id:
        if (w[1] == kLocalSizeId) needs_.features.emplace("maintenance4");
        break;
      case op_type_int:
      case op_type_float:
      case op_type_vector:
      case op_type_matrix:
      case op_type_image:
      case op_type_array:
      case op_type_runtime_array:
      case op_type_struct:
      case op_type_pointer:
        types_[w[0]] = {op, {w.begin() + 1, w.end()}};
        break;
      case op_variable:
        variables_.push_back({w[1], w[0], w[2]});
        break;
      case op_decorate:
        decorations_[{w[0], w[1]}] = w.size() > 2 ? w[2] : 1;
        break;
      case op_member_decorate:
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
    while (type(id).op == op_type_array || type(id).op == op_type_runtime_array) id = type(id).operands[0];
    return id;
  }
  [[nodiscard]] std::uint32_t member(std::uint32_t id, std::uint32_t index, Decoration decoration) const {
    const auto found = members_.find({id, index, decoration});
    return found == members_.end() ? 0 : found->second;
  }

  [[nodiscard]] bool writable(const Variable& variable, std::uint32_t resource) const {
    if (decorations_.count({variable.id, non_writable}) != 0) return false;
    const Type& t = type(resource);
    if (variable.storage == uniform_constant) return t.op == op_type_image && t.operands[5] == kStorageImage;
    if (variable.storage != storage_buffer) return false;
    for (std::uint32_t i = 0; i < t.operands.size(); ++i) {
      if (member(resource, i, non_writable) == 0) return true;
    }
    return false;
  }

  [[nodiscard]] std::uint32_t scalar_bytes(std::uint32_t id) const {
    const Type& t = type(id);
    return t.op == op_type_vector || t.op == op_type_matrix ? scalar_bytes(t.operands[0]) : t.operands[0] / 8;
  }

  /// The base alignment; of arrays and structures in uniform buffers the extended alignment.
  [[nodiscard]] std::uint32_t alignment(std::uint32_t id, bool in_uniform) const {
    const Type& t = type(id);
    std::uint32_t result = 1;
    switch (t.op) {
      case op_type_vector:
        return scalar_bytes(id) * (t.operands[1] == 2 ? 2 : 4);
      case op_type_matrix:
        result = alignment(t.operands[0], in_uniform);
        break;
      case op_type_array:
      case op_type_runtime_array:
        result = alignment(t.operands[0], in_uniform);
        break;
      case op_type_struct:
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
    if (t.op != op_type_vector) return at % alignment(id, in_uniform) == 0;
    const std::uint32_t bytes = scalar_bytes(id) * t.operands[1];
    if (at % scalar_bytes(id) != 0) return false;
    return bytes <= 16 ? at / 16 == (at + bytes - 1) / 16 : at % 16 == 0;
  }

  [[nodiscard]] bool strides_fit(std::uint32_t id, bool in_uniform) const {
    for (; type(id).op == op_type_array || type(id).op == op_type_runtime_array; id = type(id).operands[0]) {
      const auto stride = decorations_.find({id, array_stride});
      if (stride != decorations_.end() && stride->second % alignment(id, in_uniform) != 0) return false;
    }
    return true;
  }

  [[nodiscard]] bool laid_out(std::uint32_t structure, bool in_uniform) const {
    const Type& t = type(structure);
    if (t.op != op_type_struct) return true;
    for (std::uint32_t i = 0; i < t.operands.size(); ++i) {
      const std::uint32_t id = t.operands[i];
      const std::uint32_t columns = member(structure, i, matrix_stride);
      if (!may_lie_at(id, member(structure, i, offset), in_uniform) || !strides_fit(id, in_uniform)) return false;
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
