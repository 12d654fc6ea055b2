// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/spec_constants.h"
#include "engine/gpu/types.h"

/// Reflection of compiled shaders: stage, bindings and memory layouts. SPIR-V specification 1.6, §2 (layout of a
/// module) and §3 (instructions).
namespace gloam::gpu {

enum class ShaderStage : std::uint8_t { vertex, fragment, compute };
enum class ResourceKind : std::uint8_t { uniform_buffer, storage_buffer, sampled_image, storage_image, other };
enum class ImageDimension : std::uint8_t { none, plane, cube, volume, other };
/// The type of the components that a shader reads from a texel of an image.
enum class TexelKind : std::uint8_t { floats, unsigned_integers, signed_integers };
[[nodiscard]] std::string_view name_of(ResourceKind kind);

struct ReflectedBinding {
  std::uint32_t set = 0;
  std::uint32_t binding = 0;
  ResourceKind kind = ResourceKind::other;
  std::uint32_t count = 1;  ///< array elements; 0: unsized array
  ImageDimension dimension = ImageDimension::none;
  bool arrayed = false;                  ///< the image is declared as an array
  TexelKind texels = TexelKind::floats;  ///< images only
  bool writable = false;                 ///< storage buffers and images that are not declared readonly
  bool used = false;                     ///< some function of the shader reads or writes it
  /// The name that shader code uses: of the variable; if it has none, of the block's only member; otherwise of the
  /// block.
  std::string name;
};

struct ReflectedMember {
  std::string name;
  std::uint32_t offset = 0;        ///< bytes
  std::uint32_t size = 0;          ///< bytes; 0 for an unsized array
  std::uint32_t array_stride = 0;  ///< bytes from element to element; 0: not an array
};

/// A structure with a memory layout: a block, or a structure inside one.
struct ReflectedStruct {
  std::string name;
  std::vector<ReflectedMember> members;
  std::uint32_t size = 0;  ///< bytes to the end of the last member, without padding after it
};

struct SpirvReflection {
  ShaderStage stage = ShaderStage::compute;
  std::array<std::uint32_t, 3> local_size = {0, 0, 0};  ///< compute shaders only, with default specialisation constants
  /// Specialisation constants: booleans and 32-bit numbers. Those without a debug name are left out, except parts of
  /// the workgroup size (see SpecConstant::name). An optimiser may give a constant more names; each is listed.
  std::vector<ReflectedConstant> constants;
  std::uint32_t push_constant_bytes = 0;
  std::vector<ReflectedBinding> bindings;  ///< ordered by set, then binding
  std::vector<ReflectedStruct> structs;

  /// The first structure with this name, or null. Names exist only if the shader was compiled with debug names.
  [[nodiscard]] const ReflectedStruct* find_struct(std::string_view struct_name) const;
  [[nodiscard]] const ReflectedBinding* find_binding(std::uint32_t set, std::uint32_t binding) const;
  [[nodiscard]] const ReflectedConstant* find_constant(std::string_view constant_name) const;
};

/// Fails with ErrorKind::input if the words are not a SPIR-V module with an entry point "main" of a known stage. The
/// error names the shader.
[[nodiscard]] Result<SpirvReflection> reflect_spirv(const ShaderCode& code);

}  // namespace gloam::gpu
