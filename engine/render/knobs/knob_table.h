// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Knobs by typed reference. A module states each of its knobs once, as a constant of one of the types below. It
// declares them with add_knobs() and reads them with KnobRegistry::value():
//
//   inline constexpr EnumKnob<TileBound> kTileBound{.name = "lights.tile_bound", .meaning = "shape that bounds …",
//                                                   .default_value = TileBound::cone};
//   add_knobs(registry, "lights", kTileBound);
//   const TileBound bound = knobs.value(kTileBound);
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/core/assert.h"
#include "engine/render/knobs/knobs.h"

namespace gloam {

/// At most 16 items, stated in braces. More do not compile in a constant.
template <class T>
class KnobItems {
 public:
  constexpr KnobItems() = default;
  constexpr KnobItems(std::initializer_list<T> items) {
    for (const T& item : items) add(item);
  }
  constexpr void add(const T& item) { items_.at(count_++) = item; }
  [[nodiscard]] constexpr std::size_t size() const { return count_; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return items_.at(i); }
  [[nodiscard]] constexpr const T* begin() const { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const { return items_.data() + count_; }

 private:
  std::array<T, 16> items_{};
  std::size_t count_ = 0;
};

/// A text that users set, and the value that it stands for.
template <class T>
struct KnobChoice {
  std::string_view text;
  T value{};
};

/// A scoped enum whose values have texts for users. The texts are stated beside the enum, in a function that
/// argument-dependent lookup finds. It is a switch without `default`, so that the compiler reports a value without a
/// text (-Wswitch):
///
///   constexpr std::string_view name_of(TileBound bound) {
///     switch (bound) {
///       case TileBound::rect: return "rect";
///       case TileBound::cone: return "cone";
///     }
///     return {};
///   }
template <class E>
concept NamedEnum = std::is_enum_v<E> && !std::is_convertible_v<E, int> && requires(E value) {
  { name_of(value) } -> std::same_as<std::string_view>;
};

/// The enum's values from 0 up to the first one without a text.
template <NamedEnum E>
[[nodiscard]] constexpr KnobItems<KnobChoice<E>> choices_of_enum() {
  KnobItems<KnobChoice<E>> choices;
  for (int i = 0; !name_of(static_cast<E>(i)).empty(); ++i)
    choices.add({name_of(static_cast<E>(i)), static_cast<E>(i)});
  return choices;
}

/// Whether the enum's values are 0, 1, 2 … and their texts differ. A choice is stored as its index.
template <NamedEnum E>
[[nodiscard]] constexpr bool can_be_choices() {
  const KnobItems<KnobChoice<E>> choices = choices_of_enum<E>();
  const int count = static_cast<int>(choices.size());
  for (int i = -64; i < 64; ++i)
    if ((i < 0 || i >= count) && !name_of(static_cast<E>(i)).empty()) return false;
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (choices[i].text == choices[j].text) return false;
  return count > 0;
}

/// Index of the choice with this value; -1 if there is none.
template <class T>
[[nodiscard]] constexpr double index_of_choice(const KnobItems<KnobChoice<T>>& choices, const T& value) {
  for (std::size_t i = 0; i < choices.size(); ++i)
    if (choices[i].value == value) return static_cast<double>(i);
  return -1.0;
}

template <class T>
[[nodiscard]] Knob knob_of_choices(const KnobItems<KnobChoice<T>>& choices) {
  Knob knob;
  for (const KnobChoice<T>& choice : choices) knob.choices.emplace_back(choice.text);
  return knob;
}

/// Has the values of an enum, in the enum's order.
template <NamedEnum E>
struct EnumKnob {
  static_assert(can_be_choices<E>(), "the values of a knob's enum must be 0, 1, 2 … and have different names");
  using Value = E;
  static constexpr Knob::Type kType = Knob::Type::choice;

  std::string_view name;
  std::string_view meaning;
  E default_value{};
  std::optional<E> exact{};  ///< this and the next ones: see Knob
  std::string_view unit{};
  std::string_view taste{};
  bool same_picture = false;
  std::string_view only_with{};
  bool is_look = false;  ///< Knob::is_look

  [[nodiscard]] constexpr E value_of(double number) const {
    constexpr double kCount = static_cast<double>(choices_of_enum<E>().size());
    GLOAM_ASSERT(number >= 0.0 && number < kCount, "knob " + std::string(name) + " is declared with other choices");
    return static_cast<E>(static_cast<int>(number));
  }
  [[nodiscard]] constexpr double number_of(E value) const { return static_cast<double>(value); }
  [[nodiscard]] Knob knob() const { return knob_of_choices(choices_of_enum<E>()); }
};

template <class T>
[[nodiscard]] constexpr KnobItems<KnobChoice<T>> usual_choices() {
  if constexpr (std::is_same_v<T, bool>) return {{"off", false}, {"on", true}};
  return {};
}

/// Has choices that stand for values, for example numbers: {"exact", 0}, {"64", 64}. Without `choices`, a
/// ChoiceKnob<bool> is "off" or "on".
template <class T>
struct ChoiceKnob {
  using Value = T;
  static constexpr Knob::Type kType = Knob::Type::choice;

