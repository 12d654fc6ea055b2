// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "sandbox/options.h"
#include "sandbox/session.h"

namespace gloam {

/// What benches share. The session is opened by the first bench that asks for it: benches of the CPU never touch Vulkan.
class BenchContext {
 public:
  BenchContext(const Options& options, LogSink& log) : options_(options), log_(log) {}

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] LogSink& log() const { return log_; }
  /// Of the chosen scene and size.
  [[nodiscard]] Result<Session*> session();
  /// Of the session; empty while there is none.
  [[nodiscard]] gpu::DeviceInfo device_info() const;

 private:
  const Options& options_;
  LogSink& log_;
  std::unique_ptr<Session> session_;
};

}  // namespace gloam
