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
  /// The same with the part of gloam that writes: "gpu", "validation", "scene", "render", or the name of a module.
  /// gloam always calls this one; a sink that does not override it gets the line in write(). A host filters by category
  /// here.
  virtual void write_from(std::string_view /*category*/, LogLevel level, std::string_view line) { write(level, line); }

  void debug(std::string_view line) { write(LogLevel::debug, line); }
  void info(std::string_view line) { write(LogLevel::info, line); }
  void warning(std::string_view line) { write(LogLevel::warning, line); }
  void error(std::string_view line) { write(LogLevel::error, line); }
};

/// A sink that drops every message.
LogSink& null_log();

/// Passes every line on to another sink, with a category.
class LogCategory final : public LogSink {
 public:
  /// sink: must outlive this object.
  LogCategory(LogSink& sink, std::string_view category) : sink_(&sink), category_(category) {}
  void write(LogLevel level, std::string_view line) override { sink_->write_from(category_, level, line); }
  /// A line that has a category keeps it.
  void write_from(std::string_view category, LogLevel level, std::string_view line) override {
    sink_->write_from(category, level, line);
  }

 private:
  LogSink* sink_;
  std::string category_;
};

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
