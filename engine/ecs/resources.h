// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/ecs/type_key.h"
#include "engine/ecs/type_table.h"

namespace gloam {

/// Holds one value per type. A value keeps its address until it is removed. Values are destroyed in reverse order of
/// the first set of their type.
class ResourceStore {
 public:
  ResourceStore() = default;
  ResourceStore(ResourceStore&&) = default;
  ResourceStore& operator=(ResourceStore&&) = delete;
  ~ResourceStore() {
    while (!slots_.empty()) slots_.pop_back();
  }

  /// Stores the value. An R that is already there is replaced at the same address.
  template <class R>
  R& set(R value) {
    static_assert(std::is_object_v<R> && !std::is_const_v<R>, "a resource is set by value");
    if (R* old = find<R>()) {
      if constexpr (std::is_move_assignable_v<R>) {
        *old = std::move(value);
        return *old;
      } else {
        static_assert(std::is_nothrow_move_constructible_v<R>, "replacing a value in place must not fail half-way");
        old->~R();
        return *::new (static_cast<void*>(old)) R(std::move(value));
      }
    }
    auto* fresh = new R(std::move(value));
    put(type_key<R>(), Slot(fresh, [](void* p) { delete static_cast<R*>(p); }));
    return *fresh;
  }

  /// Null when absent.
  template <class R>
  [[nodiscard]] R* find() const {
    const std::uint32_t slot = table_.find(type_key<R>());
    return slot == TypeTable::kAbsent ? nullptr : static_cast<R*>(slots_[slot].get());
  }

  /// Destroys the R. Does nothing when absent.
  template <class R>
  void remove() {
    const std::uint32_t slot = table_.find(type_key<R>());
    if (slot != TypeTable::kAbsent) slots_[slot].reset();
  }

 private:
  using Slot = std::unique_ptr<void, void (*)(void*)>;

  void put(TypeKey key, Slot value) {
    const std::uint32_t slot = table_.find(key);
    if (slot != TypeTable::kAbsent) {
      slots_[slot] = std::move(value);
      return;
    }
    table_.insert(key, static_cast<std::uint32_t>(slots_.size()));
    slots_.push_back(std::move(value));
  }

  TypeTable table_;
  std::vector<Slot> slots_;
};

}  // namespace gloam
