// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace gloam {

enum class LogLevel { debug, info, warning, error };

/// Receives log messages; a host passes its own sink. write() may be called from any thread, with one whole line
/// (without its line break) per call.
class LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void write(LogLevel level, std::string_view line) = 0;

  void debug(std::string_view line) { write(LogLevel::debug, line); }
  void info(std::string_view line) { write(LogLevel::info, line); }
  void warning(std::string_view line) { write(LogLevel::warning, line); }
  void error(std::string_view line) { write(LogLevel::error, line); }
};

/// A sink that drops every message.
LogSink& null_log();

/// Passes every line to a function, which must be safe to call from any thread.
class FunctionLog final : public LogSink {
 public:
  using Function = std::function<void(LogLevel, std::string_view)>;
  explicit FunctionLog(Function function) : function_(std::move(function)) {}
  void write(LogLevel level, std::string_view line) override { function_(level, line); }

 private:
  Function function_;
};

}  // namespace gloam
