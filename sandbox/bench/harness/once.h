// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "engine/core/result.h"

namespace gloam {

/// Something that several rows are told from: measured when the first of them is asked for, once a run of the program.
template <class T>
class Once {
 public:
  /// `measure()` is a Result<T>; one that failed is tried again.
  template <class Measure>
  [[nodiscard]] Result<const T*> get(Measure&& measure) {
    if (!value_) {
      auto measured = measure();
      if (!measured) return measured.error();
      value_ = std::move(measured).value();
    }
    return &*value_;
  }

 private:
  std::optional<T> value_;
};

}  // namespace gloam
