// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/play/display/heat_follower.h"
#include "sandbox/play/display/kept_picture.h"
#include "sandbox/play/display/refinement.h"
#include "sandbox/play/display/resolution_scale.h"
#include "sandbox/play/display/upscaler.h"
#include "sandbox/play/display/window_pictures.h"
#include "sandbox/play/display/window_title.h"
#include "sandbox/play/figures.h"
#include "sandbox/play/input/orbit_controls.h"
#include "sandbox/play/panel.h"
#include "sandbox/play/shader_reload.h"
#include "sandbox/play/start/interrupts.h"
#include "sandbox/play/start/work_beside.h"
#include "sandbox/play/wipe/wipe.h"
#include "sandbox/play/wipe/wipe_line.h"
#include "sandbox/session/session.h"
#include "sandbox/window/fly_camera.h"
#include "sandbox/window/input_script.h"

namespace gloam {

/// Shows a scene in a window, frame by frame.
class Player {
 public:
  /// State that outlives a scene.
  struct Lasting {
    PlayFigures figures;
    double scale = 0.0;  ///< ResolutionScale::setting
    bool panel = false;  ///< the panel is shown
    InputScript script;
    std::function<void()> keep = {};  ///< called when `scale` or `panel` has changed
    const Interrupts* interrupts = nullptr;
  };

  /// The arguments must outlive it. session: with its scene.
  Player(const Options& options, Session& session, WindowPictures& pictures, Lasting& lasting, LogSink& log);

  /// Returns when the user leaves, after --frames, or when another scene is to be shown.
  [[nodiscard]] Status run();
  /// The scene file that was dropped onto the window; empty: none.
  [[nodiscard]] const std::string& next_scene() const { return next_scene_; }

  /// The view at the window's size.
  [[nodiscard]] const ViewSettings& settings() const { return settings_; }
  /// The frames of a run with --stats or --trace.
  [[nodiscard]] const std::vector<FrameSample>& samples() const { return samples_; }

 private:
  [[nodiscard]] PlayControls controls();
  [[nodiscard]] WindowInput poll();
  void play_script();
  void keep_settings();
  [[nodiscard]] Status obey(const WindowInput& input);
  void show_camera(std::uint32_t number);
  void fly_to(const dvec3& position);
  void look_along(const dvec3& direction);
  /// World from the camera that the window shows.
  [[nodiscard]] dmat4 shown_camera() const;
  [[nodiscard]] dvec3 eye() const;
  void pause(bool paused);
  /// The exact side of a wipe takes long, and both sides show one moment, so it pauses the scene.
  void set_wipe(const PanelWipe& wanted);
  void steer_wipe(WindowInput& input);
  /// Notes which pipelines are compiled in the background.
  void note_progress();
  void choose_readiness();
  [[nodiscard]] Status save_screenshot();
  void drop_view_without_its_knob();
  void count_step();
  [[nodiscard]] Status move_camera(const WindowInput& input);
  /// Tells the budget, or else the automatic scale, how long the frame took.
  void adapt_to_time();
  /// Share of the window's width and height that frames are drawn at while something moves.
  [[nodiscard]] double moving_scale() const;
  /// The same of the next frame.
  [[nodiscard]] double scale() const;
  /// Whether the next frame is drawn at the window's size because nothing moves.
  void choose_refinement(const WindowInput& input);
  [[nodiscard]] std::string scale_note() const;
  void reload_shaders();
  [[nodiscard]] Result<bool> draw();
  /// Runs work that may wait for the driver or the GPU on another thread, while the window answers.
  [[nodiscard]] Status run_beside(std::function<Status()> work);
  /// Handles what cannot wait for the frame: full screen, closing, signals. since: begin of the frame.
  void answer(std::chrono::steady_clock::time_point since);
  [[nodiscard]] std::string usual_title() const;
  void leave_at_signal();
  [[noreturn]] void leave(int code);
  [[nodiscard]] bool leaves_results() const;
  /// Whether the scene is drawn in one frame of the device and shown in the next one (show_again): then the renderer
  /// can keep a picture that has not changed, although the panel is drawn over it.
  [[nodiscard]] bool shows_apart() const;
  [[nodiscard]] Result<ViewRequest> request();
  [[nodiscard]] Status show_again();
  [[nodiscard]] Status show_enlarged(FrameGraph& graph, ImageRef picture);
  /// The right side of the wipe, and the panel over it.
  [[nodiscard]] Status add_overlays(FrameGraph& graph, ImageRef& window);
  [[nodiscard]] Status render(const ViewRequest& request);
  [[nodiscard]] Status count_shown(bool first);
  void follow_indirect_light();

  const Options& options_;
  Session& session_;
  WindowPictures& pictures_;
  Lasting& lasting_;
  LogSink& log_;
  ViewSettings settings_;
  ViewFlight flight_;
  OrbitControls orbit_;
  bool on_software_;
  ResolutionScale scale_;
  dmat4 last_camera_ = dmat4(1.0);  ///< shown_camera() of the last frame
  bool camera_moves_ = false;       ///< it was another one than the frame before
  bool kept_ = false;               ///< the renderer has kept the last frame (FrameReport::kept)
  double drawn_scale_ = 0.0;        ///< of the last frame; 0: none yet
  std::uint64_t views_ = 0;         ///< camera cuts so far, for the budget
  Upscaler upscaler_;
  KeptPicture kept_picture_;
  Refinement refinement_;
  std::uint32_t unjudged_ = 0;   ///< frames whose times say nothing about the reduced scale
  std::uint64_t reloads_ = 0;    ///< of shaders
  std::string captured_light_;   ///< lighting.indirect of the world's captures
  PanelInput last_panel_input_;  ///< of the last frame
  bool active_ = false;          ///< the input has changed since then
  WindowTitle title_;
  PlayPanel panel_;
  Wipe wipe_;
  WipeLine wipe_line_;
  bool wipe_paused_ = false;  ///< the wipe has paused the scene
  ShaderReload shaders_;
  std::vector<FrameSample> samples_;
  double time_s_ = 0.0;
  double frame_s_ = 0.0;                 ///< since the last frame
  double step_s_ = 0.0;                  ///< frame_s_, at most kLongestStep; or script_step_s_
  std::optional<double> script_step_s_;  ///< ScriptEvent::Kind::pace
  std::uint64_t last_ns_ = 0;
  bool paused_ = false;
  bool step_once_ = false;
  std::string next_scene_;
  bool shown_ = false;  ///< the last turn showed a picture
  bool whole_ = false;  ///< a picture with all effects was shown
  PanelProgress progress_;
  std::optional<std::chrono::steady_clock::time_point> closed_;  ///< when the user closed the window
  WorkBeside beside_;
  HeatFollower heat_;
};

}  // namespace gloam
