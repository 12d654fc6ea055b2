// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/types.h"

namespace gloam {

/// A name of a binding as a number that is fast to compare.
[[nodiscard]] constexpr std::uint64_t binding_key(std::string_view name) {
  std::uint64_t key = 0xcbf29ce484222325ull;  // FNV-1a
  for (const char c : name) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return key;
}

/// One binding of set 0, in all shaders of a program.
struct InterfaceBinding {
  std::uint64_t key = 0;  ///< binding_key(name)
  std::string name;
  std::uint32_t binding = 0;
  gpu::ResourceKind kind = gpu::ResourceKind::other;
  gpu::ImageDimension dimension = gpu::ImageDimension::none;
  bool arrayed = false;
  gpu::TexelKind texels = gpu::TexelKind::floats;
  bool writable = false;
  bool used = false;
  bool in_vertex = false;  ///< the vertex shader declares it
  bool in_last = false;    ///< the fragment or compute shader declares it
};

/// The bindings, constants and targets that a program (a compute shader, or a vertex and a fragment shader) needs from
/// its pass.
struct ShaderInterface {
  std::string name;  ///< of the compute or fragment shader; of the vertex shader if there is no fragment shader
  bool compute = false;
  std::vector<InterfaceBinding> bindings;  ///< of set 0
  std::uint32_t push_constant_bytes = 0;
  std::array<std::uint32_t, 3> local_size = {1, 1, 1};  ///< with default constants; compute only
  std::vector<gpu::ReflectedConstant> constants;        ///< of all shaders

  /// Null if set 0 has no binding of this name.
  [[nodiscard]] const InterfaceBinding* find(std::uint64_t key) const {
    for (const InterfaceBinding& binding : bindings)
      if (binding.key == key) return &binding;
    return nullptr;
  }
};

/// Interfaces of shaders by reflection, computed once per shader or pair of shaders. For one thread. Interfaces live as
/// long as this object.
class ShaderInterfaces {
 public:
  /// Fails with ErrorKind::input if the shader is no valid SPIR-V of this stage.
  [[nodiscard]] Result<const ShaderInterface*> of(const gpu::ShaderCode& compute);
  /// fragment: may have no words (depth only).
  [[nodiscard]] Result<const ShaderInterface*> of(const gpu::ShaderCode& vertex, const gpu::ShaderCode& fragment);

 private:
  using Key = std::pair<const std::uint32_t*, const std::uint32_t*>;  ///< addresses of the shaders' words
  std::map<Key, std::unique_ptr<const ShaderInterface>> interfaces_;
};

}  // namespace gloam
