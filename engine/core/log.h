// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace gloam {

enum class LogLevel { debug, info, warning, error };

/// Where messages go; a host passes its own. Called from any thread, one whole line (without its line break) a call.
class LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void write(LogLevel level, std::string_view line) = 0;

  void debug(std::string_view line) { write(LogLevel::debug, line); }
  void info(std::string_view line) { write(LogLevel::info, line); }
  void warning(std::string_view line) { write(LogLevel::warning, line); }
  void error(std::string_view line) { write(LogLevel::error, line); }
};

/// Drops everything.
LogSink& null_log();

/// Hands every line to a function; the function must be safe to call from any thread.
class FunctionLog final : public LogSink {
 public:
  using Function = std::function<void(LogLevel, std::string_view)>;
  explicit FunctionLog(Function function) : function_(std::move(function)) {}
  void write(LogLevel level, std::string_view line) override { function_(level, line); }

 private:
  Function function_;
};

}  // namespace gloam
