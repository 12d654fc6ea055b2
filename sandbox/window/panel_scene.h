// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

inline constexpr std::size_t kNoLight = ~std::size_t{0};

/// A light in the panel.
struct PanelLight {
  std::string name;
  std::string kind;  ///< "spot"
  std::string unit;  ///< of the intensity
  float intensity = 0.0f;
  vec3 color = vec3(1.0f);  ///< linear RGB
  float range_m = 0.0f;     ///< 0: as far as it can be seen
  float width_m = 0.0f;     ///< 0: hard shadows
  bool shadows = true;
  bool has_cookie = false;
  bool cookie = true;
  bool muted = false;
  bool solo = false;
  double share = -1.0;  ///< of the picture's light, 0…1; below 0: not measured
};

/// The lights whose name or kind contains the text, in letters of any case: in the order given, or the largest share
/// first. Indices into `lights`.
[[nodiscard]] std::vector<std::size_t> shown_lights(std::span<const PanelLight> lights, std::string_view search,
                                                    bool by_share);

/// Lines about a picked pixel in the order in which the panel shows them; a single line is a fault and is shown as it
/// is.
struct PickedLines {
  std::vector<std::string> shares;  ///< what each light adds
  std::vector<std::string> surface;
  std::vector<std::string> lists;  ///< tiles, lists and slots: folded away
};
[[nodiscard]] PickedLines sorted_pick_lines(std::span<const std::string> lines);

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
  std::function<void(std::size_t light, const PanelLight& values)> set_light;  ///< name, kind and share do not count
  std::function<void(std::size_t light)> locate;                               ///< flies the camera to it
  std::function<void(std::size_t light)> select;  ///< the light whose marks are in the picture; kNoLight: none
  std::function<void()> measure_shares;
  std::function<void()> save_lights;  ///< writes the changes to a file for --lights

  std::span<const std::string> picked;  ///< lines about the pixel that was clicked last
  std::uint64_t pick = 0;               ///< number of that click; another one brings its lines into view

  std::function<void()> save_config;   ///< writes the knobs to a file for --config
  std::function<void()> copy_command;  ///< puts the command line of this picture on the clipboard
  std::string said;                    ///< result of the last of these and of save_lights; empty: none
};

}  // namespace gloam
