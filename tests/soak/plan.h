// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The random schedule of a soak: a tour of all scenes and settings, then cycles, which are equally long and begin and
// end in the base state.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gloam::soak {

struct ShownView {
  bool drawn = true;
  std::uint32_t width = 64;
  std::uint32_t height = 36;
  std::uint32_t camera = 0;          ///< modulo the number of the scene's cameras
  double turn = 0.0;                 ///< of the camera about its upward axis, radians
  std::vector<std::string> without;  ///< ViewSettings::without
};

/// A state of the host that can be reached from any other and from a fresh process: everything that a picture depends
/// on once simulations and histories have begun anew.
struct State {
  std::string scene = "dusk";
  std::array<ShownView, 2> views = {ShownView{}, ShownView{.drawn = false}};
  std::map<std::string, std::string> knobs;  ///< those that are not at their default
  /// Streamed meshes and lamps. The number says what each is.
  std::vector<std::uint32_t> meshes, lamps;
};

/// A change and the frames that are drawn after it.
struct Step {
  std::string change;
  State state;  ///< after the change
  std::uint32_t frames = 1;
  bool cuts = false;        ///< the frames begin with a camera cut
  bool has_budget = false;  ///< a time budget moves knobs during the frames
  bool is_base = false;     ///< the state is the base state: the last step of a cycle
};

class Plan {
 public:
  /// brief: cycles that fit a test of seconds, with few scenes.
  Plan(std::uint32_t seed, bool brief) : seed_(seed), brief_(brief) {}
  /// Steps before the first cycle: every scene with every setting, and then the base state. After them the renderer's
  /// lists are as long as they will be, and the driver has compiled what it will.
  [[nodiscard]] std::vector<Step> tour() const;
  /// The steps of a cycle.
  [[nodiscard]] std::vector<Step> cycle(std::uint32_t number) const;
  /// Frames of a cycle, without those in which a state settles.
  [[nodiscard]] std::uint32_t frames_of_a_cycle() const { return brief_ ? 24 : 500; }

 private:
  std::uint32_t seed_;
  bool brief_;
};

/// All knobs that states and budgets set.
[[nodiscard]] const std::vector<std::string>& planned_knobs();

}  // namespace gloam::soak
