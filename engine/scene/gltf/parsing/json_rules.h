// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gloam::gltf {

/// Form that the value of a member must have.
enum class Form : std::uint8_t {
  any,
  text,
  word,  ///< one of the words in `item`
  boolean,
  number,
  index,       ///< integer in 0…2³¹−1
  size,        ///< integer ≥ 0
  numbers,     ///< array of numbers
  indices,     ///< array of indices
  texts,       ///< array of strings
  object,      ///< of type `item`
  objects,     ///< array of objects of type `item`
  index_map,   ///< object whose members are all indices
  index_maps,  ///< array of index maps
};

/// Rule for one member of one type of object in a glTF file.
struct Rule {
  std::string_view type;  ///< type of the object that holds the member, as in messages; "" is the file's root
  std::string_view member;
  Form form = Form::any;
  bool required = false;
  std::uint32_t count = 0;  ///< numbers: exact count; objects: largest count; 0: any
  std::string_view item;
  std::string_view refers;  ///< index, indices, index maps: the root's array that the indices refer to
};

/// Types whose `extensions` are kept as written; except for the root, their `extras` hold scene keys.
inline constexpr std::string_view kRootType = "";
inline constexpr std::string_view kNodeType = "node";
inline constexpr std::string_view kMaterialType = "material";
inline constexpr std::string_view kSceneType = "scene";

/// The rules of one type, at most 64; empty for a type that is not checked. The span refers to static storage.
[[nodiscard]] std::span<const Rule> rules_of(std::string_view type);

}  // namespace gloam::gltf
