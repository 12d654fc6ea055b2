// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "engine/jobs/executor.h"
#include "tests/embedding/host/thread_executor.h"

namespace gloam::test {

struct ExecutorCase {
  std::string name;
  std::function<std::unique_ptr<JobExecutor>()> make;
};

inline void PrintTo(const ExecutorCase& c, std::ostream* out) { *out << c.name; }

/// One executor of each kind, including one that a host implements. The pool with 8 threads has more threads than most
/// test machines have cores.
inline std::vector<ExecutorCase> all_executors() {
  std::vector<ExecutorCase> cases{{"serial", [] { return make_serial_executor(); }},
                                  {"shuffled", [] { return make_shuffled_executor(7); }}};
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    cases.push_back({"pool_" + std::to_string(threads), [threads] { return make_pool_executor(threads); }});
  }
  cases.push_back({"host_threads", [] { return std::make_unique<host::ThreadExecutor>(3); }});
  return cases;
}

}  // namespace gloam::test
