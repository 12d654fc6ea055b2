// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/knobs/knob_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/expect_assert.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

using test::knob_text;
using ::testing::ElementsAre;

enum class Filter : std::uint8_t { none, box, tent };
constexpr std::string_view name_of(Filter filter) {
  switch (filter) {
    case Filter::none:
      return "none";
    case Filter::box:
      return "box";
    case Filter::tent:
      return "tent-shaped";
  }
  return {};
}

constexpr EnumKnob<Filter> kFilter{
    .name = "lamp.filter", .meaning = "how shadows are filtered", .default_value = Filter::box, .exact = Filter::tent};
constexpr ChoiceKnob<std::uint32_t> kTable{.name = "lamp.table",
                                           .meaning = "entries of the table",
                                           .choices = {{"exact", 0}, {"1024", 1024}, {"64", 64}},
                                           .default_value = 64,
                                           .exact = 0,
                                           .unit = "entries"};
constexpr OnOffKnob kLit{.name = "lamp.lit", .meaning = "whether it is on", .default_value = true};
constexpr ChoiceKnob<bool> kFull{
    .name = "lamp.resolution", .meaning = "size", .choices = {{"full", true}, {"half", false}}};
constexpr IntegerKnob<std::uint32_t> kSamples{.name = "lamp.samples",
                                              .meaning = "rays a pixel",
                                              .min = 1,
                                              .max = 4294967295u,
                                              .default_value = 16,
                                              .exact = 4294967295u,
                                              .ledger_values = {1, 16}};
constexpr IntegerKnob<std::int32_t> kOffset{.name = "lamp.offset", .meaning = "steps", .min = -8, .max = 8};
constexpr NumberKnob kShare{
    .name = "lamp.share", .meaning = "light that is kept", .min = 0.25, .max = 50, .default_value = 12.5, .unit = "%"};

void add_lamp_knobs(KnobRegistry& registry) {
  add_knobs(registry, "lamp", kFilter, kTable, kLit, kFull, kSamples, kOffset, kShare);
}

