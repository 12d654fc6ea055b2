// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <unordered_map>
#include <utility>

#include "engine/ecs/type_key.h"

namespace gloam {

/// Holds at most one value per type. Passes of one module leave values for passes of later modules.
class Board {
 public:
  /// Replaces a value of the same type.
  template <class T>
  T& put(T value) {
    return std::any_cast<T&>(values_.insert_or_assign(type_key<T>(), std::move(value)).first->second);
  }
  /// The value of this type, or null if there is none.
  template <class T>
  [[nodiscard]] T* find() {
    const auto found = values_.find(type_key<T>());
    return found == values_.end() ? nullptr : &std::any_cast<T&>(found->second);
  }
  template <class T>
  [[nodiscard]] const T* find() const {
    const auto found = values_.find(type_key<T>());
    return found == values_.end() ? nullptr : &std::any_cast<const T&>(found->second);
  }
  void clear() { values_.clear(); }

 private:
  std::unordered_map<TypeKey, std::any> values_;
};

}  // namespace gloam
