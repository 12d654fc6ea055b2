// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gloam::gltf {

/// What the value of a member must look like.
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
  index_maps,  ///< array of such
};

/// One member of one type of object of a glTF file.
struct Rule {
  std::string_view type;  ///< of the object that holds the member, as messages call it; "" is the file's root
  std::string_view member;
  Form form = Form::any;
  bool required = false;
  std::uint32_t count = 0;  ///< numbers: exactly so many (0: any); objects: at most so many (0: any)
  std::string_view item;
  std::string_view refers;  ///< index, indices, index maps: the root's array that is counted off
};

/// Types whose `extras` hold scene keys and whose `extensions` are kept as they stand.
inline constexpr std::string_view kRootType = "";
inline constexpr std::string_view kNodeType = "node";
inline constexpr std::string_view kMaterialType = "material";
inline constexpr std::string_view kSceneType = "scene";

/// The rules of one type, at most 64; empty for a type that is not looked into. They live for ever.
[[nodiscard]] std::span<const Rule> rules_of(std::string_view type);

}  // namespace gloam::gltf
