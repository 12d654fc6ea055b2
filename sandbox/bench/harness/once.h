// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "engine/core/result.h"

namespace gloam {

/// A measurement that several rows share: made for the first row that asks, once per run of the program.
template <class T>
class Once {
 public:
  /// `measure()` returns a Result<T>. After a failure the next call tries again.
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
