// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/job_list.h"

namespace gloam {

void JobList::run(JobExecutor& executor) {
  assert_not_running();
  if (jobs_.empty()) return;
  struct EmptyAtEnd {
    explicit EmptyAtEnd(JobList& running) : list(running) { list.running_ = true; }
    ~EmptyAtEnd() {
      list.running_ = false;
      list.clear();
    }
    JobList& list;
  };
  const EmptyAtEnd empty_at_end(*this);
  run_all_(executor, jobs_);
}

void JobList::clear() {
  assert_not_running();
  for (const Call& destructor : destructors_) destructor.function(destructor.state);
  destructors_.clear();
  jobs_.clear();
  states_.reset();
}

}  // namespace gloam
