// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace gloam {

/// A light in the panel.
struct PanelLight {
  std::string name;
  std::string kind;  ///< "spot"
  std::string unit;  ///< of the intensity
  float intensity = 0.0f;
  bool muted = false;
  bool solo = false;
};

/// Facts about the scene that the panel shows, and functions that carry out the user's changes. All functions are set.
struct PanelScene {
  std::span<const std::string> cameras;
  std::uint32_t camera = 0;  ///< the number of the one that is shown, from 1 on; 0: none of them
  std::function<void(std::uint32_t number)> show_camera;  ///< from 1 on

  std::span<const std::string> warnings = {};  ///< Module::warnings() of all modules for the scene as it was opened

  double time_s = 0.0;
  bool paused = false;
  std::function<void(bool paused)> pause;

  bool automatic_exposure = true;
  float ev100 = 0.0f;  ///< of an automatic exposure: the metered value, from which one that is set by hand starts
  std::function<void(bool automatic, float ev100)> set_exposure;

  bool has_camera = false;  ///< the view's camera can have a lens
  float focus_m = 0.0f;     ///< 0: no depth of field
  float f_number = 2.8f;
  float picked_m = 0.0f;  ///< view depth of the pixel that was clicked last; 0: none, or the sky
  std::function<void(float focus_m, float f_number)> set_lens;

  std::span<const PanelLight> lights;
  std::function<void(std::size_t light, float intensity)> set_intensity;
  std::function<void(std::size_t light, bool muted)> mute;
  std::function<void(std::size_t light, bool solo)> solo;

  std::span<const std::string> picked;  ///< lines about the pixel that was clicked last

  std::function<void()> save_config;   ///< writes the knobs to a file for --config
  std::function<void()> copy_command;  ///< puts the command line of this picture on the clipboard
  std::string said;                    ///< result of the last of the two; empty: none
};

}  // namespace gloam
