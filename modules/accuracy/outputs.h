// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/governor/frame_budget.h"

// The cost ledger: error and time of each value of each knob, and of combinations, on one scene and device.

namespace gloam {

struct TimeSummary {
  double median_ms = 0.0;
  double p10_ms = 0.0;
  double p90_ms = 0.0;
  bool operator==(const TimeSummary&) const = default;
};

/// A mean and a 99th percentile over pixels.
struct ErrorPair {
  double mean = 0.0;
  double p99 = 0.0;
  bool operator==(const ErrorPair&) const = default;
};

/// An error that is a count, not a difference of pictures.
struct CountedError {
  double value = 0.0;
  std::string unit;           ///< "false positives a tile"
  std::optional<double> p99;  ///< if `value` is the mean of many: their 99th percentile
  bool operator==(const CountedError&) const = default;
};

/// The error over the pixels near edges of the reference only (modules/accuracy/metrics/edge_error.h). It judges
/// antialiasing: a mean over the whole picture hides the edges.
struct EdgeError {
  ErrorPair flip;        ///< 0…1
  double psnr_db = 0.0;  ///< infinity: equal at all edges
  double share = 0.0;    ///< of the picture's pixels that are near edges
  bool operator==(const EdgeError&) const = default;
};

/// The difference from the whole-frame reference: the frame with every knob at its most exact value. Errors of
/// different effects can be compared on this scale.
struct WholeError {
  ErrorPair flip;        ///< 0…1
  double rmse = 0.0;     ///< linear light, cd/m², over all pixels and channels
  double psnr_db = 0.0;  ///< infinity: identical pictures
  bool operator==(const WholeError&) const = default;
};

/// The difference from a picture that does not share the effect's model (ReferenceInfo::draw_model): the error of the
/// model and of the knob's value together.
struct EffectModelError {
  std::string name;    ///< of the method that drew the picture
  ErrorPair flip;      ///< 0…1
  double rmse = 0.0;   ///< linear light, cd/m², over all pixels and channels
  double noise = 0.0;  ///< as LedgerRow::reference_noise
  bool operator==(const EffectModelError&) const = default;
};

/// A rectangle of a picture's pixels.
struct PictureArea {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool operator==(const PictureArea&) const = default;
};

/// Result for one value of one knob; all other knobs are as the user set them.
struct LedgerRow {
  std::string knob;
  std::string value;
  bool is_default = false;
  std::string reference_kind;  ///< "brute force", "traced", "accumulated", "double precision"; empty: the knob has no
                               ///< reference and errors are absent
  std::string reference_name;
  std::string no_reference;  ///< why there is none (Knob::taste); empty: there is one, or no reason is known
  /// Mean FLIP between half and all samples of the reference (RMSE if the reference has no picture); 0: exact.
  double reference_noise = 0.0;
  bool below_noise = false;  ///< the error is less than reference_noise, so its value has no meaning

  std::optional<CountedError> counted;  ///< only for a knob with a measure; the errors of its pictures are set, too
  std::string wrong;  ///< reason from the frame's counters why the value is wrong regardless of its error; empty: none
  std::optional<ErrorPair> flip;   ///< 0…1
  std::optional<double> rmse;      ///< linear light, cd/m², over all pixels and channels
  std::optional<double> rmse_p99;  ///< 99th percentile of the pixels' RMSE
  std::optional<double> psnr_db;   ///< infinity: identical pictures
  /// None if the reference has no picture or no edges, for points, and in older ledgers.
  std::optional<EdgeError> edges;
  /// Only in runs over several frames: linear light, cd/m², or displayed light, 0…1, if the reference is a picture
  /// only.
  std::optional<ErrorPair> temporal;
  /// None for a knob that is a look (Knob::is_look), and in older ledgers.
  std::optional<WholeError> whole;
  std::optional<EffectModelError> effect_model;  ///< none if the effect's model is not judged, and in older ledgers

