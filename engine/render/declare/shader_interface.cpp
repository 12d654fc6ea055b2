// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/shader_interface.h"

#include <algorithm>

namespace gloam {
namespace {

using gpu::ReflectedBinding;
using gpu::ShaderStage;

/// Adds the bindings of set 0 of one shader. A binding that two shaders declare must be the same in both.
Status add_shader(const gpu::ShaderCode& code, ShaderStage stage, ShaderInterface& interface) {
  auto reflected = gpu::reflect_spirv(code);
  if (!reflected.ok()) return reflected.error();
  const std::string who = "shader \"" + std::string(code.name) + "\"";
  if (reflected->stage != stage) return Error{ErrorKind::input, who + " is a shader of another stage"};
  interface.name = code.name;
  interface.push_constant_bytes = std::max(interface.push_constant_bytes, reflected->push_constant_bytes);
  if (stage == ShaderStage::compute) interface.local_size = reflected->local_size;
  interface.constants.insert(interface.constants.end(), reflected->constants.begin(), reflected->constants.end());
  for (const ReflectedBinding& b : reflected->bindings) {
    if (b.set != 0) continue;
    auto at = std::ranges::find(interface.bindings, b.binding, &InterfaceBinding::binding);
    if (at == interface.bindings.end()) {
      at = interface.bindings.insert(
          at, {binding_key(b.name), b.name, b.binding, b.kind, b.dimension, b.arrayed, b.texels, b.writable});
    } else if (at->name != b.name || at->kind != b.kind) {
      return Error{ErrorKind::input, who + ": binding " + std::to_string(b.binding) + " is \"" + b.name +
                                         "\", but the vertex shader calls it \"" + at->name + "\""};
    }
    at->used = at->used || b.used;
    at->writable = at->writable || b.writable;
    (stage == ShaderStage::vertex ? at->in_vertex : at->in_last) = true;
  }
  return {};
}

}  // namespace

Result<const ShaderInterface*> ShaderInterfaces::of(const gpu::ShaderCode& compute) {
  std::unique_ptr<const ShaderInterface>& known = interfaces_[{compute.words.data(), nullptr}];
  if (known != nullptr) return known.get();
  ShaderInterface made;
  made.compute = true;
  GLOAM_TRY(add_shader(compute, ShaderStage::compute, made));
  known = std::make_unique<const ShaderInterface>(std::move(made));
  return known.get();
}

Result<const ShaderInterface*> ShaderInterfaces::of(const gpu::ShaderCode& vertex, const gpu::ShaderCode& fragment) {
  std::unique_ptr<const ShaderInterface>& known = interfaces_[{vertex.words.data(), fragment.words.data()}];
  if (known != nullptr) return known.get();
  ShaderInterface made;
  GLOAM_TRY(add_shader(vertex, ShaderStage::vertex, made));
  if (!fragment.words.empty()) GLOAM_TRY(add_shader(fragment, ShaderStage::fragment, made));
  known = std::make_unique<const ShaderInterface>(std::move(made));
  return known.get();
}

}  // namespace gloam
