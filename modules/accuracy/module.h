// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/reference/reference.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/accuracy/outputs.h"

// Measures what accuracy costs. Not an effect: it draws nothing of its own, it has others draw and judges what they
// drew.

namespace gloam {

/// What the systems and passes of one module took in a frame.
struct ModuleCost {
  std::string module;
  double cpu_ms = 0.0;  ///< summed over threads
  double gpu_ms = 0.0;
};

/// What one frame took.
struct FrameCost {
  double cpu_ms = 0.0;
  double gpu_ms = 0.0;
  std::vector<ModuleCost> modules;  ///< those that had systems or passes
  [[nodiscard]] double ms() const { return cpu_ms + gpu_ms; }
  /// Nothing, for a module that took no part.
  [[nodiscard]] ModuleCost of(std::string_view module) const {
    for (const ModuleCost& cost : modules)
      if (cost.module == module) return cost;
    return {.module = std::string(module)};
  }
};

/// The frames that are measured: a scene, a camera and a device behind an interface.
class CostSubject {
 public:
  virtual ~CostSubject() = default;

  /// The knobs that the next frame is drawn with.
  [[nodiscard]] virtual KnobRegistry& knobs() = 0;
  /// References of all modules.
  [[nodiscard]] virtual std::vector<ReferenceInfo> references() const = 0;
  /// Measures of all modules.
  [[nodiscard]] virtual std::vector<MeasureInfo> measures() const = 0;
  /// Draws frame `index` (from 0) of the measured sequence and waits for it. The same index shows the same moment.
  [[nodiscard]] virtual Result<FrameCost> draw(std::uint32_t index) = 0;
  /// Memory of all modules that frames like the last one need, and none that others left behind. May draw.
  [[nodiscard]] virtual Result<std::uint64_t> gpu_bytes() = 0;
  /// What the last frame counted.
  [[nodiscard]] virtual FrameCounters counters() = 0;
  /// What the last frame looks like, both sides.
  [[nodiscard]] virtual Result<FramePictures> read() = 0;
  /// Calls reference.draw for the last frame, which is `frame`.
  [[nodiscard]] virtual Result<FramePictures> draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                             std::uint32_t samples) = 0;
};

/// Told what goes on, for progress bars. Counts are of rows.
class CostProgress {
 public:
  virtual ~CostProgress() = default;
  virtual void measuring(const std::string& knob, const std::string& value, std::size_t done, std::size_t total) = 0;
  /// resumed: found in the folder, nothing was drawn.
  virtual void finished(const LedgerRow& row, bool resumed) = 0;
};

struct CostRequest {
  LedgerHeader header;     ///< frames and samples are heeded, the rest is told and part of what a row is stored under
  std::string conditions;  ///< what else changes a frame (seed, animation, view), one line
  std::vector<std::string> knobs;  ///< names of knobs that exist, in the order of the ledger
  std::vector<SkippedKnob> skipped;
  std::uint32_t sequence = 1;  ///< frames that the temporal error is looked for in; 1: none
  std::string folder;          ///< finished rows and references are kept below it
};

inline constexpr std::uint32_t kLedgerFrames = 20;    ///< timed frames of a value
inline constexpr std::uint32_t kLedgerSamples = 256;  ///< of references that sample
inline constexpr std::uint32_t kQuickFrames = 5;
inline constexpr std::uint32_t kQuickSamples = 64;
inline constexpr std::uint32_t kQuickWidth = 320;
inline constexpr std::uint32_t kQuickHeight = 180;

/// The knobs of a comma-separated list; all when it is empty. Usage error that lists the valid ones.
[[nodiscard]] Result<std::vector<std::string>> choose_knobs(const KnobRegistry& knobs, std::string_view list);

/// Texts of the values that get a row, in order, each once: Knob::ledger_values or all choices, the default and the
/// exact one among them.
[[nodiscard]] std::vector<std::string> ledger_values(const Knob& knob);

/// Measures every value of every knob of the request: its picture against the knob's reference (what it counts, where
/// the knob has a measure of its own), its time alternating with the default's. Rows that an earlier run finished are
/// not measured again. Knobs are left as they were.
[[nodiscard]] Result<Ledger> measure_costs(const CostRequest& request, CostSubject& subject, CostProgress& progress);

/// The triangles of a world as its systems left them, for rays. They are copied: the world may move on. origin: the
/// world position that rays are relative to, best where they begin; none: the middle of the scene.
[[nodiscard]] Result<std::unique_ptr<SceneTracer>> make_scene_tracer(const World& world, JobExecutor& executor,
                                                                     const std::optional<dvec3>& origin = {});

/// Keeps what references ask to keep in files below a folder.
[[nodiscard]] std::unique_ptr<ReferenceStore> make_reference_store(std::string folder);

}  // namespace gloam