  std::string_view name;
  std::string_view meaning;
  KnobItems<KnobChoice<T>> choices = usual_choices<T>();
  T default_value{};  ///< one of the choices' values
  std::optional<T> exact{};
  std::string_view unit{};
  std::string_view taste{};
  bool same_picture = false;
  std::string_view only_with{};
  bool is_look = false;
  bool scales_frame = false;  ///< Knob::scales_frame

  [[nodiscard]] constexpr const T& value_of(double number) const {
    const bool known = number >= 0.0 && number < static_cast<double>(choices.size());
    GLOAM_ASSERT(known, "knob " + std::string(name) + " is declared with other choices");
    return choices[static_cast<std::size_t>(number)].value;
  }
  [[nodiscard]] constexpr double number_of(const T& value) const { return index_of_choice(choices, value); }
  [[nodiscard]] Knob knob() const { return knob_of_choices(choices); }
};

/// Has the numbers from min to max; integers if T is an integer type.
template <class T>
struct RangeKnob {
  static_assert(std::is_same_v<T, double> || (std::is_integral_v<T> && sizeof(T) <= 4), "stored as a double");
  using Value = T;
  static constexpr Knob::Type kType = std::is_integral_v<T> ? Knob::Type::integer : Knob::Type::number;

  std::string_view name;
  std::string_view meaning;
  T min{};
  T max{};
  T default_value{};
  std::optional<T> exact{};
  std::string_view unit{};
  KnobItems<double> ledger_values{};  ///< Knob::ledger_values
  std::string_view taste{};
  bool same_picture = false;
  std::string_view only_with{};
  bool is_look = false;

  [[nodiscard]] constexpr T value_of(double number) const { return static_cast<T>(number); }
  [[nodiscard]] constexpr double number_of(T value) const { return static_cast<double>(value); }
  [[nodiscard]] Knob knob() const {
    Knob knob;
    knob.min = number_of(min);
    knob.max = number_of(max);
    knob.ledger_values.assign(ledger_values.begin(), ledger_values.end());
    return knob;
  }
};

using OnOffKnob = ChoiceKnob<bool>;
using NumberKnob = RangeKnob<double>;
template <class T>
using IntegerKnob = RangeKnob<T>;

/// The text that sets the knob to the value. Asserts that it is one of the knob's values.
template <class K>
[[nodiscard]] std::string text_of(const K& reference, const typename K::Value& value) {
  Knob knob = reference.knob();
  knob.type = K::kType;
  const double number = reference.number_of(value);
  const bool valid = K::kType == Knob::Type::choice ? number >= 0.0 && number < static_cast<double>(knob.choices.size())
                                                    : number >= knob.min && number <= knob.max;
  GLOAM_ASSERT(valid, "knob " + std::string(reference.name) + " has no such value");
  return value_text(knob, number);
}

/// The declaration of a knob of the module.
template <class K>
[[nodiscard]] Knob declaration_of(const K& reference, std::string_view module) {
  Knob knob = reference.knob();
  knob.name = reference.name;
  knob.module = module;
  knob.meaning = reference.meaning;
  knob.type = K::kType;
  knob.default_number = reference.number_of(reference.default_value);
  knob.unit = reference.unit;
  if (reference.exact) knob.exact = text_of(reference, *reference.exact);
  knob.taste = reference.taste;
  knob.is_look = reference.is_look || !reference.taste.empty();
  if constexpr (requires { reference.scales_frame; }) knob.scales_frame = reference.scales_frame;
  knob.same_picture = reference.same_picture;
  knob.only_with = reference.only_with;
  return knob;
}

/// Declares a module's knobs, in this order.
template <class... K>
void add_knobs(KnobRegistry& registry, std::string_view module, const K&... references) {
  (registry.add(declaration_of(references, module)), ...);
}

/// The texts of several values, separated by '|'.
template <class K>
[[nodiscard]] std::string texts_of(const K& reference, std::initializer_list<typename K::Value> values) {
  std::string texts;
  for (const auto& value : values) texts += (texts.empty() ? "" : "|") + text_of(reference, value);
  return texts;
}

/// "NAME=VALUE"
template <class K>
[[nodiscard]] std::string assignment_of(const K& reference, const typename K::Value& value) {
  return std::string(reference.name) + "=" + text_of(reference, value);
}

/// For ViewSettings::knobs and MeasureInfo.
template <class K>
[[nodiscard]] KnobOverride override_of(const K& reference, const typename K::Value& value) {
  return {std::string(reference.name), text_of(reference, value)};
}

}  // namespace gloam
