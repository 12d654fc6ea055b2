// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/start/scene_opening.h"

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <utility>

#include "sandbox/session/baking/captures.h"
#include "sandbox/session/baking/particle_light.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

constexpr std::chrono::milliseconds kBetweenPictures(30);

/// Thrown by the progress function of a bake to stop it.
struct Stopped : std::exception {};

/// Runs the steps of loading, and shows them.
class Opening {
 public:
  Opening(Window& window, LoadingScreen& screen) : window_(window), screen_(screen) {}

  /// Handles events and draws the progress bar. Returns whether the user wants to go on.
  [[nodiscard]] bool show() {
    const bool leave = window_.poll().leave || window_.should_close();
    if (leave) window_.hide();
    LoadingStep step;
    {
      const std::lock_guard lock(mutex_);
      step = step_;
    }
    if (!leave && status_.ok()) status_ = screen_.show(step);
    return !leave;
  }

  void tell(LoadingStep step) {
    const std::lock_guard lock(mutex_);
    step_ = std::move(step);
  }

  /// Runs work that draws nothing on another thread. Returns whether the user wants to go on; it waits for the work in
  /// any case.
  [[nodiscard]] Result<bool> run_beside(const char* what, const std::function<Status()>& work) {
    tell({.what = what});
    auto future = std::async(std::launch::async, work);
    bool go_on = true;
    // Work that ends at once needs no picture of its own.
    if (future.wait_for(kBetweenPictures) != std::future_status::ready) {
      go_on = show();
      while (go_on && future.wait_for(kBetweenPictures) != std::future_status::ready) go_on = show();
    }
    GLOAM_TRY(future.get());
    GLOAM_TRY(status_);
    return go_on;
  }

  /// Runs work that draws frames. Its progress function, on this thread, shows the progress.
  [[nodiscard]] Result<bool> run_here(const char* what, const std::function<Status(const BakeProgress&)>& work) {
    try {
      GLOAM_TRY(work([&](std::size_t done, std::size_t total) {
        tell({.what = what, .done = done, .total = total});
        if (!show()) throw Stopped();
      }));
    } catch (const Stopped&) {
      return false;
    }
    GLOAM_TRY(status_);
    return true;
  }

 private:
  Window& window_;
  LoadingScreen& screen_;
  std::mutex mutex_;
  LoadingStep step_;
  Status status_;  ///< of the last picture
};

}  // namespace

Result<bool> open_scene(Session& session, const Options& options, LogSink& log, Window& window, LoadingScreen& screen) {
  Opening opening(window, screen);
  auto go_on = opening.run_beside("loading the scene", [&] { return fill_session(session, options, log); });
  if (!go_on.ok() || !*go_on) return go_on;
  go_on = opening.run_here("capturing reflections", [&](const BakeProgress& progress) {
    return ensure_captures(session, options, log, progress);
  });
  if (!go_on.ok() || !*go_on) return go_on;
  const char* const light = "tracing the light of particles";
  go_on = opening.run_beside(light, [&] {
    return ensure_particle_light(session, options, log, [&](std::size_t done, std::size_t total) {
      opening.tell({.what = light, .done = done, .total = total});
    });
  });
  if (!go_on.ok() || !*go_on) return go_on;
  opening.tell({.what = "compiling pipelines"});
  return opening.show();
}

}  // namespace gloam