  /// Of a frame, by the ledger's clock: the default's time, times the ratio.
  TimeSummary ms;
  double wall_ms = 0.0;  ///< median of CPU time plus GPU time, as clocks on the wall show them
  double cpu_ms = 0.0;   ///< medians of the two
  double gpu_ms = 0.0;
  double module_cpu_ms = 0.0;  ///< medians for the knob's module: its systems, summed over threads, and its passes
  double module_gpu_ms = 0.0;
  /// Time divided by the default's time: median over pairs of neighbouring frames; 1 for the default itself.
  double ratio = 1.0;
  double ratio_low = 1.0;  ///< 95 % interval of the ratio
  double ratio_high = 1.0;
  double sure_low = 1.0;  ///< 99.8 % interval, by which values with equal pictures are told apart
  double sure_high = 1.0;
  /// Of frames that were timed. 0: the row has the default's picture, it is known why the knob changes nothing, and so
  /// it has the default's time.
  std::uint32_t pairs = 0;
  std::uint64_t gpu_bytes = 0;     ///< of all modules
  std::string picture;             ///< hash of the value's picture and light
  std::string reference_picture;   ///< the same of its reference; empty: the reference has no picture
  std::vector<PictureArea> worst;  ///< where mean FLIP is highest, the worst first; apart, and of one size
  /// The picture is equal to the default's to the bit, and no difference in time is significant.
  bool no_effect = false;
  /// Only of rows of the default: why the knob changes nothing, as far as that is known; of use if no_effect is set for
  /// all rows of the knob.
  std::string no_effect_reason;
  bool on_front = false;  ///< see mark_pareto_front()

