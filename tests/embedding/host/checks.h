// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/log.h"
#include "engine/core/result.h"

namespace host {

inline constexpr int kSkipped = 77;  ///< exit status where there is no usable device

[[noreturn]] inline void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);
}
template <class T>
T value_of(gloam::Result<T> result) {
  if (!result.ok()) fail(result.error().message);
  return std::move(*result);
}
inline void check(const gloam::Status& status) {
  if (!status.ok()) fail(status.error().message);
}

/// Prints warnings and errors.
inline gloam::LogSink& warning_log() {
  static gloam::FunctionLog log([](gloam::LogLevel level, std::string_view line) {
    if (level >= gloam::LogLevel::warning) std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
  });
  return log;
}

}  // namespace host