class KnobTable : public ::testing::Test {
 protected:
  KnobTable() { add_lamp_knobs(knobs_); }
  void set(std::string_view name, std::string_view value) {
    const Status status = knobs_.set(name, value);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  KnobRegistry knobs_;
};

TEST_F(KnobTable, values_have_the_types_of_their_references) {
  static_assert(std::is_same_v<decltype(knobs_.value(kFilter)), Filter>);
  static_assert(std::is_same_v<decltype(knobs_.value(kTable)), std::uint32_t>);
  static_assert(std::is_same_v<decltype(knobs_.value(kLit)), bool>);
  static_assert(std::is_same_v<decltype(knobs_.value(kSamples)), std::uint32_t>);
  static_assert(std::is_same_v<decltype(knobs_.value(kOffset)), std::int32_t>);
  static_assert(std::is_same_v<decltype(knobs_.value(kShare)), double>);
  EXPECT_EQ(knobs_.value(kFilter), Filter::box);
  EXPECT_EQ(knobs_.value(kTable), 64u);
  EXPECT_TRUE(knobs_.value(kLit));
  EXPECT_FALSE(knobs_.value(kFull));
  EXPECT_EQ(knobs_.value(kSamples), 16u);
  EXPECT_EQ(knobs_.value(kOffset), 0);
  EXPECT_EQ(knobs_.value(kShare), 12.5);
}

TEST_F(KnobTable, declares_a_knob_with_all_that_its_reference_states) {
  const Knob& filter = *knobs_.find("lamp.filter");
  EXPECT_EQ(&filter, knobs_.knobs().data()) << "in the order of the call";
  EXPECT_EQ(filter.module, "lamp");
  EXPECT_EQ(filter.meaning, "how shadows are filtered");
  EXPECT_EQ(filter.type, Knob::Type::choice);
  EXPECT_THAT(filter.choices, ElementsAre("none", "box", "tent-shaped"));
  EXPECT_EQ(filter.default_number, 1.0);
  EXPECT_EQ(filter.exact, "tent-shaped");
  const Knob& table = *knobs_.find("lamp.table");
  EXPECT_THAT(table.choices, ElementsAre("exact", "1024", "64"));
  EXPECT_EQ(table.default_number, 2.0);
  EXPECT_EQ(table.exact, "exact");
  EXPECT_EQ(table.unit, "entries");
  EXPECT_THAT(knobs_.find("lamp.lit")->choices, ElementsAre("off", "on"));
  EXPECT_EQ(knobs_.find("lamp.lit")->exact, "");
  const Knob& samples = *knobs_.find("lamp.samples");
  EXPECT_EQ(samples.type, Knob::Type::integer);
  EXPECT_EQ(samples.min, 1.0);
  EXPECT_EQ(samples.max, 4294967295.0);
  EXPECT_EQ(samples.exact, "4294967295");
  EXPECT_THAT(samples.ledger_values, ElementsAre(1.0, 16.0));
  EXPECT_EQ(knobs_.find("lamp.share")->type, Knob::Type::number);
  EXPECT_EQ(knobs_.find("lamp.share")->min, 0.25);
  EXPECT_EQ(knobs_.find("lamp.share")->unit, "%");
}

TEST_F(KnobTable, reads_what_users_set_as_text) {
  for (const Filter filter : {Filter::none, Filter::box, Filter::tent}) {
    set("lamp.filter", name_of(filter));
    EXPECT_EQ(knobs_.value(kFilter), filter);
  }
  for (const auto& choice : kTable.choices) {
    set("lamp.table", choice.text);
    EXPECT_EQ(knobs_.value(kTable), choice.value);
  }
  set("lamp.lit", "off");
  EXPECT_FALSE(knobs_.value(kLit));
  set("lamp.resolution", "full");
  EXPECT_TRUE(knobs_.value(kFull));
  set("lamp.samples", "4294967295");
  EXPECT_EQ(knobs_.value(kSamples), 4294967295u);
  set("lamp.offset", "-8");
  EXPECT_EQ(knobs_.value(kOffset), -8);
  set("lamp.share", "0.3");
  EXPECT_EQ(knobs_.value(kShare), 0.3);
}

TEST_F(KnobTable, code_sets_values_of_the_references_type) {
  knobs_.set(kFilter, Filter::tent);
  knobs_.set(kTable, 1024);
  knobs_.set(kLit, false);
  knobs_.set(kOffset, -3);
  knobs_.set(kShare, 0.25);
  EXPECT_EQ(knobs_.version(), 5u) << "a change like any other";
  EXPECT_EQ(knob_text(knobs_, "lamp.filter"), "tent-shaped");
  EXPECT_EQ(knob_text(knobs_, "lamp.table"), "1024");
  EXPECT_EQ(knob_text(knobs_, "lamp.lit"), "off");
  EXPECT_EQ(knob_text(knobs_, "lamp.offset"), "-3");
  EXPECT_EQ(knobs_.value(kShare), 0.25);
  EXPECT_ASSERT(knobs_.set(kTable, 65), "knob lamp.table must be one of exact, 1024, 64");
  EXPECT_ASSERT(knobs_.set(kShare, 0.2), "knob lamp.share must be a number in 0.25…50 %");
  EXPECT_ASSERT(knobs_.set(kOffset, 9), "knob lamp.offset must be an integer in -8…8");
  EXPECT_ASSERT(knobs_.set(kFilter, static_cast<Filter>(3)), "knob lamp.filter must be one of none, box, tent-shaped");
  EXPECT_EQ(knobs_.version(), 5u);
}

TEST_F(KnobTable, overrides_and_assignments_are_texts_that_set_the_value) {
  const KnobOverride filter = override_of(kFilter, Filter::tent);
  EXPECT_EQ(filter.name, "lamp.filter");
  EXPECT_EQ(filter.value, "tent-shaped");
  set(filter.name, filter.value);
  EXPECT_EQ(knobs_.value(kFilter), Filter::tent);
  EXPECT_EQ(override_of(kShare, 0.3).value, "0.3");
  EXPECT_EQ(override_of(kSamples, 7).value, "7");
  EXPECT_EQ(override_of(kLit, false).value, "off");
  EXPECT_EQ(assignment_of(kTable, 0), "lamp.table=exact");
  EXPECT_EQ(texts_of(kFilter, {Filter::none, Filter::tent}), "none|tent-shaped");
  EXPECT_EQ(texts_of(kFilter, {Filter::box}), "box");
  EXPECT_ASSERT((void)override_of(kTable, 65), "knob lamp.table has no such value");
  EXPECT_ASSERT((void)override_of(kShare, 51.0), "knob lamp.share has no such value");
}

TEST_F(KnobTable, two_registries_do_not_share_values_or_places) {
  KnobRegistry other;
  add_knobs(other, "lamp", kShare, kFilter);
  knobs_.set(kFilter, Filter::none);
  other.set(kFilter, Filter::tent);
  other.set(kShare, 1.0);
  EXPECT_EQ(knobs_.value(kFilter), Filter::none);
  EXPECT_EQ(knobs_.value(kShare), 12.5);
  EXPECT_EQ(other.value(kFilter), Filter::tent);
  EXPECT_EQ(other.value(kShare), 1.0);
  const KnobRegistry copy = other;
  other.set(kFilter, Filter::box);
  EXPECT_EQ(copy.value(kFilter), Filter::tent);
}

TEST_F(KnobTable, a_knob_that_is_not_declared_asserts_by_name_or_has_no_value) {
  KnobRegistry other;
  add_knobs(other, "lamp", kShare);
  EXPECT_ASSERT((void)other.value(kFilter), "knob lamp.filter must be declared before it is read or set");
  EXPECT_ASSERT(other.set(kFilter, Filter::box), "knob lamp.filter must be declared before it is read or set");
  EXPECT_EQ(other.try_value(kFilter), std::nullopt);
  EXPECT_EQ(other.try_value(kShare), 12.5);
  EXPECT_EQ(knobs_.try_value(kFilter), Filter::box);
}

TEST_F(KnobTable, a_knob_that_is_declared_otherwise_asserts) {
  KnobRegistry other;
  other.add({.name = "lamp.filter", .type = Knob::Type::number, .max = 1.0});
  other.add({.name = "lamp.table", .choices = {"a", "b", "c", "d"}, .default_number = 3.0});
  EXPECT_ASSERT((void)other.value(kFilter), "knob lamp.filter is declared with another type");
  EXPECT_ASSERT((void)other.value(kTable), "knob lamp.table is declared with other choices");
}

TEST_F(KnobTable, a_default_that_is_none_of_the_choices_asserts) {
  constexpr ChoiceKnob<std::uint32_t> wrong{.name = "lamp.wrong", .choices = {{"1", 1}, {"2", 2}}, .default_value = 3};
  EXPECT_ASSERT(add_knobs(knobs_, "lamp", wrong), "knob lamp.wrong: its default lies outside its range");
  constexpr ChoiceKnob<std::uint32_t> empty{.name = "lamp.empty"};
  EXPECT_ASSERT(add_knobs(knobs_, "lamp", empty), "knob lamp.empty: its default lies outside its range");
  constexpr IntegerKnob<std::uint32_t> exact{.name = "lamp.exact", .max = 3, .exact = 4};
  EXPECT_ASSERT(add_knobs(knobs_, "lamp", exact), "knob lamp.exact has no such value");
  EXPECT_ASSERT(add_knobs(knobs_, "lamp", kFilter), "knob lamp.filter is declared twice");
}

// Enums that cannot be choices.
enum class Gap : std::uint8_t { first = 0, third = 2 };
constexpr std::string_view name_of(Gap gap) {
  switch (gap) {
    case Gap::first:
      return "first";
    case Gap::third:
      return "third";
  }
  return {};
}
enum class FromOne : std::uint8_t { one = 1, two };
constexpr std::string_view name_of(FromOne value) {
  switch (value) {
    case FromOne::one:
      return "one";
    case FromOne::two:
      return "two";
  }
  return {};
}
enum class Negative : std::int8_t { minus_one = -1, zero, one };
constexpr std::string_view name_of(Negative value) {
  switch (value) {
    case Negative::minus_one:
      return "-1";
    case Negative::zero:
      return "0";
    case Negative::one:
      return "1";
  }
  return {};
}
enum class SameName : std::uint8_t { on, yes };
constexpr std::string_view name_of(SameName value) {
  switch (value) {
    case SameName::on:
      return "on";
    case SameName::yes:
      return "on";
  }
  return {};
}
enum class Unnamed : std::uint8_t { a, b };
enum Unscoped : std::uint8_t { unscoped_a, unscoped_b };

TEST(KnobEnum, has_values_from_0_without_gaps_and_with_different_names) {
  EXPECT_TRUE(can_be_choices<Filter>());
  EXPECT_FALSE(can_be_choices<Gap>());
  EXPECT_FALSE(can_be_choices<FromOne>());
  EXPECT_FALSE(can_be_choices<Negative>());
  EXPECT_FALSE(can_be_choices<SameName>());
  EXPECT_FALSE(NamedEnum<Unnamed>);
  EXPECT_FALSE(NamedEnum<Unscoped>);
  EXPECT_FALSE(NamedEnum<int>);
}

TEST(KnobEnum, gives_its_choices_in_its_order) {
  std::vector<std::string> texts;
  for (const auto& choice : choices_of_enum<Filter>()) {
    EXPECT_EQ(static_cast<std::size_t>(choice.value), texts.size());
    texts.emplace_back(choice.text);
  }
  EXPECT_THAT(texts, ElementsAre("none", "box", "tent-shaped"));
}

/// Whether a registry reads a knob by such an argument. Knobs are read by typed references, or by the Knob of a list.
template <class Name>
concept ReadsAsText = requires(const KnobRegistry& knobs, const Name& name) {
  knobs.text(name);
};
template <class Name>
concept ReadsAsNumber = requires(const KnobRegistry& knobs, const Name& name) {
  knobs.number(name);
};
template <class Name>
concept ReadsAsValue = requires(const KnobRegistry& knobs, const Name& name) {
  knobs.value(name);
};

TEST(KnobRegistry, has_no_reader_that_takes_a_name) {
  EXPECT_TRUE(ReadsAsText<Knob> && ReadsAsNumber<Knob> && ReadsAsValue<NumberKnob>);
  EXPECT_FALSE(ReadsAsText<std::string> || ReadsAsNumber<std::string> || ReadsAsValue<std::string>);
  EXPECT_FALSE(ReadsAsText<std::string_view> || ReadsAsNumber<std::string_view> || ReadsAsValue<std::string_view>);
  EXPECT_FALSE(ReadsAsText<const char*> || ReadsAsNumber<const char*> || ReadsAsValue<const char*>);
}

TEST(KnobRegistry, reads_no_knob_of_another_registry_or_that_was_made_up) {
  KnobRegistry knobs, other;
  add_lamp_knobs(knobs);
  add_lamp_knobs(other);
  EXPECT_ASSERT((void)knobs.text(*other.find("lamp.share")), "knob lamp.share is read with a Knob of another registry");
  EXPECT_ASSERT((void)knobs.number({.name = "lamp.share"}), "knob lamp.share is read with a Knob of another registry");
  EXPECT_EQ(knobs.text(*knobs.find("lamp.share")), "12.5");
}

}  // namespace
}  // namespace gloam
