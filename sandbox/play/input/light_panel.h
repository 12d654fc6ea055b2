// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/view.h"
#include "sandbox/play/input/light_controls.h"
#include "sandbox/play/input/light_gizmo.h"
#include "sandbox/session/session.h"
#include "sandbox/window/panel_mark.h"
#include "sandbox/window/panel_scene.h"
#include "sandbox/window/window.h"

namespace gloam {

/// The lights of the panel: their list, their marks in the picture, and their file.
class LightPanel {
 public:
  /// The session must outlive it.
  explicit LightPanel(Session& session) : session_(session), controls_(session.world) {}

  [[nodiscard]] LightControls& controls() { return controls_; }

  /// Sets the members of `scene` that are about lights, except `locate`. They are valid until the next call. view: of
  /// the last frame.
  void fill(PanelScene& scene, const ViewSettings& view);
  /// Moves and aims the selected light with the pointer. Returns whether it uses the pointer.
  bool steer(const WindowInput& input, const ViewSettings& view, bool pointer_is_free);
  [[nodiscard]] bool drags() const { return gizmo_.drags(); }
  /// The selected light's gizmo, and a circle at each light that is solo.
  [[nodiscard]] std::vector<PanelMark> marks(const ViewSettings& view) const;
  /// Writes the changes for --lights. Returns a sentence for the user.
  [[nodiscard]] std::string save(const std::string& path);
  [[nodiscard]] bool unsaved() const { return controls_.patch() != saved_; }

 private:
  void set(std::size_t light, const PanelLight& values);
  void measure_shares(ViewId view);

  Session& session_;
  LightControls controls_;
  LightGizmo gizmo_;
  LightPatch saved_;
  std::vector<PanelLight> shown_;
  std::vector<double> shares_;  ///< by light; empty: not measured
  std::size_t selected_ = kNoLight;
};

}  // namespace gloam
