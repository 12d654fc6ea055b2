// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace gloam {

/// 64-bit FNV-1a over bytes, word by word mixed: stable over runs, builds and machines of one byte order.
class Hasher {
 public:
  Hasher& bytes(std::span<const std::byte> data) {
    for (std::byte b : data) state_ = (state_ ^ static_cast<std::uint64_t>(b)) * kPrime;
    return *this;
  }
  Hasher& text(std::string_view s) {
    value(s.size());
    return bytes(std::as_bytes(std::span(s.data(), s.size())));
  }
  /// Integers and enumerations only: structs may carry padding.
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

[[nodiscard]] inline std::uint64_t hash_bytes(std::span<const std::byte> data) { return Hasher().bytes(data).digest(); }

}  // namespace gloam
