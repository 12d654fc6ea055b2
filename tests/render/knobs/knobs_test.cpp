// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/knobs/knobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "engine/render/views/renderer_knobs.h"
#include "tests/support/expect_assert.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

using test::knob_number;
using test::knob_text;
using ::testing::HasSubstr;

Knob choice_knob(std::string name, std::vector<std::string> choices, double standard = 0.0) {
  Knob knob;
  knob.name = std::move(name);
  knob.module = "test";
  knob.choices = std::move(choices);
  knob.default_number = standard;
  return knob;
}

Knob number_knob(std::string name, Knob::Type type, double min, double max, double standard, std::string unit = "") {
  Knob knob;
  knob.name = std::move(name);
  knob.module = "test";
  knob.type = type;
  knob.min = min;
  knob.max = max;
  knob.default_number = standard;
  knob.unit = std::move(unit);
  return knob;
}

class Knobs : public ::testing::Test {
 protected:
  Knobs() {
    knobs_.add(choice_knob("lights.culling", {"brute", "tiled"}, 1));
    knobs_.add(number_knob("shadows.maps", Knob::Type::integer, 1, 64, 8));
    knobs_.add(number_knob("grass.reach", Knob::Type::number, 0.5, 200, 40, "m"));
  }
  [[nodiscard]] std::string fault_of(std::string_view name, std::string_view value) {
    return message(knobs_.set(name, value));
  }
  [[nodiscard]] static std::string message(const Status& status) {
    if (status.ok()) return "(no error)";
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
    return status.error().message;
  }

  KnobRegistry knobs_;
};

TEST_F(Knobs, begin_with_their_defaults) {
  EXPECT_EQ(knob_number(knobs_, "lights.culling"), 1.0);
  EXPECT_EQ(knob_text(knobs_, "lights.culling"), "tiled");
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 8.0);
  EXPECT_EQ(knob_text(knobs_, "grass.reach"), "40");
  EXPECT_EQ(knobs_.version(), 0u);
  EXPECT_EQ(knobs_.knobs().size(), 3u);
}

TEST_F(Knobs, take_a_choice_by_its_word) {
  ASSERT_TRUE(knobs_.set("lights.culling", "brute").ok());
  EXPECT_EQ(knob_number(knobs_, "lights.culling"), 0.0);
  EXPECT_EQ(knob_text(knobs_, "lights.culling"), "brute");
}

TEST_F(Knobs, take_numbers_at_both_ends_of_their_range) {
  for (const char* text : {"0.5", "200", "2e2", "12.25"}) EXPECT_TRUE(knobs_.set("grass.reach", text).ok()) << text;
  EXPECT_EQ(knob_number(knobs_, "grass.reach"), 12.25);
  EXPECT_EQ(knob_text(knobs_, "grass.reach"), "12.25");
  for (const char* text : {"1", "64", "3.0"}) EXPECT_TRUE(knobs_.set("shadows.maps", text).ok()) << text;
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 3.0);
}

TEST_F(Knobs, count_every_change_and_no_refusal) {
  ASSERT_TRUE(knobs_.set("shadows.maps", "2").ok());
  EXPECT_EQ(knobs_.version(), 1u);
  EXPECT_FALSE(knobs_.set("shadows.maps", "none").ok());
  EXPECT_EQ(knobs_.version(), 1u);
  ASSERT_TRUE(knobs_.set_assignment("shadows.maps=3").ok());
  EXPECT_EQ(knobs_.version(), 2u);
}

TEST_F(Knobs, an_unknown_name_lists_all_names) {
  EXPECT_EQ(fault_of("lights.cooling", "tiled"),
            "unknown knob lights.cooling; did you mean lights.culling? there are lights.culling, shadows.maps, "
            "grass.reach");
  EXPECT_EQ(fault_of("fog.height", "1"),
            "unknown knob fog.height; there are lights.culling, shadows.maps, grass.reach");
  KnobRegistry none;
  EXPECT_EQ(message(none.set("a", "b")), "unknown knob a; there are none");
}

TEST_F(Knobs, a_wrong_choice_lists_the_choices) {
  EXPECT_EQ(fault_of("lights.culling", "fast"), "knob lights.culling must be one of brute, tiled, is \"fast\"");
  EXPECT_EQ(fault_of("lights.culling", ""), "knob lights.culling must be one of brute, tiled, is \"\"");
  EXPECT_EQ(fault_of("lights.culling", "0"), "knob lights.culling must be one of brute, tiled, is \"0\"");
  EXPECT_EQ(knob_text(knobs_, "lights.culling"), "tiled");
}

