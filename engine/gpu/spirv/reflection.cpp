// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spirv/reflection.h"

#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <optional>
#include <tuple>

#include "engine/gpu/spirv/module.h"

namespace gloam::gpu {
namespace {

using spirv::Id;
using spirv::Module;
using spirv::Type;
using spirv::TypeKind;

std::optional<ShaderStage> stage_of(std::uint32_t execution_model) {
  switch (execution_model) {
    case spv::ExecutionModelVertex:
      return ShaderStage::vertex;
    case spv::ExecutionModelFragment:
      return ShaderStage::fragment;
    case spv::ExecutionModelGLCompute:
      return ShaderStage::compute;
    default:
      return std::nullopt;
  }
}

bool is_type(const Module& module, std::uint32_t id) {
  return id != 0 && id < module.ids.size() && module.ids[id].type.kind != TypeKind::none;
}

/// A block without a variable name is known by its only member: `uniform Block { Type name; };`.
std::string name_of_block(const Id& structure) {
  if (structure.type.members.size() != 1) return structure.name;
  const auto member = structure.members.find(0);
  const bool named = member != structure.members.end() && !member->second.name.empty();
  return named ? member->second.name : structure.name;
}

/// A buffer is read-only if each member of its block is.
bool is_read_only(const Id& structure) {
  for (std::uint32_t i = 0; i < structure.type.members.size(); ++i) {
    const auto member = structure.members.find(i);
    if (member == structure.members.end() || !member->second.non_writable) return false;
  }
  return true;
}

void describe_image(const Module& module, const Type& image, ReflectedBinding& binding) {
  const Type& texel = module.ids[image.element].type;
  if (texel.kind == TypeKind::scalar && !texel.is_float)
    binding.texels = texel.is_signed ? TexelKind::signed_integers : TexelKind::unsigned_integers;
  binding.arrayed = image.image_arrayed;
  binding.dimension = image.image_dimension == spv::Dim2D     ? ImageDimension::plane
                      : image.image_dimension == spv::Dim3D   ? ImageDimension::volume
                      : image.image_dimension == spv::DimCube ? ImageDimension::cube
                                                              : ImageDimension::other;
}

ReflectedBinding reflect_binding(const Module& module, std::uint32_t id_of_variable) {
  const Id& variable = module.ids[id_of_variable];
  ReflectedBinding binding;
  binding.set = variable.set;
  binding.binding = variable.binding;
  binding.used = module.used[id_of_variable];
  binding.name = variable.name;
  std::uint32_t id = module.ids[variable.variable_type].type.element;
  while (is_type(module, id)) {
    const Type& type = module.ids[id].type;
    if (type.kind == TypeKind::array || type.kind == TypeKind::runtime_array) {
      binding.count *= type.kind == TypeKind::array ? type.count : 0;
      id = type.element;
      continue;
    }
    if (type.kind == TypeKind::structure) {
      if (binding.name.empty()) binding.name = name_of_block(module.ids[id]);
      const bool storage = variable.storage_class == spv::StorageClassStorageBuffer ||
                           (variable.storage_class == spv::StorageClassUniform && module.ids[id].buffer_block);
      binding.kind = storage                                              ? ResourceKind::storage_buffer
                     : variable.storage_class == spv::StorageClassUniform ? ResourceKind::uniform_buffer
                                                                          : ResourceKind::other;
      binding.writable = storage && !variable.non_writable && !is_read_only(module.ids[id]);
    } else if (type.kind == TypeKind::sampled_image) {
      binding.kind = ResourceKind::sampled_image;
      describe_image(module, module.ids[type.element].type, binding);
    } else if (type.kind == TypeKind::image && type.image_sampled == 2) {
      binding.kind = ResourceKind::storage_image;
      binding.writable = !variable.non_writable;
      describe_image(module, type, binding);
    }
    break;
  }
  return binding;
}

/// Returns nullopt if a member has no offset: the structure then has no memory layout.
std::optional<ReflectedStruct> reflect_struct(const Module& module, std::uint32_t id) {
  const Id& structure = module.ids[id];
  ReflectedStruct result;
  result.name = structure.name;
  result.size = structure.type.bytes;
  for (std::uint32_t i = 0; i < structure.type.members.size(); ++i) {
    const auto found = structure.members.find(i);
    if (found == structure.members.end() || !found->second.has_offset) return std::nullopt;
    const std::uint32_t type = structure.type.members[i];
    ReflectedMember member;
    member.name = found->second.name;
    member.offset = found->second.offset;
    if (is_type(module, type)) {
      member.size = module.bytes_of(type, found->second.matrix_stride);
      member.array_stride = module.ids[type].array_stride;
    }
    result.members.push_back(std::move(member));
  }
  return result;
}

void reflect_local_size(const Module& module, SpirvReflection& reflection) {
  static constexpr std::array<const char*, 3> kNames = {"local_size_x", "local_size_y", "local_size_z"};
  reflection.local_size = module.local_size;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const Id& part = module.ids[module.local_size_ids[i]];
    if (module.local_size_ids[i] != 0 && part.has_spec_id)
      reflection.constants.push_back({kNames[i], part.spec_id, SpecType::unsigned_integer});
  }
}

std::optional<SpecType> spec_type_of(const Module& module, const Id& constant) {
  if (constant.is_boolean) return SpecType::boolean;
  if (!is_type(module, constant.value_type)) return std::nullopt;
  const Type& type = module.ids[constant.value_type].type;
  if (type.kind != TypeKind::scalar || type.bytes != 4) return std::nullopt;
  if (type.is_float) return SpecType::floating;
  return type.is_signed ? SpecType::signed_integer : SpecType::unsigned_integer;
}

void reflect_constants(const Module& module, SpirvReflection& reflection) {
  for (const std::uint32_t id : module.spec_constants) {
    const Id& constant = module.ids[id];
    const auto type = spec_type_of(module, constant);
    if (!type || !constant.has_spec_id || constant.name.empty()) continue;
    reflection.constants.push_back({constant.name, constant.spec_id, *type});
    for (const std::string& name : constant.other_names)
      reflection.constants.push_back({name, constant.spec_id, *type});
  }
}

}  // namespace

