// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/shader_interface.h"

#include <algorithm>

namespace gloam::gpu {
namespace {

bool binds_alike(const ReflectedBinding& a, const ReflectedBinding& b) {
  return a.kind == b.kind && a.count == b.count && a.dimension == b.dimension && a.arrayed == b.arrayed &&
         a.texels == b.texels && a.writable == b.writable && a.name == b.name;
}

bool lies_alike(const ReflectedStruct& a, const ReflectedStruct& b) {
  const auto same = [](const ReflectedMember& x, const ReflectedMember& y) {
    return x.name == y.name && x.offset == y.offset && x.size == y.size && x.array_stride == y.array_stride;
  };
  return a.size == b.size && std::ranges::equal(a.members, b.members, same);
}

bool has_workgroups_alike(const SpirvReflection& a, const SpirvReflection& b) {
  for (const char* part : {"local_size_x", "local_size_y", "local_size_z"})
    if ((a.find_constant(part) == nullptr) != (b.find_constant(part) == nullptr)) return false;
  return a.local_size == b.local_size;
}

}  // namespace

std::string interface_difference(const SpirvReflection& from, const SpirvReflection& to) {
  if (from.stage != to.stage) return "it is of another stage";
  if (!has_workgroups_alike(from, to)) return "its workgroup size has changed";
  if (from.push_constant_bytes != to.push_constant_bytes) return "its push constants have changed";
  for (const ReflectedBinding& binding : from.bindings) {
    const ReflectedBinding* other = to.find_binding(binding.set, binding.binding);
    if (other == nullptr) return "binding '" + binding.name + "' is gone";
    if (!binds_alike(binding, *other)) return "binding '" + binding.name + "' has changed";
  }
  for (const ReflectedBinding& binding : to.bindings)
    if (from.find_binding(binding.set, binding.binding) == nullptr) return "binding '" + binding.name + "' is new";
  for (const ReflectedConstant& constant : from.constants) {
    const ReflectedConstant* other = to.find_constant(constant.name);
    if (other != nullptr && other->type != constant.type)
      return "specialisation constant '" + constant.name + "' has changed";
  }
  for (const ReflectedStruct& structure : from.structs) {
    const ReflectedStruct* other = to.find_struct(structure.name);
    if (other != nullptr && !lies_alike(structure, *other)) return "structure '" + structure.name + "' has changed";
  }
  return {};
}

}  // namespace gloam::gpu