TEST_F(Knobs, a_wrong_number_states_kind_range_and_unit) {
  EXPECT_EQ(fault_of("grass.reach", "far"), "knob grass.reach must be a number in 0.5…200 m, is \"far\"");
  EXPECT_EQ(fault_of("shadows.maps", "65"), "knob shadows.maps must be an integer in 1…64, is \"65\"");
  for (const char* text : {"", " 1", "1 ", "0.4999", "200.1", "-3", "nan", "inf", "-inf", "1m", "0x10", "1,5"}) {
    EXPECT_THAT(fault_of("grass.reach", text), HasSubstr("must be a number in 0.5…200 m")) << text;
  }
  for (const char* text : {"0", "1.5", "1e9", "nan"}) {
    EXPECT_THAT(fault_of("shadows.maps", text), HasSubstr("must be an integer in 1…64")) << text;
  }
  EXPECT_EQ(knob_number(knobs_, "grass.reach"), 40.0);
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 8.0);
}

TEST_F(Knobs, an_assignment_splits_at_the_first_equals_sign) {
  EXPECT_TRUE(knobs_.set_assignment("lights.culling=brute").ok());
  EXPECT_EQ(knob_text(knobs_, "lights.culling"), "brute");
  EXPECT_EQ(message(knobs_.set_assignment("lights.culling")), "a knob is set as NAME=VALUE, not \"lights.culling\"");
  EXPECT_EQ(message(knobs_.set_assignment("lights.culling=a=b")),
            "knob lights.culling must be one of brute, tiled, is \"a=b\"");
  EXPECT_THAT(message(knobs_.set_assignment("=brute")), HasSubstr("unknown knob ; there are"));
}

TEST_F(Knobs, a_setting_that_is_not_met_is_named_with_the_current_value) {
  Knob filter = choice_knob("lights.filter", {"hard", "soft", "wide"});
  filter.only_with = "lights.culling=tiled";
  Knob width = number_knob("lights.width", Knob::Type::number, 0, 1, 0.5);
  width.only_with = "lights.filter=soft|wide";
  Knob lost = choice_knob("lights.lost", {"a"});
  lost.only_with = "fog.mode=on";  // of a module that is left out
  for (const Knob& knob : {filter, width, lost}) knobs_.add(knob);
  const auto unmet = [&](std::string_view name) { return knobs_.unmet_setting(*knobs_.find(name)); };
  EXPECT_EQ(unmet("lights.culling"), "");
  EXPECT_EQ(unmet("lights.lost"), "");
  EXPECT_EQ(unmet("lights.filter"), "");
  EXPECT_EQ(unmet("lights.width"), "only with lights.filter=soft or wide, which is hard");
  ASSERT_TRUE(knobs_.set("lights.filter", "wide").ok());
  EXPECT_EQ(unmet("lights.width"), "");
  ASSERT_TRUE(knobs_.set("lights.culling", "brute").ok());
  EXPECT_EQ(unmet("lights.filter"), "only with lights.culling=tiled, which is brute");
  EXPECT_EQ(unmet("lights.width"), "only with lights.culling=tiled, which is brute") << "by way of lights.filter";
}

TEST_F(Knobs, several_settings_may_be_needed_and_numbers_above_a_limit) {
  Knob count = number_knob("lights.count", Knob::Type::integer, 0, 8, 2);
  count.only_with = "lights.culling=tiled";
  Knob width = number_knob("lights.width", Knob::Type::number, 0, 1, 0.5);
  width.only_with = "shadows.maps>8 and lights.count>0";
  for (const Knob& knob : {count, width}) knobs_.add(knob);
  const auto unmet = [&] { return knobs_.unmet_setting(*knobs_.find("lights.width")); };
  ASSERT_TRUE(knobs_.set("shadows.maps", "8").ok());
  EXPECT_EQ(unmet(), "only with shadows.maps>8, which is 8");
  ASSERT_TRUE(knobs_.set("shadows.maps", "9").ok());
  EXPECT_EQ(unmet(), "");
  ASSERT_TRUE(knobs_.set("lights.count", "0").ok());
  EXPECT_EQ(unmet(), "only with lights.count>0, which is 0");
  ASSERT_TRUE(knobs_.set("lights.count", "1").ok());
  ASSERT_TRUE(knobs_.set("lights.culling", "brute").ok());
  EXPECT_EQ(unmet(), "only with lights.culling=tiled, which is brute");
}

TEST_F(Knobs, settings_that_need_each_other_end) {
  Knob one = choice_knob("a.one", {"off", "on"}, 1), two = choice_knob("a.two", {"off", "on"}, 1);
  one.only_with = "a.two=on";
  two.only_with = "a.one=on";
  knobs_.add(one);
  knobs_.add(two);
  EXPECT_EQ(knobs_.unmet_setting(*knobs_.find("a.one")), "");
}

TEST_F(Knobs, a_taste_has_no_exact_value) {
  Knob knob = choice_knob("lights.look", {"warm", "cold"});
  knob.taste = "a look";
  knob.exact = "warm";
  EXPECT_ASSERT(knobs_.add(knob), "knob lights.look: a taste has no exact value");
}

