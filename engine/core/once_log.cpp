// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/once_log.h"

namespace gloam {

bool OnceLog::warning(LogSink& log, std::string_view key, std::string_view sentence) {
  {
    const std::lock_guard lock(mutex_);
    if (logged_.contains(key)) return false;
    logged_.emplace(key);
  }
  log.warning(sentence);
  return true;
}

}  // namespace gloam
