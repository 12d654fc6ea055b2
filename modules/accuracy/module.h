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

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/reference/reference.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/accuracy/outputs.h"

// Measures error and time of knob values for the cost ledger. It draws nothing itself: a CostSubject draws the frames.

namespace gloam {

/// Time of one module's systems and passes in a frame.
struct ModuleCost {
  std::string module;
  double cpu_ms = 0.0;  ///< summed over threads
  double gpu_ms = 0.0;
  bool operator==(const ModuleCost&) const = default;
};

/// Time of one frame.
struct FrameCost {
  double cpu_ms = 0.0;
  double gpu_ms = 0.0;
  /// Only of a device that is a processor: processor time of the process over the frame, divided by the cores.
  double processor_ms = 0.0;
  std::vector<ModuleCost> modules;  ///< modules with systems or passes in the frame
  [[nodiscard]] double wall_ms() const { return cpu_ms + gpu_ms; }
  /// By the ledger's clock.
  [[nodiscard]] double ms() const { return processor_ms > 0.0 ? processor_ms : wall_ms(); }
  bool operator==(const FrameCost&) const = default;
  /// The cost of a module; all 0 if it took no part.
  [[nodiscard]] ModuleCost of(std::string_view module) const {
    for (const ModuleCost& cost : modules)
      if (cost.module == module) return cost;
    return {.module = std::string(module)};
  }
};

/// Interface to the measured frames: a scene, a camera and a device.
class CostSubject {
 public:
  virtual ~CostSubject() = default;

