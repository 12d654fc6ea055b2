// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <mutex>

namespace gloam {
namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

class ConsoleSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit ConsoleSink(Console& console) : console_(console) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    console_.print_warning(std::string_view(message.payload.data(), message.payload.size()));
  }
  void flush_() override {}
  Console& console_;
};

class ProgramLog final : public LogSink {
 public:
  explicit ProgramLog(std::vector<spdlog::sink_ptr> sinks) : logger_("gloam", sinks.begin(), sinks.end()) {
    logger_.set_level(spdlog::level::debug);
    logger_.flush_on(spdlog::level::debug);
  }
  void write(LogLevel level, std::string_view line) override {
    logger_.log(level_of(level), spdlog::string_view_t(line.data(), line.size()));
  }

 private:
  spdlog::logger logger_;
};

}  // namespace

Result<std::unique_ptr<LogSink>> make_program_log(Console& console, const LogOptions& options) {
  std::vector<spdlog::sink_ptr> sinks;
  if (!options.quiet) {
    sinks.push_back(std::make_shared<ConsoleSink>(console));
    sinks.back()->set_level(spdlog::level::warn);
  }
  if (!options.file.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(options.file));
    } catch (const spdlog::spdlog_ex& fault) {
      return Error{ErrorKind::failed, options.file + ": the log cannot be written: " + fault.what()};
    }
  }
  return std::unique_ptr<LogSink>(std::make_unique<ProgramLog>(std::move(sinks)));
}

}  // namespace gloam
