// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gloam {

/// Writes numbers in the machine's byte order, for cache files.
class ByteWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T>) void value(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  /// The items without their number. T must have no padding.
  template <class T>
  requires(std::is_trivially_copyable_v<T>) void items(std::span<const T> items) {
    bytes_.append(reinterpret_cast<const char*>(items.data()), items.size_bytes());
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what ByteWriter has written, also from damaged bytes. After a read beyond the end or a condition that fails,
/// all values are 0 and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  requires(std::is_arithmetic_v<T>) [[nodiscard]] T value() {
    T value{};
    copy(&value, sizeof(T));
    return value;
  }
  /// A number of items that take at least `bytes_each` of what is left.
  [[nodiscard]] std::uint32_t count(std::size_t bytes_each) {
    const auto items = value<std::uint32_t>();
    require(items <= left_.size() / bytes_each);
    return ok_ ? items : 0;
  }
  /// Empty if fewer than `count` items are left.
  template <class T>
  requires(std::is_trivially_copyable_v<T>) [[nodiscard]] std::vector<T> items(std::size_t count) {
    require(count <= left_.size() / sizeof(T));
    if (!ok_) return {};
    std::vector<T> items(count);
    copy(items.data(), count * sizeof(T));
    return items;
  }
  void require(bool condition) { ok_ = ok_ && condition; }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return ok_ && left_.empty(); }

 private:
  void copy(void* target, std::size_t bytes) {
    require(bytes <= left_.size());
    if (!ok_ || bytes == 0) return;
    std::memcpy(target, left_.data(), bytes);
    left_.remove_prefix(bytes);
  }
  std::string_view left_;
  bool ok_ = true;
};

}  // namespace gloam
