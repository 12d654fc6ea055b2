// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

/// A setting that trades accuracy for time. Its module declares it once (knob_table.h), for the command line, files,
/// panels, the cost ledger and tests. The default is the value for users who set nothing.
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
  /// Why no value is more right than another, in a few words: "a tone curve is a look". The ledger shows it in place of
  /// errors, and the knob has no reference. Empty: the knob has an error.
  std::string taste;
  /// The values are methods for one result: a picture that differs from the reference in one bit is wrong.
  bool same_picture = false;
  /// Setting of another knob without which this one changes nothing: "shadows.mode=deferred", with alternatives
  /// "shadows.filter=pcss|chs", of a number "closeups.max_pairs>0". " and " joins several. Empty: none.
  std::string only_with;
  /// The whole-frame reference keeps the user's value, and combinations of values do not vary it. Every taste is one.
  bool is_look = false;
  /// It changes how many pixels the whole frame has: its times multiply those of other knobs, which add.
  bool scales_frame = false;
};

/// A knob's value as text (KnobRegistry::set), for one view or while a measure counts. override_of() makes one.
struct KnobOverride {
  std::string name;
  std::string value;
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

  /// Current value of a knob of a knob table (knob_table.h), of the reference's type. Asserts that the knob is declared
  /// here, with the reference's type. Knobs of modules that a host leaves out are not: read them with try_value().
  template <class K>
  [[nodiscard]] typename K::Value value(const K& reference) const {
    return reference.value_of(stored(reference.name, K::kType));
  }
  /// nullopt if the knob is not declared here.
  template <class K>
  [[nodiscard]] std::optional<typename K::Value> try_value(const K& reference) const {
    if (find(reference.name) == nullptr) return std::nullopt;
    return value(reference);
  }
  /// Asserts that the knob is declared here and that the value is one of its values.
  template <class K>
  void set(const K& reference, const typename K::Value& value) {
    store(reference.name, K::kType, reference.number_of(value));
  }

  /// Sets a knob of knobs() or find(). number: one of its values; for Type::choice, the index of the choice. Asserts
  /// both. Allocates nothing.
  void set_number(const Knob& knob, double number);
  /// Takes the values and the version of a registry with the same knobs. Allocates nothing.
  void take_values(const KnobRegistry& other);

  /// Current value of a knob of knobs() or find(), for lists of all knobs. Asserts that the knob is one of this
  /// registry. number: for Type::choice, the index of the choice.
  [[nodiscard]] double number(const Knob& knob) const;
  [[nodiscard]] std::string text(const Knob& knob) const;

  [[nodiscard]] const std::vector<Knob>& knobs() const { return knobs_; }
  /// For names from users; null if the knob is not declared here.
  [[nodiscard]] const Knob* find(std::string_view name) const;
  /// Knob::only_with of this knob or, if that is met, of the knobs that it names, and so on: the first setting that is
  /// not met, and the current value: "only with shadows.mode=deferred, which is off". Empty: all are met.
  [[nodiscard]] std::string unmet_setting(const Knob& knob) const;
  /// Incremented whenever a value is set.
  [[nodiscard]] std::uint64_t version() const { return version_; }

 private:
  /// depth: how many knobs may need one another.
  [[nodiscard]] std::string unmet_setting(const Knob& knob, std::size_t depth) const;
  /// Whether the knob has a value of one setting of Knob::only_with.
  [[nodiscard]] bool is_met(std::string_view setting, const Knob& knob) const;
  [[nodiscard]] std::size_t index_of(const Knob& knob) const;
  [[nodiscard]] std::size_t index_of(std::string_view name, Knob::Type type) const;
  [[nodiscard]] double stored(std::string_view name, Knob::Type type) const { return values_[index_of(name, type)]; }
  void store(std::string_view name, Knob::Type type, double value);
  std::vector<Knob> knobs_;
  std::vector<double> values_;
  std::uint64_t version_ = 0;
};

}  // namespace gloam
