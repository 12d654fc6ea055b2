// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/ecs/type_key.h"

namespace gloam {

/// Maps type keys to small numbers: open addressing, at most half full. Lookups are safe from many threads while no
/// thread inserts.
class TypeTable {
 public:
  static constexpr std::uint32_t kAbsent = ~0u;

  TypeTable();

  [[nodiscard]] std::uint32_t find(TypeKey key) const {
    const Slot& first = slots_[home(key)];
    return first.key == key ? first.value : find_further(key);
  }

  /// `key` must not be in the table yet.
  void insert(TypeKey key, std::uint32_t value);

 private:
  struct Slot {
    TypeKey key = TypeKey::none;
    std::uint32_t value = kAbsent;
  };

  [[nodiscard]] std::size_t home(TypeKey key) const {
    return static_cast<std::size_t>((static_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15ull) >> shift_);
  }

  [[nodiscard]] std::uint32_t find_further(TypeKey key) const;

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  int shift_ = 0;  ///< 64 - log2(slots_.size())
};

/// Cache in front of a TypeTable. The place of each type is known at compile time, so a lookup is one comparison. If
/// types share a place, only the first one inserted is found; the others need the TypeTable.
class TypeCache {
 public:
  /// The number of T if the cache holds it, otherwise the result of `otherwise`.
  template <class T, class Otherwise>
  [[nodiscard]] std::uint32_t find_or(const Otherwise& otherwise) const {
    const Slot& slot = slots_[detail::kTypeNameHash<T> % kPlaces];
    if (slot.key == type_key<T>()) [[likely]]
      return slot.value;
    return otherwise();
  }
  /// `name_hash`: detail::kTypeNameHash of the type.
  void insert(TypeKey key, std::uint32_t name_hash, std::uint32_t value);
  /// A cache that is off keeps its entries, but finds none.
  void set_on(bool on);

 private:
  static constexpr std::size_t kPlaces = 256;
  struct Slot {
    TypeKey key = TypeKey::none;
    std::uint32_t value = TypeTable::kAbsent;
  };
  std::array<Slot, kPlaces> slots_;  ///< all empty while the cache is off
  std::array<Slot, kPlaces> entries_;
  bool on_ = true;
};

}  // namespace gloam
