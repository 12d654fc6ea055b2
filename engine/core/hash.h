// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace gloam {

/// XXH3 (64 bits) of the bytes. The digest is stable across runs, builds and machines.
[[nodiscard]] std::uint64_t hash_bytes(std::span<const std::byte> data);

/// 64-bit hash of a sequence of items: each call adds one mixed word to the state. Digests are stable across runs,
/// builds and machines of the same byte order.
class Hasher {
 public:
  /// Adds hash_bytes(data) as one item: bytes(a).bytes(b) differs from bytes() of a and b joined.
  Hasher& bytes(std::span<const std::byte> data) { return value(hash_bytes(data)); }
  Hasher& text(std::string_view s) { return bytes(std::as_bytes(std::span(s.data(), s.size()))); }
  /// Adds the bytes of a number, vector or matrix as one item. T must have no padding.
  template <class T>
  requires(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>) Hasher& bytes_of(const T& v) {
    return bytes(std::as_bytes(std::span(&v, 1)));
  }
  /// Adds the number of items in a contiguous range and then their bytes. The items must have no padding.
  template <class Range>
  Hasher& items(const Range& range) {
    const std::span all(range);
    return value(all.size()).bytes(std::as_bytes(all));
  }
  /// Integers and enumerations only: structs may contain padding.
  template <class T>
  requires(std::is_integral_v<T> || std::is_enum_v<T>) Hasher& value(T v) {
    auto x = static_cast<std::uint64_t>(v);
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdull;
    state_ = (state_ ^ x ^ (x >> 29)) * kPrime;
    return *this;
  }
  [[nodiscard]] std::uint64_t digest() const { return state_ ^ (state_ >> 32); }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ull;
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace gloam
