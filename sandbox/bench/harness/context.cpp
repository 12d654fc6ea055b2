// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/context.h"

#include <utility>

#include "sandbox/session/baking/captures.h"

namespace gloam {

Result<Session*> BenchContext::session() { return session_or(options_.scene); }

const std::string& BenchContext::scene_or(const std::string& scene) const {
  return options_.scene_is_default ? scene : options_.scene;
}

Result<Session*> BenchContext::session_or(const std::string& scene) {
  Options options = options_;
  options.scene = scene_or(scene);
  std::unique_ptr<Session>& session = sessions_[options.scene];
  if (session == nullptr) {
    auto opened = open_session(options, log_);
    if (!opened) return opened.error();
    GLOAM_TRY(ensure_baked(**opened, options, log_));
    session = std::move(opened).value();
    device_info_ = session->device->info();
  }
  return session.get();
}

Result<std::unique_ptr<Session>> BenchContext::open_builtin(const std::string& scene, ModuleList more_modules) {
  Options options = options_;
  options.scene = scene;
  options.camera.clear();
  options.animation.clear();
  return open(options, std::move(more_modules));
}

Result<std::unique_ptr<Session>> BenchContext::open_chosen(const std::string& scene) {
  if (options_.scene_is_default || scene != options_.scene) return open_builtin(scene);
  return open(options_, {});
}

Result<std::unique_ptr<Session>> BenchContext::open(const Options& options, ModuleList more_modules) {
  auto opened = open_session(options, log_, {}, std::move(more_modules));
  if (!opened) return opened.error();
  GLOAM_TRY(ensure_baked(**opened, options, log_));
  device_info_ = opened.value()->device->info();
  return std::move(opened).value();
}

}  // namespace gloam