  /// The error for the front and for reports: `counted` if set; otherwise mean FLIP or, without FLIP, RMSE, and at
  /// least reference_noise. None if none of them is set.
  [[nodiscard]] std::optional<double> error() const;
  /// Names of the pictures that measuring gives to CostProgress::picture, beside `picture` and `reference_picture`: the
  /// FLIP of each pixel in colours, and the worst areas (a line for each: the value's, then the reference's). Empty:
  /// the row has no FLIP, or it is 0 everywhere.
  [[nodiscard]] std::string heat_map() const;
  [[nodiscard]] std::string worst_areas() const;
  bool operator==(const LedgerRow&) const = default;
};

struct LedgerHeader {
  std::string scene;       ///< as the user named it
  std::string scene_hash;  ///< of the scene's content, hexadecimal
  std::string camera;      ///< empty: the default one
  double time_s = 0.0;
  std::string device;
  std::string driver;
  std::string device_type;
  std::uint32_t subgroup_size = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string clock;         ///< what LedgerRow::ms is
  std::string version;       ///< of the program
  std::string build;         ///< hash of this build, hexadecimal
  std::string host;          ///< name of the machine; empty in ledgers of earlier versions
  bool quick = false;        ///< small picture, few frames and samples: noisier
  std::uint32_t frames = 0;  ///< most timed frames per value
  double seconds = 0.0;  ///< values get fewer frames, at least 6, so that measuring takes about so long; 0: no limit
  std::uint32_t samples = 0;  ///< samples of references that sample
  bool operator==(const LedgerHeader&) const = default;
};

/// A knob without rows, and the reason.
struct SkippedKnob {
  std::string knob;
  std::string reason;
  bool operator==(const SkippedKnob&) const = default;
};

/// The rows of one camera of a ledger of several.
struct CameraRows {
  std::string camera;
  double time_s = 0.0;
  std::vector<LedgerRow> rows;
  bool operator==(const CameraRows&) const = default;
};

struct KnobValue {
  std::string knob;
  std::string value;
  bool operator==(const KnobValue&) const = default;
};

inline constexpr const char* kWholeFrameKind = "whole frame";  ///< LedgerRow::reference_kind of points
inline constexpr const char* kWholeFrameName = "every knob at its most exact value";

/// Result for a whole setting: a combination of values.
struct LedgerPoint {
  std::vector<KnobValue> settings;  ///< the knobs whose value is not their declared default, in the program's order
  bool is_exact = false;            ///< every knob is at its most exact value
  /// Time, errors and pictures. knob is empty, value is settings_text(), and the reference is the whole frame. It is
  /// the default if it has the user's own settings; ratios are to them.
  LedgerRow measured;
  double predicted_ms = 0.0;    ///< by the model, from the rows
  double predicted_flip = 0.0;  ///< mean FLIP against the whole frame
  /// Only of several cameras: the row in each, in the order of Ledger::cameras. Then `measured` is their worst: see
  /// worst_point().
  std::vector<LedgerRow> cameras = {};
  bool operator==(const LedgerPoint&) const = default;
};

/// Measured divided by predicted.
struct ModelRatio {
  double median = 1.0;
  double worst = 1.0;  ///< the ratio farthest from 1, on a logarithmic scale
  bool operator==(const ModelRatio&) const = default;
};

/// How well the model predicted the points, without the default and the exact setting.
struct ModelQuality {
  std::uint32_t points = 0;  ///< that were compared
  ModelRatio time;
  ModelRatio error;  ///< of the mean FLIP against the whole frame
  bool operator==(const ModelQuality&) const = default;
};

struct Ledger {
  LedgerHeader header;
  std::vector<LedgerRow> rows;  ///< grouped by knob, in the order of the knob's values
  std::vector<SkippedKnob> skipped;
  /// Only of several cameras: then `rows` are their worst, and header.camera has their names, separated by commas.
  std::vector<CameraRows> cameras = {};
  std::vector<LedgerPoint> points = {};    ///< the fastest first
  std::optional<ModelQuality> model = {};  ///< none without points
};

/// The ledger's combinations as settings to choose from for a time budget: median times, all scaled by one factor to
/// what clocks on the wall showed, and mean FLIP against the whole frame.
[[nodiscard]] std::vector<FrontPoint> front_points(const Ledger& ledger);

/// "shadows.filter=hard views.scale=0.5"; "default" without settings.
[[nodiscard]] std::string settings_text(const std::vector<KnobValue>& settings);
/// The settings as a file for --config: a JSON object, one knob a line.
[[nodiscard]] std::string settings_config(const std::vector<KnobValue>& settings);

/// Sets no_effect and on_front of every row, for each knob separately. A row is on the front unless another value
///   is as right and significantly cheaper (the intervals of their ratios are apart), or
///   is not significantly dearer, and more right by more than the references' noise.
/// Of values with equal pictures at most one is: the one that is cheaper than the others (their 99.8 % intervals are
/// more than 3 % apart, their medians more than 0.03 ms), or else the default. If that is all values of the knob, none
/// is. Rows without an error and wrong rows are on no front.
void mark_pareto_front(std::vector<LedgerRow>& rows);

/// One ledger of several, each of another camera or time. Each value has its greatest error, ratio, time and memory
/// over the cameras; fronts are of these. A single ledger stays as it is.
[[nodiscard]] Ledger worst_of_cameras(std::vector<Ledger> ledgers);

/// A combination's row over all cameras: the time of the camera where a frame takes longest, the greatest error and
/// memory. Its ratio is to the default's time over all cameras, and its pictures are those of one camera.
/// rows: in each camera, at least one. default_ms: median of the default in each. shown: the camera of the pictures.
[[nodiscard]] LedgerRow worst_point(std::span<const LedgerRow> rows, std::span<const double> default_ms,
                                    std::size_t shown);

/// Why a row without a reference has none: row.no_reference, or a sentence that is always true.
[[nodiscard]] std::string no_reference_text(const LedgerRow& row);

/// A readable table: a header, then one aligned line per row. `*` marks the front, `!` a wrong row.
[[nodiscard]] std::string ledger_table(const Ledger& ledger);

/// A line for each point on the front, the default and the exact setting, and how well the model predicted. Empty
/// without points.
[[nodiscard]] std::string points_table(const Ledger& ledger);

/// JSON, schema version 1. Numbers are read back exactly.
[[nodiscard]] std::string ledger_json(const Ledger& ledger);
/// Malformed text gives an error of ErrorKind::input that names the fault.
[[nodiscard]] Result<Ledger> parse_ledger_json(std::string_view text);

/// One line of column names, then one line per row (RFC 4180). Absent numbers are empty. The last column is the camera:
/// of several, their worst rows come first, with all names, then the rows of each.
[[nodiscard]] std::string ledger_csv(const Ledger& ledger);
/// The same for the points.
[[nodiscard]] std::string points_csv(const Ledger& ledger);

}  // namespace gloam
