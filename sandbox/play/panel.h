// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/renderer.h"
#include "sandbox/play/budget/budget_controls.h"
#include "sandbox/play/display/resolution_scale.h"
#include "sandbox/play/input/light_panel.h"
#include "sandbox/session/session.h"
#include "sandbox/window/panel.h"
#include "sandbox/window/panel_renderer.h"
#include "sandbox/window/undo_stack.h"
#include "sandbox/window/window.h"

namespace gloam {

/// Facts about the run that the panel shows, and functions that change it. Functions that are not set are not offered:
/// then the panel has no section for the scene.
struct PlayControls {
  std::string scene;    ///< path or "builtin:NAME"
  double time_s = 0.0;  ///< of the next frame
  bool paused = false;
  std::function<void(bool paused)> pause = {};
  std::function<void(std::uint32_t number)> show_camera = {};  ///< from 1 on
  std::function<void(const std::string& text)> copy = {};      ///< to the clipboard
  double drawn_scale = 0.0;     ///< of the last frame; 0: there was none, or the chosen scale
  std::string scale_note = {};  ///< PanelContent::scale_note
  std::function<void(const dvec3& position)> fly_to = {};       ///< flies the camera near a position
  std::function<void(const dvec3& direction)> look_along = {};  ///< turns it
  PanelWipe wipe = {};
  std::function<void(const PanelWipe&)> set_wipe = {};
  PanelProgress progress = {};
};

/// The panel of `play`: shows and hides it, and connects it with the session. Panel and renderer are created when it is
/// first shown.
class PlayPanel {
 public:
  /// The session must outlive it. scale: factor on the size of text; 1 for a standard display.
  PlayPanel(Session& session, double scale, bool shown);

  /// Call it before each frame. frame: the window's size in pixels and the time step. Updates the panel, applies the
  /// user's changes to knobs, view and scale, and removes the input that the panel used from `input`.
  [[nodiscard]] Status update(WindowInput& input, const PanelFrame& frame, ViewSettings& view, ResolutionScale& scale,
                              const PlayControls& controls = {});
  /// The zones of a frame, for its systems' times.
  void add_systems(std::span<const Zone> zones) { times_.add_systems(zones); }

  /// Shows a message at the top of the panel until the next one. urgent: also shows the panel if it is hidden.
  void tell(std::string message, bool urgent);

  /// Whether the user, who asks to leave, may: not the first time after knobs were changed in the panel and not saved.
  /// Then a message says so.
  [[nodiscard]] bool may_leave(const std::string& scene);
  /// Writes knobs that were changed in the panel and not saved to out/<scene>.unsaved.config.json.
  void keep_changes(const std::string& scene, LogSink& log);

  [[nodiscard]] bool shown() const { return shown_; }
  /// Whether the panel or the gizmo of a light uses the pointer.
  [[nodiscard]] bool uses_pointer() const { return drawn_ && (panel_->wants_mouse() || lights_.drags()); }
  /// Changes the factor on the size of text.
  void set_scale(double scale);
  /// The middle of a widget in the last update, in pixels (Panel::widgets); none if it was not shown.
  [[nodiscard]] std::optional<vec2> widget(std::string_view name) const;

  /// The function for ViewTarget::overlay in the frame after an update; empty while the panel is hidden.
  [[nodiscard]] std::function<Status(FrameGraph&, ImageRef&)> overlay();

 private:
  [[nodiscard]] Status open();
  void show(WindowInput& input, const PanelFrame& frame, PanelContent& content, const PlayControls& controls,
            const ViewSettings& view);
  void undo(const PanelInput& input);
  void locate(std::size_t light, const PlayControls& controls);
  [[nodiscard]] std::vector<PanelMark> marks(const ViewSettings& view) const;
  [[nodiscard]] PanelScene scene_of(const PlayControls& controls, const ViewSettings& view);
  void pick(const WindowInput& input, const ViewSettings& view, double scale);
  /// The exposure that the newest finished frame has metered.
  [[nodiscard]] float metered_ev100() const;
  void set_exposure(bool automatic, float ev100);
  void set_lens(float focus_m, float f_number);
  void save_config(const std::string& scene);
  [[nodiscard]] Status write_config(const std::string& path) const;
  [[nodiscard]] std::string command_line(const PlayControls& controls, const ViewSettings& view) const;

  Session& session_;
  double scale_;
  bool shown_;
  bool drawn_ = false;  ///< shown by the last update
  FrameTimes times_;
  BudgetControls budgets_;
  LightPanel lights_;
  UndoStack undo_;
  bool undo_keys_down_ = false;
  std::vector<std::string> cameras_;
  std::vector<std::string> warnings_;  ///< PanelScene::warnings
  std::vector<std::string> picked_;
  std::uint64_t pick_ = 0;                     ///< PanelScene::pick
  float picked_m_ = 0.0f;                      ///< PanelScene::picked_m
  glm::dvec2 picked_place_ = glm::dvec2(0.0);  ///< in the window
  std::optional<dvec3> picked_position_;
  std::string said_;
  bool unsaved_ = false;         ///< knobs were changed in the panel since they were saved
  bool asked_to_leave_ = false;  ///< since then
  PanelNotice notice_;
  std::vector<VisualizerInfo> visualizers_;
  std::unique_ptr<Panel> panel_;
  std::unique_ptr<PanelRenderer> renderer_;
};

}  // namespace gloam
