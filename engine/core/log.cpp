// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/log.h"

namespace gloam {
namespace {

class NullLog final : public LogSink {
 public:
  void write(LogLevel, std::string_view) override {}
};

}  // namespace

LogSink& null_log() {
  static NullLog log;
  return log;
}

}  // namespace gloam