std::string_view name_of(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::uniform_buffer:
      return "uniform buffer";
    case ResourceKind::storage_buffer:
      return "storage buffer";
    case ResourceKind::sampled_image:
      return "sampled image";
    case ResourceKind::storage_image:
      return "storage image";
    case ResourceKind::other:
      break;
  }
  return "resource of an unknown kind";
}

const ReflectedStruct* SpirvReflection::find_struct(std::string_view struct_name) const {
  const auto found = std::find_if(structs.begin(), structs.end(), [&](const auto& s) { return s.name == struct_name; });
  return found == structs.end() ? nullptr : &*found;
}

const ReflectedBinding* SpirvReflection::find_binding(std::uint32_t set, std::uint32_t binding) const {
  const auto found = std::find_if(bindings.begin(), bindings.end(),
                                  [&](const auto& b) { return b.set == set && b.binding == binding; });
  return found == bindings.end() ? nullptr : &*found;
}

const ReflectedConstant* SpirvReflection::find_constant(std::string_view constant_name) const {
  const auto found = std::ranges::find(constants, constant_name, &ReflectedConstant::name);
  return found == constants.end() ? nullptr : &*found;
}

Result<SpirvReflection> reflect_spirv(const ShaderCode& code) {
  const std::string who = "shader \"" + std::string(code.name) + "\"";
  Result<Module> parsed = spirv::parse_module(code.words);
  if (!parsed) return Error{ErrorKind::input, who + " is no valid SPIR-V: " + parsed.error().message};
  const Module& module = *parsed;

  SpirvReflection reflection;
  const std::optional<ShaderStage> stage = module.has_entry ? stage_of(module.execution_model) : std::nullopt;
  if (!stage) return Error{ErrorKind::input, who + " has no entry point \"main\" for vertices, fragments or compute"};
  reflection.stage = *stage;
  if (*stage == ShaderStage::compute) reflect_local_size(module, reflection);
  reflect_constants(module, reflection);

  for (const std::uint32_t id : module.variables) {
    const Id& variable = module.ids[id];
    if (variable.has_set && variable.has_binding) {
      reflection.bindings.push_back(reflect_binding(module, id));
    } else if (variable.storage_class == spv::StorageClassPushConstant) {
      const std::uint32_t block = module.ids[variable.variable_type].type.element;
      if (is_type(module, block)) {
        reflection.push_constant_bytes = std::max(reflection.push_constant_bytes, module.ids[block].type.bytes);
      }
    }
  }
  std::sort(reflection.bindings.begin(), reflection.bindings.end(),
            [](const auto& a, const auto& b) { return std::tie(a.set, a.binding) < std::tie(b.set, b.binding); });
  for (const std::uint32_t id : module.structures) {
    if (auto structure = reflect_struct(module, id)) reflection.structs.push_back(std::move(*structure));
  }
  return reflection;
}

}  // namespace gloam::gpu
