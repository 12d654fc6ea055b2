// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/zones.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/renderer.h"

/// The panel's data and changes to it, independent of ImGui.
namespace gloam {

enum class KnobWidget { combo, integer_slider, number_slider };
[[nodiscard]] KnobWidget widget_of(const Knob& knob);

/// Whether the knob's slider should be logarithmic: min > 0 and max ≥ 100 · min.
[[nodiscard]] bool spans_magnitudes(const Knob& knob);

/// A printf format for the knob's number followed by its unit. It takes a long long for an integer knob, otherwise a
/// double.
[[nodiscard]] std::string slider_format(const Knob& knob);

/// Name and meaning, range or choices, default and exact value, one per line.
[[nodiscard]] std::string knob_tooltip(const Knob& knob);

/// The current value as a number; for a choice, its index.
[[nodiscard]] double knob_value(const KnobRegistry& registry, const Knob& knob);

/// Sets a declared knob to the valid value nearest to `value`.
void set_knob_value(KnobRegistry& registry, const Knob& knob, double value);
void reset_knob(KnobRegistry& registry, const Knob& knob);
[[nodiscard]] bool is_default(const KnobRegistry& registry, const Knob& knob);

/// The knobs of a module that match a search.
struct KnobGroup {
  std::string module;
  std::vector<const Knob*> knobs;  ///< not empty; valid as long as the registry
  std::size_t changed = 0;         ///< of them, those that are not at their defaults
};
/// Modules in the order of their first knobs; all knobs of a module are in one group.
[[nodiscard]] std::vector<KnobGroup> knob_groups(const KnobRegistry& registry, std::string_view search);

/// Whether a knob's name or meaning contains the text, in letters of any case. An empty text is in all of them.
[[nodiscard]] bool matches(const Knob& knob, std::string_view search);

/// The knobs that are not at their defaults, as a file for --config.
[[nodiscard]] std::string config_text(const KnobRegistry& registry);
/// The same as " --set NAME=VALUE …".
[[nodiscard]] std::string assignments_text(const KnobRegistry& registry);

/// Two kept settings of all knobs, to compare them in turn.
class KnobSlots {
 public:
  static constexpr std::size_t kSlots = 2;
  void keep(const KnobRegistry& registry, std::size_t slot);
  [[nodiscard]] bool has(std::size_t slot) const { return !slots_[slot].empty(); }
  /// The value of each knob; empty if nothing was kept.
  [[nodiscard]] std::vector<KnobOverride> kept(std::size_t slot) const;
  /// Sets the knobs to what was kept.
  void show(KnobRegistry& registry, std::size_t slot) const;

 private:
  std::array<std::map<std::string, std::string>, kSlots> slots_;  ///< name → value
};

/// "42 %", or "auto (42 %)" if the setting is 0. scale: of the last frame.
[[nodiscard]] std::string scale_text(double setting, double scale);

/// The views of a module that the scene does not call for.
struct IdleViews {
  std::string module;
  std::string reason;  ///< why it is not called for
  std::vector<const VisualizerInfo*> views;
};
/// All views: those of modules that the scene calls for, in the order given, and the others by module. Traced ones take
/// too long for a window.
struct ViewGroups {
  std::vector<const VisualizerInfo*> called_for;
  std::vector<IdleViews> others;
  std::vector<const VisualizerInfo*> traced;
};
/// A module that `modules` does not name counts as called for. The result points into `views`.
[[nodiscard]] ViewGroups view_groups(std::span<const VisualizerInfo> views, std::span<const ModuleState> modules);

/// Time of a system in a frame, all its calls added.
struct SystemTime {
  std::string name;
  std::string module;
  double ms = 0.0;
};

/// Medians of the times of the last frames, which are steady enough to read.
class FrameTimes {
 public:
  static constexpr std::size_t kFrames = 60;

  /// Adds a frame. frame_ms: from the start of the last frame to the start of this one.
  void add(double frame_ms, const FrameReport& report);

  /// Adds the zones of a frame.
  void add_systems(std::span<const Zone> zones);

  [[nodiscard]] double frame_ms() const;
  /// The last frames, newest last, kFrames at most.
  [[nodiscard]] std::span<const double> frame_history() const { return frame_ms_; }
  /// The newest frame's systems, the longest first. ms: median over the consecutive frames that had the system.
  [[nodiscard]] const std::vector<SystemTime>& systems() const { return systems_; }
  [[nodiscard]] double cpu_ms() const;
  [[nodiscard]] double gpu_ms() const;  ///< 0 until the GPU has completed a frame
  /// The newest frame's passes. ms: median over the consecutive frames, up to kFrames, that had the pass.
  [[nodiscard]] const std::vector<PassTime>& passes() const { return passes_; }

 private:
  using History = std::vector<double>;  ///< newest last, kFrames at most

  History frame_ms_;
  History cpu_ms_;
  History gpu_ms_;
  /// Key: the pass's name, and the number of passes of that name before it in its frame.
  std::map<std::pair<std::string, std::size_t>, History> pass_ms_;
  std::vector<PassTime> passes_;
  std::map<std::pair<std::string, std::string>, History> system_ms_;  ///< key: module, name
  std::vector<SystemTime> systems_;
};

}  // namespace gloam
