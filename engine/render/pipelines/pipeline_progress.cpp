// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines/pipeline_progress.h"

namespace gloam {

PipelineProgress::State PipelineProgress::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void PipelineProgress::begin(std::size_t total) {
  const std::lock_guard lock(mutex_);
  state_ = {.name = {}, .done = 0, .total = total};
}

void PipelineProgress::begin_one(const std::string& name) {
  const std::lock_guard lock(mutex_);
  state_.name = name;
}

void PipelineProgress::end_one() {
  const std::lock_guard lock(mutex_);
  if (++state_.done >= state_.total) state_ = {};
}

}  // namespace gloam
