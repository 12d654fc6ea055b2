// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/knobs/knobs.h"
#include "engine/render/renderer.h"

/// What the panel shows and changes, free of how it draws.
namespace gloam {

enum class KnobWidget { combo, integer_slider, number_slider };
[[nodiscard]] KnobWidget widget_of(const Knob& knob);

/// Whether a slider over the knob's range should move in factors rather than in steps.
[[nodiscard]] bool spans_magnitudes(const Knob& knob);

/// A printf format for the knob's number with its unit behind it: an integer slider's takes a long long, others a
/// double.
[[nodiscard]] std::string slider_format(const Knob& knob);

/// Meaning, range or choices, default and most exact value, one a line.
[[nodiscard]] std::string knob_tooltip(const Knob& knob);

/// The current value as a number; of a choice its index.
[[nodiscard]] double knob_value(const KnobRegistry& registry, const Knob& knob);

/// Sets a declared knob to the value nearest to `value` that it can have.
void set_knob_value(KnobRegistry& registry, const Knob& knob, double value);
void reset_knob(KnobRegistry& registry, const Knob& knob);
[[nodiscard]] bool is_default(const KnobRegistry& registry, const Knob& knob);

/// Times of the last frames: medians hold still while one reads them.
class FrameTimes {
 public:
  static constexpr std::size_t kFrames = 60;

  /// frame_ms: from the start of the last frame to this one's.
  void add(double frame_ms, const FrameReport& report);

  [[nodiscard]] double frame_ms() const;
  [[nodiscard]] double cpu_ms() const;
  [[nodiscard]] double gpu_ms() const;  ///< 0 until a frame has completed
  /// The newest frame's passes; `ms` are medians over the frames in a row that had them.
  [[nodiscard]] const std::vector<PassTime>& passes() const { return passes_; }

 private:
  using History = std::vector<double>;  ///< newest last, kFrames at most

  History frame_ms_;
  History cpu_ms_;
  History gpu_ms_;
  /// By name and how many of that name came before it in its frame.
  std::map<std::pair<std::string, std::size_t>, History> pass_ms_;
  std::vector<PassTime> passes_;
};

}  // namespace gloam
