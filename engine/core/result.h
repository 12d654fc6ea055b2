// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/core/assert.h"

namespace gloam {

/// Kind of an error in the environment or the input; the program maps it to its exit code.
enum class ErrorKind {
  failed,     ///< failed while running: device lost, out of memory, disk full (exit code 1)
  usage,      ///< unknown option, knob, value, camera, visualizer (exit code 2)
  input,      ///< the scene or an asset is bad or absent (exit code 3)
  no_device,  ///< no usable Vulkan device (exit code 4)
};

/// One error. The message is one sentence that says where and what failed; it never ends with a line break.
struct Error {
  ErrorKind kind = ErrorKind::failed;
  std::string message;
};

/// A value, or the error that explains why there is none. Reading the value of a failed result, or the error of a
/// successful one, asserts.
template <class T = std::monostate>
class [[nodiscard]] Result {
 public:
  Result() requires std::is_same_v<T, std::monostate> : state_(std::in_place_index<0>) {}
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  [[nodiscard]] T& value() & {
    GLOAM_ASSERT(ok(), "a Result that holds an error has no value");
    return *std::get_if<0>(&state_);
  }
  [[nodiscard]] const T& value() const& {
    GLOAM_ASSERT(ok(), "a Result that holds an error has no value");
    return *std::get_if<0>(&state_);
  }
  [[nodiscard]] T&& value() && {
    GLOAM_ASSERT(ok(), "a Result that holds an error has no value");
    return std::move(*std::get_if<0>(&state_));
  }
  [[nodiscard]] const Error& error() const {
    GLOAM_ASSERT(!ok(), "a Result that holds a value has no error");
    return *std::get_if<1>(&state_);
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  std::variant<T, Error> state_;
};

using Status = Result<>;

}  // namespace gloam

/// Returns the error of `expression` from the enclosing function, if it has one.
#define GLOAM_TRY(expression)                                                                          \
  do {                                                                                                 \
    if (auto gloam_try_result = (expression); !gloam_try_result.ok()) return gloam_try_result.error(); \
  } while (false)
