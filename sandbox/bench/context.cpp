// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/context.h"

#include <utility>

namespace gloam {

Result<Session*> BenchContext::session() {
  if (session_ == nullptr) {
    auto opened = open_session(options_, log_);
    if (!opened) return opened.error();
    session_ = std::move(opened).value();
  }
  return session_.get();
}

gpu::DeviceInfo BenchContext::device_info() const {
  return session_ == nullptr ? gpu::DeviceInfo{} : session_->device->info();
}

}  // namespace gloam