TEST_F(Knobs, json_sets_strings_and_numbers) {
  ASSERT_TRUE(
      knobs_.set_from_json(R"({"lights.culling": "brute", "shadows.maps": 4, "grass.reach": 7.5})", "k.json").ok());
  EXPECT_EQ(knob_text(knobs_, "lights.culling"), "brute");
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 4.0);
  EXPECT_EQ(knob_number(knobs_, "grass.reach"), 7.5);
  ASSERT_TRUE(knobs_.set_from_json("{}", "k.json").ok());
  ASSERT_TRUE(knobs_.set_from_json(R"({"shadows.maps": "5", "grass.reach": 1e2})", "k.json").ok());
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 5.0);
  EXPECT_EQ(knob_number(knobs_, "grass.reach"), 100.0);
}

TEST_F(Knobs, json_sets_a_choice_that_is_called_true) {
  knobs_.add(choice_knob("test.flag", {"false", "true"}));
  ASSERT_TRUE(knobs_.set_from_json(R"({"test.flag": true})", "k.json").ok());
  EXPECT_EQ(knob_number(knobs_, "test.flag"), 1.0);
}

TEST_F(Knobs, json_that_is_nested_too_deep_is_refused) {
  const std::string deep = R"({"shadows.maps":)" + std::string(200000, '[') + std::string(200000, ']') + "}";
  EXPECT_EQ(message(knobs_.set_from_json(deep, "k.json")), "k.json: is nested deeper than 96 levels");
}

TEST_F(Knobs, faults_are_one_line_whatever_was_given) {
  const std::string text = "a\nb\x01" + std::string(10000, 'x');
  for (const Status& status : {knobs_.set(text, "1"), knobs_.set("grass.reach", text), knobs_.set_assignment(text),
                               knobs_.set_from_json("{\"a\\nb\": 1}", "k.json")}) {
    EXPECT_LT(message(status).size(), 400u) << message(status);
    EXPECT_EQ(message(status).find_first_of("\n\x01"), std::string::npos) << message(status);
  }
}

TEST_F(Knobs, json_faults_name_their_source) {
  for (const char* text : {"", "[]", "3", "{", "{\"a\":}", "null", "{\"shadows.maps\": 3} x"}) {
    EXPECT_EQ(message(knobs_.set_from_json(text, "k.json")), "k.json: is not a JSON object of knobs") << text;
  }
  EXPECT_EQ(message(knobs_.set_from_json(R"({"shadows.maps": 0})", "k.json")),
            "k.json: knob shadows.maps must be an integer in 1…64, is \"0\"");
  EXPECT_THAT(message(knobs_.set_from_json(R"({"shadow.maps": 1})", "k.json")), HasSubstr("k.json: unknown knob"));
  for (const char* value : {"null", "[1]", "{}", "true", "1e999"}) {
    const std::string text = std::string("{\"shadows.maps\": ") + value + "}";
    EXPECT_THAT(message(knobs_.set_from_json(text, "k.json")), HasSubstr("k.json: ")) << value;
  }
  EXPECT_EQ(knob_number(knobs_, "shadows.maps"), 8.0);
}

TEST_F(Knobs, declaring_a_name_twice_asserts) {
  EXPECT_ASSERT(knobs_.add(choice_knob("lights.culling", {"a"})), "declared twice");
}

TEST_F(Knobs, a_default_outside_its_range_asserts) {
  EXPECT_ASSERT(knobs_.add(number_knob("test.a", Knob::Type::number, 0, 1, 2)), "default lies outside");
  EXPECT_ASSERT(knobs_.add((choice_knob("test.b", {"x", "y"}, 2))), "default lies outside");
  EXPECT_ASSERT(knobs_.add((choice_knob("test.c", {}))), "default lies outside");
}

TEST_F(Knobs, say_their_values_as_text) {
  EXPECT_EQ(value_text(*knobs_.find("lights.culling"), 0.0), "brute");
  EXPECT_EQ(value_text(*knobs_.find("grass.reach"), 0.5), "0.5");
  EXPECT_EQ(value_text(*knobs_.find("shadows.maps"), 64.0), "64");
}

TEST_F(Knobs, an_exact_value_is_one_of_theirs) {
  for (const char* exact : {"sideways", ""}) {
    Knob knob = choice_knob("x", {"a", "b"});
    knob.exact = exact;
    const bool wrong = knob.exact == "sideways";
    EXPECT_ASSERT(KnobRegistry().add(knob), wrong ? "exact value" : "no assertion failed");
  }
  Knob knob = number_knob("y", Knob::Type::integer, 1, 64, 8);
  knob.exact = "65";
  EXPECT_ASSERT(KnobRegistry().add(knob), "exact value");
}

// A host moves the resolution by a budget, as the program does: the front of a ledger names views.scale.
TEST_F(Knobs, of_the_renderer_scale_views) {
  KnobRegistry knobs;
  add_renderer_knobs(knobs);
  EXPECT_EQ(knobs.value(kViewScale), 1.0);
  ASSERT_TRUE(knobs.set("views.scale", "0.7").ok());
  EXPECT_EQ(knobs.value(kViewScale), 0.7);
  EXPECT_TRUE(knobs.find("views.scale")->scales_frame);
}

}  // namespace
}  // namespace gloam
