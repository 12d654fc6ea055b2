// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace gloam {

template <class... Ts>
struct TypeList {};

namespace detail {

/// One byte per type, used only for its address. Not const, because linkers may fold equal constants into one.
template <class T>
struct TypeTag {
  static inline char byte = 0;
};

template <class T>
constexpr const char* raw_type_name() {
#if defined(_MSC_VER) && !defined(__clang__)
  return __FUNCSIG__;
#else
  return __PRETTY_FUNCTION__;
#endif
}

template <class T>
constexpr std::string_view cut_type_name() {
  std::string_view name = raw_type_name<T>();
#if defined(_MSC_VER) && !defined(__clang__)
  name.remove_prefix(name.find("raw_type_name<") + 14);
  name.remove_suffix(name.size() - name.rfind(">("));
#else
  name.remove_prefix(name.find("T = ") + 4);
  name.remove_suffix(1);
#endif
  return name;
}

template <class T>
inline constexpr std::string_view kTypeName = cut_type_name<T>();

/// FNV-1a of the name, used as a table position. Two types may have the same hash.
template <class T>
inline constexpr std::uint32_t kTypeNameHash = [] {
  std::uint32_t hash = 2166136261u;
  for (const char c : kTypeName<T>) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash ^ (hash >> 16);
}();

}  // namespace detail

/// Key that identifies a type within one program run. Keys have no order, and each world maps them to its own ids.
template <class T>
[[nodiscard]] const void* type_key() {
  return &detail::TypeTag<T>::byte;
}

/// The type's name as the compiler writes it, for messages only.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
  return detail::kTypeName<T>;
}

}  // namespace gloam
