// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace gloam {

template <class... Ts>
struct TypeList {};

/// Identifies a type within one program run. Keys have no meaning otherwise, and each world maps them to its own ids.
enum class TypeKey : std::uint64_t { none = 0 };

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

/// Whether other files or functions may have another type of this name: it, or an argument of it, is in an unnamed
/// namespace or in a function, or is a lambda or an unnamed type. So is, needlessly, a name with a function type in it.
template <class T>
inline constexpr bool kHasLocalName = kTypeName<T>.find_first_of("({`") != std::string_view::npos
                                      || kTypeName<T>.find("<unnamed") != std::string_view::npos;

/// FNV-1a of the name, with the top bit set: no address has it.
template <class T>
inline constexpr std::uint64_t kTypeNameKey = [] {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : kTypeName<T>) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash | (std::uint64_t{1} << 63);
}();

/// FNV-1a of the name, used as a table position. Two types may have the same hash.
template <class T>
inline constexpr std::uint32_t kTypeNameHash = [] {
  std::uint32_t hash = 2166136261u;
  for (const char c : kTypeName<T>) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash ^ (hash >> 16);
}();

}  // namespace detail

/// The type's key. It is the same in the program and in all libraries that it loads, also where a library hides its
/// symbols or was loaded again: it follows from the type's name. Only types whose names are local to a file or a
/// function are told apart by an address, and so differ between libraries.
template <class T>
[[nodiscard]] TypeKey type_key() {
  if constexpr (detail::kHasLocalName<T>)
    return static_cast<TypeKey>(reinterpret_cast<std::uintptr_t>(&detail::TypeTag<T>::byte));
  else
    return static_cast<TypeKey>(detail::kTypeNameKey<T>);
}

/// The type's name as the compiler writes it.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
  return detail::kTypeName<T>;
}

}  // namespace gloam
