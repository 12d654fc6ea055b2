// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A check of a host's own JobExecutor against the rules of the interface, for the host's tests. It needs no test
// framework.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/jobs/executor.h"

namespace gloam {

struct ExecutorCheck {
  /// Repetitions of checks whose outcome may depend on timing, ≥ 1.
  std::uint32_t rounds = 20;
  /// Longest wait for one check. Only a hang reaches it.
  std::chrono::milliseconds hang_limit = std::chrono::seconds(60);
};

/// Runs batches, loops and graphs on the executor, nested, failing and from several threads at once. Returns one
/// sentence for each check that found a broken rule of JobExecutor; empty: none was found. Takes well under a second
/// on an executor without faults.
///
/// Nested calls, calls of several threads and the order of memory accesses are checked only if the checks before found
/// nothing. A missing order shows under ThreadSanitizer. Whether wrong arguments are refused is not checked.
///
/// If a check does not end, the result says so and no further check runs. A thread that uses the executor is then left
/// behind: the process should end without destroying the executor. If there are faults, the memory of the checks is
/// never freed, because jobs of a broken executor may still be running.
[[nodiscard]] std::vector<std::string> executor_faults(JobExecutor& executor, const ExecutorCheck& check = {});

}  // namespace gloam
