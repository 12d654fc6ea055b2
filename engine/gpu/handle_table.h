// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/gpu/types.h"

namespace gloam::gpu {

/// The kind of object that handles of this type name.
template <class H>
[[nodiscard]] constexpr const char* kind_of_handle() {
  if constexpr (std::is_same_v<H, BufferHandle>) return "buffer";
  if constexpr (std::is_same_v<H, ImageHandle>) return "image";
  if constexpr (std::is_same_v<H, PipelineHandle>) return "pipeline";
  if constexpr (std::is_same_v<H, ResourceSetHandle>) return "resource set";
  if constexpr (std::is_same_v<H, MemoryHandle>) return "memory block";
  return "object";
}

/// A table of objects addressed by handles. All methods may be called from any thread. A reference stays valid until
/// its object is removed; the table does not synchronise access to the object itself.
template <class T, class H>
class HandleTable {
 public:
  H insert(T object) {
    const std::lock_guard lock(mutex_);
    std::uint32_t index = 0;
    if (free_.empty()) {
      index = static_cast<std::uint32_t>(slots_.size());
      slots_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    Slot& slot = slots_[index];
    ++slot.generation;
    slot.object.emplace(std::move(object));
    return H{index, slot.generation};
  }

  [[nodiscard]] bool alive(H handle) const {
    const std::lock_guard lock(mutex_);
    return is_alive(handle);
  }

  [[nodiscard]] T& get(H handle) {
    const std::lock_guard lock(mutex_);
    GLOAM_ASSERT(is_alive(handle), dead_sentence());
    return *slots_[handle.index].object;
  }
  [[nodiscard]] const T& get(H handle) const {
    const std::lock_guard lock(mutex_);
    GLOAM_ASSERT(is_alive(handle), dead_sentence());
    return *slots_[handle.index].object;
  }

  /// Removes and returns the object; its handle becomes stale.
  [[nodiscard]] T remove(H handle) {
    const std::lock_guard lock(mutex_);
    GLOAM_ASSERT(is_alive(handle), dead_sentence() + "; an object is destroyed once");
    return take(handle.index);
  }

  /// Removes and returns all objects, ordered by index.
  [[nodiscard]] std::vector<T> remove_all() {
    const std::lock_guard lock(mutex_);
    std::vector<T> objects;
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].object) objects.push_back(take(i));
    }
    return objects;
  }

  /// Calls function(const T&) for every object while the table is locked.
  template <class F>
  void for_each(F&& function) const {
    const std::lock_guard lock(mutex_);
    for (const Slot& slot : slots_) {
      if (slot.object) function(*slot.object);
    }
  }

 private:
  struct Slot {
    std::uint32_t generation = 0;
    std::optional<T> object;
  };

  [[nodiscard]] static std::string dead_sentence() {
    return std::string("this ") + kind_of_handle<H>() + " is not alive: it was destroyed, or is of another device";
  }
  [[nodiscard]] bool is_alive(H handle) const {
    return handle.index < slots_.size() && slots_[handle.index].object.has_value() &&
           slots_[handle.index].generation == handle.generation;
  }

  T take(std::uint32_t index) {
    Slot& slot = slots_[index];
    T object = std::move(*slot.object);
    slot.object.reset();
    free_.push_back(index);
    return object;
  }

  mutable std::mutex mutex_;
  std::deque<Slot> slots_;  // a deque never moves its elements when it grows
  std::vector<std::uint32_t> free_;
};

}  // namespace gloam::gpu
