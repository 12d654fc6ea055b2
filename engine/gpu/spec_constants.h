// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gloam::gpu {

enum class SpecType : std::uint8_t { boolean, unsigned_integer, signed_integer, floating };

/// The value of a specialisation constant: bool, uint, int or float in the shader.
struct SpecValue {
  SpecType type = SpecType::unsigned_integer;
  std::uint32_t bits = 0;

  constexpr SpecValue(std::same_as<bool> auto value) : type(SpecType::boolean), bits(value ? 1 : 0) {}
  constexpr SpecValue(std::same_as<std::uint32_t> auto value) : bits(value) {}
  constexpr SpecValue(std::same_as<std::int32_t> auto value)
      : type(SpecType::signed_integer), bits(static_cast<std::uint32_t>(value)) {}
  constexpr SpecValue(std::same_as<float> auto value)
      : type(SpecType::floating), bits(std::bit_cast<std::uint32_t>(value)) {}
  bool operator==(const SpecValue&) const = default;
};

/// "8", "true", "0.5".
[[nodiscard]] std::string text_of(const SpecValue& value);

struct SpecConstant {
  /// As in the shader. Parts of the workgroup size that `layout(local_size_x_id = …)` makes constants, which have no
  /// name in GLSL, are called local_size_x, local_size_y and local_size_z (uint). The characters must stay valid like
  /// those of ShaderCode::name; use literals.
  std::string_view name;
  SpecValue value;
  bool if_present = false;  ///< see SpecConstants::set_if_present
  bool operator==(const SpecConstant&) const = default;
};

/// The specialisation constants that a pipeline sets; the others keep the defaults of its shaders. Sorted by name, so
/// the order of calls does not count. A later value replaces an earlier one of the same name.
///
/// A constant applies to every shader of the pipeline that has one of this name and type. Misuse asserts when a pass
/// chooses the program or the device creates the pipeline: a value of another type, or a name that no shader of the
/// pipeline has, unless the constant was set by set_if_present. That is for lists which several shaders share, for
/// example the shadow filter's constants: versions of a shader without shadows lack them.
class SpecConstants {
 public:
  SpecConstants() = default;
  SpecConstants(std::initializer_list<SpecConstant> constants);

  void set(std::string_view name, SpecValue value) { put({name, value}); }
  void set_if_present(std::string_view name, SpecValue value) { put({name, value, true}); }
  /// Sets all constants of another list in the way they were set there.
  void set(const SpecConstants& others);

  /// The same constants, all set by set_if_present.
  [[nodiscard]] SpecConstants where_present() const;

  /// Null if the constant is not set.
  [[nodiscard]] const SpecConstant* find(std::string_view name) const;
  [[nodiscard]] std::size_t size() const { return constants_.size(); }
  [[nodiscard]] bool empty() const { return constants_.empty(); }
  [[nodiscard]] auto begin() const { return constants_.begin(); }
  [[nodiscard]] auto end() const { return constants_.end(); }
  bool operator==(const SpecConstants&) const = default;

 private:
  void put(const SpecConstant& constant);
  std::vector<SpecConstant> constants_;
};

/// A specialisation constant that a shader has.
struct ReflectedConstant {
  std::string name;
  std::uint32_t id = 0;  ///< the constant_id of GLSL
  SpecType type = SpecType::unsigned_integer;
};

struct SpecFault {
  std::string_view name;  ///< of the constant
  std::string clause;     ///< for a sentence: "no shader of the program has …"
};
/// The first constant that shaders with these constants cannot take; nullopt: none. declared: the constants of all
/// shaders of the pipeline.
[[nodiscard]] std::optional<SpecFault> find_fault(const SpecConstants& constants,
                                                  std::span<const ReflectedConstant> declared);

/// A constant by its number in one shader.
struct NumberedConstant {
  std::uint32_t id = 0;
  std::uint32_t value = 0;  ///< bits
};
/// The constants that a shader takes. declared: the shader's constants. Each number appears once.
[[nodiscard]] std::vector<NumberedConstant> numbered(const SpecConstants& constants,
                                                     std::span<const ReflectedConstant> declared);

}  // namespace gloam::gpu
