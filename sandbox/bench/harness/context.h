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

/// State that benches share. A session is opened when a bench first asks for it, so CPU benches never use Vulkan.
class BenchContext {
 public:
  BenchContext(const Options& options, LogSink& log) : options_(options), log_(log) {}

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] LogSink& log() const { return log_; }
  /// The shared session of the chosen scene and size.
  [[nodiscard]] Result<Session*> session();
  /// Opens a separate session of a scene ("builtin:NAME" or a file) with its first camera, independent of the user's
  /// choice. The caller owns it and may change it. more_modules: added after the program's own modules.
  [[nodiscard]] Result<std::unique_ptr<Session>> open_builtin(const std::string& scene, ModuleList more_modules = {});
  /// The same with the user's camera and animation if `scene` is the scene that the user named.
  [[nodiscard]] Result<std::unique_ptr<Session>> open_chosen(const std::string& scene);
  /// The scene that the user named, or `scene` if the user named none.
  [[nodiscard]] const std::string& scene_or(const std::string& scene) const;
  /// The shared session of scene_or(scene).
  [[nodiscard]] Result<Session*> session_or(const std::string& scene);
  /// Device of the sessions; empty before the first one is opened.
  [[nodiscard]] const gpu::DeviceInfo& device_info() const { return device_info_; }

 private:
  [[nodiscard]] Result<std::unique_ptr<Session>> open(const Options& options, ModuleList more_modules);

  const Options& options_;
  LogSink& log_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< by scene
  gpu::DeviceInfo device_info_;
};

}  // namespace gloam
