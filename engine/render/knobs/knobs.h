// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

/// A setting that trades accuracy for time. Its module declares it once, for the command line, files, panels, the cost
/// ledger and tests. The default is the value for users who set nothing.
struct Knob {
  enum class Type { choice, integer, number };
  std::string name;  ///< "lights.culling"
  std::string module;
  std::string meaning;
  Type type = Type::choice;
  std::vector<std::string> choices;  ///< for Type::choice
  double min = 0.0;
  double max = 0.0;
  double default_number = 0.0;  ///< for choice: index into choices
  std::string unit;
  /// Values with a row in the ledger; empty: all choices, or the default and the exact number.
  std::vector<double> ledger_values;
  /// Text of the exact value: the frame drawn with it is the reference for the other values. Empty: all values are
  /// equally right, or the module judges the knob by its own reference (Module::references).
  std::string exact;
};

/// The text that sets a knob to `value` (for choice: an index).
[[nodiscard]] std::string value_text(const Knob& knob, double value);

/// All knobs of all modules with their current values. Names are unique.
class KnobRegistry {
 public:
  /// Asserts on a duplicate name, a default out of range or an exact value that cannot be set.
  void add(Knob knob);

  /// Sets a knob from text: "tiled", "3", "0.5". Usage error that lists the valid names or values.
  [[nodiscard]] Status set(std::string_view name, std::string_view value);
  /// Sets a knob from "NAME=VALUE".
  [[nodiscard]] Status set_assignment(std::string_view assignment);
  /// Sets knobs from a JSON object of name → string, number or boolean. A usage error names `source` and the fault;
  /// knobs before the faulty one stay set.
  [[nodiscard]] Status set_from_json(std::string_view text, std::string_view source);

  /// Index of the current choice. The knob must exist and be of Type::choice (asserted).
  [[nodiscard]] std::uint32_t choice(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] bool is(std::string_view name, std::string_view choice) const;
  [[nodiscard]] std::string text(std::string_view name) const;

  [[nodiscard]] const std::vector<Knob>& knobs() const { return knobs_; }
  [[nodiscard]] const Knob* find(std::string_view name) const;
  /// Incremented whenever a value is set.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  [[nodiscard]] std::size_t index_of(std::string_view name) const;
  std::vector<Knob> knobs_;
  std::vector<double> values_;
  std::uint64_t version_ = 0;
};

}  // namespace gloam
