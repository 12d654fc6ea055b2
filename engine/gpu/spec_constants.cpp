// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/spec_constants.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace gloam::gpu {
namespace {

std::string shortest_text(float value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string_view glsl_name(SpecType type) {
  switch (type) {
    case SpecType::boolean:
      return "bool";
    case SpecType::unsigned_integer:
      return "uint";
    case SpecType::signed_integer:
      return "int";
    case SpecType::floating:
      break;
  }
  return "float";
}

}  // namespace

std::string text_of(const SpecValue& value) {
  switch (value.type) {
    case SpecType::boolean:
      return value.bits != 0 ? "true" : "false";
    case SpecType::unsigned_integer:
      return std::to_string(value.bits);
    case SpecType::signed_integer:
      return std::to_string(static_cast<std::int32_t>(value.bits));
    case SpecType::floating:
      break;
  }
  return shortest_text(std::bit_cast<float>(value.bits));
}

SpecConstants::SpecConstants(std::initializer_list<SpecConstant> constants) {
  constants_.reserve(constants.size());
  for (const SpecConstant& constant : constants) put(constant);
}

void SpecConstants::set(const SpecConstants& others) {
  for (const SpecConstant& constant : others) put(constant);
}

void SpecConstants::put(const SpecConstant& constant) {
  const auto at = std::ranges::lower_bound(constants_, constant.name, {}, &SpecConstant::name);
  if (at != constants_.end() && at->name == constant.name) {
    *at = constant;
  } else {
    constants_.insert(at, constant);
  }
}

SpecConstants SpecConstants::where_present() const {
  SpecConstants result = *this;
  for (SpecConstant& constant : result.constants_) constant.if_present = true;
  return result;
}

const SpecConstant* SpecConstants::find(std::string_view name) const {
  const auto at = std::ranges::lower_bound(constants_, name, {}, &SpecConstant::name);
  return at == constants_.end() || at->name != name ? nullptr : &*at;
}

std::optional<SpecFault> find_fault(const SpecConstants& constants, std::span<const ReflectedConstant> declared) {
  for (const SpecConstant& constant : constants) {
    bool present = false;
    for (const ReflectedConstant& other : declared) {
      if (other.name != constant.name) continue;
      present = true;
      if (other.type == constant.value.type) continue;
      return SpecFault{constant.name, "the shader declares it as " + std::string(glsl_name(other.type)) +
                                          ", and the value is of type " + std::string(glsl_name(constant.value.type))};
    }
    if (!present && !constant.if_present)
      return SpecFault{constant.name, "the program has no specialisation constant of this name"};
  }
  return std::nullopt;
}

std::vector<NumberedConstant> numbered(const SpecConstants& constants, std::span<const ReflectedConstant> declared) {
  std::vector<NumberedConstant> result;
  for (const SpecConstant& constant : constants)
    for (const ReflectedConstant& other : declared) {
      if (other.name != constant.name) continue;
      const auto known = std::ranges::find(result, other.id, &NumberedConstant::id);
      if (known == result.end()) result.push_back({other.id, constant.value.bits});
    }
  return result;
}

}  // namespace gloam::gpu
