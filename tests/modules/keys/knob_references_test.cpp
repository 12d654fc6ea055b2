// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The cost ledger can judge every knob of every module, or says why it cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/render/knobs/knobs.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/reference/reference.h"
#include "modules/module_list/module_list.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// All knobs with rows in a ledger, and what judges them.
struct Declarations {
  KnobRegistry knobs;
  std::vector<ReferenceInfo> references;
  std::vector<MeasureInfo> measures;

  [[nodiscard]] const ReferenceInfo* reference_of(const Knob& knob) const {
    const auto found = std::ranges::find(references, knob.name, &ReferenceInfo::knob);
    return found == references.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool has_measure(const Knob& knob) const {
    return std::ranges::find(measures, knob.name, &MeasureInfo::knob) != measures.end();
  }
};

Declarations all_declarations() {
  Declarations all;
  for (const auto& module : make_all_modules()) {
    module->knobs(all.knobs);
    for (ReferenceInfo& reference : module->references()) all.references.push_back(std::move(reference));
    for (MeasureInfo& measure : module->measures()) all.measures.push_back(std::move(measure));
  }
  return all;
}

/// One line for each fault in how a knob is judged.
std::vector<std::string> faults_of(const Declarations& all) {
  std::vector<std::string> faults;
  for (const Knob& knob : all.knobs.knobs()) {
    const ReferenceInfo* reference = all.reference_of(knob);
    const bool judged = reference != nullptr || all.has_measure(knob) || !knob.exact.empty();
    if (judged == !knob.taste.empty()) faults.push_back(knob.name + (judged ? ": a taste is judged" : ": not judged"));
    if (reference != nullptr && all.has_measure(knob)) faults.push_back(knob.name + ": a measure hides its reference");
    if (knob.same_picture && knob.exact.empty() && !all.has_measure(knob))
      faults.push_back(knob.name + ": no picture that all must equal");
  }
  for (const ReferenceInfo& reference : all.references) {
    const Knob* knob = all.knobs.find(reference.knob);
    const std::string& name = reference.knob;
    if (knob == nullptr) {
      faults.push_back(name + ": a reference of no knob");
      continue;
    }
    if (!reference.draw && !reference.distance) faults.push_back(name + ": a reference without function");
    if (!reference.draw && knob->exact.empty()) faults.push_back(name + ": nothing judges its pictures");
    if (static_cast<bool>(reference.distance) == reference.unit.empty()) faults.push_back(name + ": unit");
    if (reference.kind.empty() || reference.name.empty()) faults.push_back(name + ": a reference without name");
  }
  return faults;
}

Knob bare_knob() {
  Knob knob;
  knob.name = "fake.knob";
  knob.choices = {"a", "b"};
  return knob;
}

TEST(KnobReferences, every_knob_with_rows_in_a_ledger_is_judged_or_is_a_taste) {
  const Declarations all = all_declarations();
  EXPECT_GT(all.knobs.knobs().size(), 60u);
  EXPECT_THAT(faults_of(all), IsEmpty());
}

TEST(KnobReferences, the_check_finds_each_fault) {
  Declarations all;
  all.knobs.add(bare_knob());
  EXPECT_THAT(faults_of(all), ElementsAre("fake.knob: not judged"));
  all.measures.push_back({.knob = "fake.knob"});
  EXPECT_THAT(faults_of(all), IsEmpty());
  all.references.push_back({.knob = "fake.knob", .kind = "k", .name = "n"});
  EXPECT_THAT(faults_of(all),
              ElementsAre("fake.knob: a measure hides its reference", "fake.knob: a reference without function",
                          "fake.knob: nothing judges its pictures"));
  Declarations tastes;
  Knob taste = bare_knob();
  taste.taste = "a look";
  tastes.knobs.add(taste);
  EXPECT_THAT(faults_of(tastes), IsEmpty());
  tastes.measures.push_back({.knob = "fake.knob"});
  EXPECT_THAT(faults_of(tastes), ElementsAre("fake.knob: a taste is judged"));
  Declarations equal;
  Knob same = bare_knob();
  same.same_picture = true;
  equal.knobs.add(same);
  EXPECT_THAT(faults_of(equal), ElementsAre("fake.knob: not judged", "fake.knob: no picture that all must equal"));
}

TEST(KnobReferences, no_knob_has_two_references_or_two_measures) {
  const Declarations all = all_declarations();
  std::set<std::string> seen;
  for (const ReferenceInfo& reference : all.references)
    EXPECT_TRUE(seen.insert(reference.knob).second) << reference.knob;
  seen.clear();
  for (const MeasureInfo& measure : all.measures) EXPECT_TRUE(seen.insert(measure.knob).second) << measure.knob;
}

TEST(KnobReferences, the_settings_of_measures_exist) {
  for (const MeasureInfo& measure : all_declarations().measures) {
    Declarations all = all_declarations();
    EXPECT_NE(all.knobs.find(measure.knob), nullptr) << measure.knob;
    for (const auto& settings : {measure.judged_with, measure.picture})
      for (const KnobOverride& one : settings) EXPECT_TRUE(all.knobs.set(one.name, one.value).ok()) << one.name;
  }
}

/// One setting of Knob::only_with: NAME=A|B, or NAME>NUMBER.
void expect_setting(KnobRegistry& knobs, const std::string& owner, const std::string& setting) {
  const std::size_t sign = setting.find_first_of("=>");
  ASSERT_NE(sign, std::string::npos) << owner;
  const std::string other = setting.substr(0, sign);
  EXPECT_NE(other, owner);
  std::string values = setting.substr(sign + 1) + "|";
  for (std::size_t bar = values.find('|'); bar != std::string::npos; bar = values.find('|')) {
    EXPECT_TRUE(knobs.set(other, values.substr(0, bar)).ok()) << owner << " only with " << setting;
    values.erase(0, bar + 1);
  }
}

TEST(KnobReferences, a_setting_that_a_knob_needs_exists) {
  Declarations all = all_declarations();
  std::size_t count = 0;
  for (const Knob& knob : all.knobs.knobs()) {
    if (knob.only_with.empty()) continue;
    ++count;
    std::string left = knob.only_with;
    while (!left.empty()) {
      const std::size_t end = std::min(left.find(" and "), left.size());
      expect_setting(all.knobs, knob.name, left.substr(0, end));
      left.erase(0, end + std::string_view(" and ").size());
    }
  }
  EXPECT_GT(count, 20u);
}

}  // namespace
}  // namespace gloam