  /// The knobs for the next frame.
  [[nodiscard]] virtual KnobRegistry& knobs() = 0;
  /// References of all modules.
  [[nodiscard]] virtual std::vector<ReferenceInfo> references() const = 0;
  /// Measures of all modules.
  [[nodiscard]] virtual std::vector<MeasureInfo> measures() const = 0;
  /// Draws frame `index` of the measured sequence and waits for it. The sequence begins with 0; frames before it have a
  /// negative index. The same index shows the same moment.
  [[nodiscard]] virtual Result<FrameCost> draw(std::int32_t index) = 0;
  /// Frames at the moment of the last one until the picture is complete: more than 0 with settings that accumulate
  /// pictures.
  [[nodiscard]] virtual std::uint32_t frames_to_rest() { return 0; }
  /// Called once, with the user's settings, before memory is asked for: frees what only earlier frames needed, such as
  /// the first ones and those with exact values. May draw frames for that.
  [[nodiscard]] virtual Status settle_memory() { return {}; }
  /// GPU memory, in bytes over all modules, that frames with the current knobs need. Memory left over from other frames
  /// does not count. May draw frames to find out: those that follow the last one.
  [[nodiscard]] virtual Result<std::uint64_t> gpu_bytes() = 0;
  /// The counters of the last frame.
  [[nodiscard]] virtual FrameCounters counters() = 0;
  /// Reads the pictures of the last frame: linear light and final picture.
  [[nodiscard]] virtual Result<FramePictures> read() = 0;
  /// Calls reference.draw for the last frame. `frame`: the pictures of that frame, from read().
  [[nodiscard]] virtual Result<FramePictures> draw_reference(const ReferenceInfo& reference, const FramePictures& frame,
                                                             std::uint32_t samples) = 0;
  /// Calls reference.distance for the last frame.
  [[nodiscard]] virtual Result<std::optional<MovedDistance>> measure_distance(const ReferenceInfo& reference,
                                                                              std::uint32_t samples) = 0;
  /// Why the knob changes nothing in the last frame, in a few words; empty: it is not known, or it may change
  /// something.
  [[nodiscard]] virtual std::string no_effect_reason(const Knob& knob) = 0;
};

/// A row that is to be measured, for an estimate of the time left.
struct PlannedRow {
  std::string knob;
  std::string value;
  bool is_default = false;      ///< is drawn, but not timed
  bool from_reference = false;  ///< has a reference of its module, which may take long
};

/// Kinds of work that measuring consists of.
enum class CostPhase {
  start,       ///< frames before the first row, until memory has settled
  pictures,    ///< frames that are read
  exact,       ///< frames with exact values, of one knob or of all
  references,  ///< references and distances that modules compute
  comparison,  ///< errors of pictures, files of pictures
  timing,      ///< pairs of frames
  memory,      ///< frames that show what memory a value needs
  other        ///< between rows
};
inline constexpr std::size_t kCostPhases = 8;
[[nodiscard]] std::string_view name_of(CostPhase phase);

/// Callbacks for progress bars; those of this class do nothing. `done` and `total` count rows.
class CostProgress {
 public:
  virtual ~CostProgress() = default;
  /// The next rows are of the camera with index `camera` of `cameras`.
  virtual void begin_camera(std::size_t /*camera*/, std::size_t /*cameras*/) {}
  /// All rows of the camera, in the order in which finished() tells of them.
  virtual void plan(const std::vector<PlannedRow>& /*rows*/) {}
  virtual void measuring(const std::string& /*knob*/, const std::string& /*value*/, std::size_t /*done*/,
                         std::size_t /*total*/) {}
  /// `resumed`: the row was found in the folder and nothing was drawn.
  virtual void finished(const LedgerRow& /*row*/, bool /*resumed*/) {}
  /// The same for combinations. `setting`: settings_text().
  virtual void measuring_point(const std::string& setting, std::size_t done, std::size_t total) {
    measuring("point", setting, done, total);
  }
  virtual void finished_point(const LedgerPoint& /*point*/, bool /*resumed*/) {}
  /// Work of this kind begins; it ends with the next call.
  virtual void phase(CostPhase /*phase*/) {}
  /// A picture of a row or point that was just measured. `name`: one of row_pictures(), which is the same for equal
  /// pictures.
  [[nodiscard]] virtual Status picture(const std::string& /*name*/, const Picture& /*picture*/) { return {}; }
  /// Whether picture() was called with this name, now or in the run that a stored row comes from. A stored row that
  /// lacks a picture is measured again.
  [[nodiscard]] virtual bool has_picture(const std::string& /*name*/) { return true; }
};

struct CostRequest {
  /// `frames` and `samples` control the measurement. The other fields are reported and identify stored rows.
  LedgerHeader header;
  std::string conditions;          ///< other inputs that change a frame (seed, animation, visualizer), one line
  std::vector<std::string> knobs;  ///< names of existing knobs, in the order of the ledger
  std::vector<SkippedKnob> skipped;
  std::uint32_t points = 0;    ///< most combinations to measure, with the default and the exact setting; 0: none
  std::uint32_t sequence = 1;  ///< frames over which the temporal error is computed; 1: none
  std::string folder;          ///< finished rows and references are stored below it
};

inline constexpr std::uint32_t kLedgerFrames = 200;  ///< most timed frames per value
/// Timing ends when the 95 % interval of the ratio reaches at most this far from it, relative to it.
inline constexpr double kLedgerInterval = 0.02;
inline constexpr double kQuickInterval = 0.06;
inline constexpr std::uint32_t kLedgerSamples = 256;  ///< samples of references that sample
inline constexpr std::uint32_t kLedgerPoints = 24;
inline constexpr std::uint32_t kQuickPoints = 10;
inline constexpr std::uint32_t kQuickFrames = 40;
inline constexpr double kQuickSeconds = 540.0;
inline constexpr std::uint32_t kQuickSamples = 64;
inline constexpr std::uint32_t kQuickWidth = 320;
inline constexpr std::uint32_t kQuickHeight = 180;

/// The knobs named in a comma-separated list, in which `*` stands for any characters; all if the list is empty. Usage
/// error that lists the valid names if nothing has a name of the list.
[[nodiscard]] Result<std::vector<std::string>> choose_knobs(const KnobRegistry& knobs, std::string_view list);

/// Texts of the values that get a row, in order and without duplicates: Knob::ledger_values or all choices, including
/// the default and the exact value.
[[nodiscard]] std::vector<std::string> ledger_values(const Knob& knob);

/// Names of all pictures of a row.
[[nodiscard]] std::vector<std::string> row_pictures(const LedgerRow& row);

/// Measures every value of every knob of the request: its error against the knob's reference, or by the knob's measure
/// if it has one; and its time, alternating with the default until the ratio is known well enough or `frames` are
/// timed. All rows of the default have the same time: that of all its frames. Rows that an earlier run finished are not
/// measured again. Then it measures combinations of the values that the rows promise to be best, up to request.points.
/// Each row and point also has its error against the whole frame, which is drawn once. The knobs have their previous
/// values afterwards. An error names the knob and the value.
[[nodiscard]] Result<Ledger> measure_costs(const CostRequest& request, CostSubject& subject, CostProgress& progress);

/// One camera of a ledger, or one moment.
struct CostCamera {
  CostRequest request;
  CostSubject* subject = nullptr;  ///< no other camera's
};

/// The same for several cameras, at least one: the rows of each, and the worst of them (worst_of_cameras()). Each
/// combination is measured in all cameras. The ledger's time, points and folder are those of the first request.
[[nodiscard]] Result<Ledger> measure_costs(std::span<const CostCamera> cameras, CostProgress& progress);

/// Settings to choose from for a time budget of one module's passes (FrameBudget::effect): combinations of its knobs'
/// values, predicted from the ledger's rows, the fastest first. Their times are those of the passes on the device,
/// their errors mean FLIP against the whole frame. Empty if the ledger has no rows of the module, or its passes took no
/// time.
[[nodiscard]] std::vector<FrontPoint> effect_points(const Ledger& ledger, std::string_view effect, KnobRegistry knobs);

struct ShortLedgerRequest {
  LedgerHeader header;  ///< reported only
  /// Whole settings to measure beside the user's own, which come first. What is left when the time is over is left out,
  /// but not the first of them.
  std::vector<std::vector<KnobOverride>> settings;
  double seconds = 14.0;
  /// Called before each setting; an error ends measuring. May be null.
  std::function<Status(std::size_t done, std::size_t total)> progress = nullptr;
  std::function<double()> now_s = nullptr;  ///< a clock; null: that of the machine
};

/// A ledger without rows, made in seconds: the time of each setting by a few frames, and its error against the user's
/// own settings, not against exact ones: no point is more right than these. The knobs have their previous values
/// afterwards.
[[nodiscard]] Result<Ledger> measure_short_ledger(const ShortLedgerRequest& request, CostSubject& subject);

struct StabilityReport;

struct KnobMeaning {
  std::string knob;
  std::string meaning;        ///< one sentence
  std::string default_value;  ///< its text; may be empty
};

/// Contents of a report beside its ledger.
struct ReportRequest {
  std::string command;  ///< the command line that measures the ledger again
  std::vector<KnobMeaning> meanings;
  /// The bytes of a PNG or JPEG file for one of row_pictures(), small enough to be embedded; nullopt: there is none. A
  /// picture that it finds must also lie at pictures/NAME.png beside the report, which links to it. May be empty.
  std::function<std::optional<std::string>(const std::string& name)> picture;
  /// The newest self-test of the ledger's device; null: none is known.
  const StabilityReport* stability = nullptr;
};

/// A page that shows a ledger to somebody who must decide what to turn down: HTML with everything in it, below 3 MB.
/// Pictures for which there is no room are only linked. The same ledger and request give the same text.
[[nodiscard]] std::string ledger_report(const Ledger& ledger, const ReportRequest& request);

/// A tracer of the world's triangles as its systems left them. The triangles are copied, so the world may change.
/// `origin`: the world position that rays are relative to; precision is best if it is near their origins. None: the
/// middle of the scene. traced: which mesh instances.
[[nodiscard]] Result<std::unique_ptr<SceneTracer>> make_scene_tracer(const World& world, JobExecutor& executor,
                                                                     const std::optional<dvec3>& origin = {},
                                                                     TracedInstances traced = TracedInstances::all);

/// A ReferenceStore that keeps results in files below `folder`.
[[nodiscard]] std::unique_ptr<ReferenceStore> make_reference_store(std::string folder);

}  // namespace gloam
