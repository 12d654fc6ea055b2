// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gloam::test {

/// A structure of a *_shared.h as the C++ compiler lays it out.
struct SharedMember {
  const char* name;
  std::size_t offset;
  std::size_t size;
  std::size_t stride;  ///< of an array's elements; 0: not an array
};
struct SharedStruct {
  std::string_view name;
  std::size_t size;
  std::vector<SharedMember> members;
};

template <class T>
constexpr std::size_t array_stride() {
  return std::is_array_v<T> ? sizeof(std::remove_extent_t<T>) : 0;
}
/// A member of a structure in the namespace gloam::shaders.
#define GLOAM_MEMBER(type, member)                                           \
  ::gloam::test::SharedMember {                                              \
#member, offsetof(shaders::type, member), sizeof(shaders::type::member), \
        ::gloam::test::array_stride < decltype(shaders::type::member)>()     \
  }

}  // namespace gloam::test
