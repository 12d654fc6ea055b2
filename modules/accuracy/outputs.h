// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

// The cost ledger: what each value of each knob costs in accuracy and in time, on one scene and device.

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

/// An error that is a number of things and not a difference of pictures.
struct CountedError {
  double value = 0.0;
  std::string unit;  ///< "false positives a tile"
  bool operator==(const CountedError&) const = default;
};

/// One value of one knob, all other knobs as the user set them.
struct LedgerRow {
  std::string knob;
  std::string value;
  bool is_default = false;
  std::string reference_kind;  ///< "brute force", "traced", "double precision"; empty: nothing says what is right,
                               ///< errors are absent
  std::string reference_name;
  double reference_noise =
      0.0;  ///< mean FLIP between half and all samples of the reference (RMSE where it has no picture); 0: exact
  bool below_noise = false;  ///< the error is smaller than the reference's own: not a number to go by

  std::optional<CountedError>
      counted;        ///< of knobs that are told apart by more than their pictures; those below stay with it
  std::string wrong;  ///< why the value is wrong however small its error, as a frame counted; empty: it is not
  std::optional<ErrorPair> flip;      ///< 0…1
  std::optional<double> rmse;         ///< linear light, cd/m², over all pixels and channels
  std::optional<double> rmse_p99;     ///< of a pixel's RMSE
  std::optional<double> psnr_db;      ///< infinity: the same picture to the bit
  std::optional<ErrorPair> temporal;  ///< linear light, cd/m²; only of runs over several frames

  TimeSummary ms;       ///< of a frame: its CPU and GPU work, one after the other
  double cpu_ms = 0.0;  ///< medians of the two
  double gpu_ms = 0.0;
  double module_cpu_ms =
      0.0;  ///< medians of what the knob's module took: its systems, summed over threads, and its passes
  double module_gpu_ms = 0.0;
  double ratio = 1.0;  ///< to the default's time: median over pairs of neighbouring frames; the default's own is 1
  std::uint64_t gpu_bytes = 0;  ///< of all modules
  bool on_front =
      false;  ///< no other value of the knob is both as cheap (by ratio) and as right, and better in one of the two

  /// What the front and people go by: what was counted, else mean FLIP, else RMSE; never less than the reference's
  /// noise.
  [[nodiscard]] std::optional<double> error() const;
  bool operator==(const LedgerRow&) const = default;
};

struct LedgerHeader {
  std::string scene;       ///< as the user named it
  std::string scene_hash;  ///< of its content, hexadecimal
  std::string camera;      ///< empty: the default one
  double time_s = 0.0;
  std::string device;
  std::string driver;
  std::string device_type;
  std::uint32_t subgroup_size = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string version;        ///< of the program
  std::string build;          ///< of this very build of it, hexadecimal
  bool quick = false;         ///< small, few frames and samples: noisier
  std::uint32_t frames = 0;   ///< timed, a value
  std::uint32_t samples = 0;  ///< of references that sample
  bool operator==(const LedgerHeader&) const = default;
};

/// A knob that has no rows, and why.
struct SkippedKnob {
  std::string knob;
  std::string reason;
  bool operator==(const SkippedKnob&) const = default;
};

struct Ledger {
  LedgerHeader header;
  std::vector<LedgerRow> rows;  ///< of one knob side by side, in the order of its values
  std::vector<SkippedKnob> skipped;
};

/// Sets on_front of every row, knob by knob. Rows without an error, and wrong ones, are on no front.
void mark_pareto_front(std::vector<LedgerRow>& rows);

/// For people: a head and one aligned line a row; `*` marks the front, `!` what is wrong.
[[nodiscard]] std::string ledger_table(const Ledger& ledger);

/// Schema version 1. Numbers read back as they were.
[[nodiscard]] std::string ledger_json(const Ledger& ledger);
/// Error of ErrorKind::input that says what is wrong with the text.
[[nodiscard]] Result<Ledger> parse_ledger_json(std::string_view text);

/// One line of column names, then one a row (RFC 4180); absent numbers are empty.
[[nodiscard]] std::string ledger_csv(const Ledger& ledger);

}  // namespace gloam
