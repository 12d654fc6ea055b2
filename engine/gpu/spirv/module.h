// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"

/// Parses a SPIR-V module into the tables that reflection needs. It decodes instructions only and does not interpret
/// descriptors.
namespace gloam::gpu::spirv {

enum class TypeKind : std::uint8_t {
  none,
  scalar,
  vector,
  matrix,
  image,
  sampled_image,
  array,
  runtime_array,
  structure,
  pointer,
  other,
};

struct Type {
  TypeKind kind = TypeKind::none;
  std::uint32_t element = 0;          ///< id of the component, column, element, image or pointee type
  std::uint32_t count = 0;            ///< components, columns or elements
  std::uint32_t bytes = 0;            ///< size without trailing padding; 0: opaque, unsized, or a matrix
  std::uint32_t storage_class = 0;    ///< pointers only
  std::uint32_t image_dimension = 0;  ///< Dim operand; element: the sampled type
  bool image_arrayed = false;
  std::uint32_t image_sampled = 0;     ///< 1: with a sampler, 2: storage
  bool is_float = false;               ///< scalars only
  bool is_signed = false;              ///< integer scalars only
  std::vector<std::uint32_t> members;  ///< structures only: type ids
};

struct MemberDecorations {
  std::string name;
  bool has_offset = false;
  std::uint32_t offset = 0;
  std::uint32_t matrix_stride = 0;
  bool non_writable = false;
};

/// The properties of one id.
struct Id {
  std::string name;
  std::vector<std::string> other_names;  ///< further OpNames: optimisers merge ids and keep the names of both
  Type type;
  std::uint32_t constant = 0;  ///< value of a constant: its first word
  bool has_constant = false;
  std::uint32_t value_type = 0;                        ///< id of a scalar constant's type
  bool is_boolean = false;                             ///< a boolean specialisation constant
  std::array<std::uint32_t, 3> composite = {0, 0, 0};  ///< first words of a composite constant's parts
  std::array<std::uint32_t, 3> parts = {0, 0, 0};      ///< ids of a composite constant's parts
  bool has_spec_id = false;
  std::uint32_t spec_id = 0;
  bool is_workgroup_size = false;
  bool has_set = false;
  bool has_binding = false;
  bool buffer_block = false;
  bool block = false;
  bool non_writable = false;
  std::uint32_t set = 0;
  std::uint32_t binding = 0;
  std::uint32_t array_stride = 0;
  std::uint32_t variable_type = 0;  ///< pointer type of a global variable; 0: not a variable
  std::uint32_t storage_class = 0;
  std::map<std::uint32_t, MemberDecorations> members;
};

/// The properties of all ids of a module. Most ids are values of function bodies, which have none and take four bytes.
class IdTable {
 public:
  void resize(std::uint32_t bound) { places_.resize(bound, 0); }
  [[nodiscard]] std::size_t size() const { return places_.size(); }
  /// Makes the properties of an id that has none yet. References stay valid.
  [[nodiscard]] Id& operator[](std::uint32_t id) {
    if (places_[id] == 0) {
      made_.emplace_back();
      places_[id] = static_cast<std::uint32_t>(made_.size());
    }
    return made_[places_[id] - 1];
  }
  [[nodiscard]] const Id& operator[](std::uint32_t id) const {
    return places_[id] == 0 ? none_ : made_[places_[id] - 1];
  }

 private:
  Id none_;
  std::vector<std::uint32_t> places_;  ///< by id: index in made_ + 1; 0: no properties
  std::deque<Id> made_;
};

struct Module {
  IdTable ids;
  std::vector<bool> used;                ///< by id: function bodies read or write through it
  std::vector<std::uint32_t> variables;  ///< ids of the global variables, in order
  std::vector<std::uint32_t> structures;
  std::vector<std::uint32_t> spec_constants;  ///< ids of the scalar specialisation constants, in order
  bool has_entry = false;
  std::uint32_t execution_model = 0;
  std::array<std::uint32_t, 3> local_size = {0, 0, 0};
  /// Ids of the constants that give the local size; 0 where it is a literal.
  std::array<std::uint32_t, 3> local_size_ids = {0, 0, 0};

  /// Like Type::bytes, but for matrices too. matrix_stride: bytes; declared by the member that holds the matrix.
  [[nodiscard]] std::uint32_t bytes_of(std::uint32_t type, std::uint32_t matrix_stride) const;
};

/// The error message is a clause ("an instruction runs past the end") that the caller puts into a sentence.
[[nodiscard]] Result<Module> parse_module(std::span<const std::uint32_t> words);

}  // namespace gloam::gpu::spirv
