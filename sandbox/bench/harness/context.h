// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// What benches share. Sessions are opened by the first bench that asks for them: benches of the CPU never touch
/// Vulkan.
class BenchContext {
 public:
  BenchContext(const Options& options, LogSink& log) : options_(options), log_(log) {}

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] LogSink& log() const { return log_; }
  /// Of the chosen scene and size.
  [[nodiscard]] Result<Session*> session();
  /// Of a scene made by code ("builtin:NAME") whatever was chosen, with its first camera; one that is the caller's to
  /// change. more_modules: behind the program's own.
  [[nodiscard]] Result<std::unique_ptr<Session>> open_builtin(const std::string& scene, ModuleList more_modules = {});
  /// The scene the user named, or `scene` if he named none.
  [[nodiscard]] const std::string& scene_or(const std::string& scene) const;
  /// Of scene_or(scene).
  [[nodiscard]] Result<Session*> session_or(const std::string& scene);
  /// Of the sessions; empty while there is none.
  [[nodiscard]] const gpu::DeviceInfo& device_info() const { return device_info_; }

 private:
  const Options& options_;
  LogSink& log_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< by scene
  gpu::DeviceInfo device_info_;
};

}  // namespace gloam
