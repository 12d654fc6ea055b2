// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "engine/core/log.h"

namespace gloam {

/// Logs each warning once, for code that meets the same fault in every frame. Remembers the keys for as long as it
/// lives. May be called from any thread; of several calls with the same key exactly one logs. It holds no lock while it
/// logs, so a sink may call it.
class OnceLog {
 public:
  /// Logs `sentence` as a warning if no earlier call had the same `key`. For sentences with numbers that change from
  /// frame to frame. Returns whether it has logged.
  bool warning(LogSink& log, std::string_view key, std::string_view sentence);
  /// The same with the sentence as its key.
  bool warning(LogSink& log, std::string_view sentence) { return warning(log, sentence, sentence); }

 private:
  std::mutex mutex_;
  std::set<std::string, std::less<>> logged_;  ///< keys
};

}  // namespace gloam
