// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/caster_states.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace gloam {
namespace {

CasterState state(std::uint64_t hash, bool unsteady = false) {
  const dvec3 at(static_cast<double>(hash));
  return {hash, unsteady, {at, at}};
}
std::vector<double> changed(const CasterHistory& history) {
  std::vector<double> found;
  for (const CasterBox& box : history.changed()) found.push_back(box.low.x);
  return found;
}
using Changed = std::vector<double>;

TEST(CasterHistory, tells_what_came_went_and_changed) {
  CasterHistory history;
  history = history.advanced({state(1), state(2), state(3)});
  EXPECT_EQ(history.frame(), 1u);
  EXPECT_EQ(changed(history), (Changed{1, 2, 3}));
  history = history.advanced({state(1), state(2), state(3)});
  EXPECT_EQ(changed(history), Changed{});
  history = history.advanced({state(1), state(7), state(3)});
  EXPECT_EQ(changed(history), (Changed{2, 7})) << "where it was and where it is";
  history = history.advanced({state(7), state(3)});
  EXPECT_EQ(changed(history), Changed{1}) << "others have moved up in the list, that is all";
  history = history.advanced({state(9), state(7), state(3)});
  EXPECT_EQ(changed(history), Changed{9});
  EXPECT_EQ(history.frame(), 5u);
}

/// A state of a certain entity, for changed(light).
CasterState state_of(std::uint32_t entity, std::uint64_t hash, bool unsteady = false) {
  CasterState made = state(hash, unsteady);
  made.entity = {entity, 1};
  return made;
}
constexpr Entity kLight = {50, 1};
WithheldCasters withheld(std::vector<Entity> casters) { return {{{kLight, std::move(casters)}}}; }
Changed changed_of(const CasterHistory& history, Entity light = kLight) {
  Changed found;
  for (const CasterBox& box : history.changed(light)) found.push_back(box.low.x);
  return found;
}

TEST(CasterHistory, withheld_casters_that_change_are_no_news_for_their_light) {
  CasterHistory history;
  history.withhold(withheld({{2, 1}, {3, 1}}));
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(3, 30)});
  EXPECT_EQ(changed_of(history), Changed{10});
  history = history.advanced({state_of(1, 10), state_of(2, 21), state_of(3, 30, true)});
  EXPECT_EQ(changed_of(history), Changed{});
  EXPECT_EQ(changed_of(history, {51, 1}), (Changed{20, 30, 21, 30}));
  EXPECT_EQ(changed(history), (Changed{20, 30, 21, 30}));
  history = history.advanced({state_of(1, 11), state_of(3, 31)});
  EXPECT_EQ(changed_of(history), (Changed{10, 11}));
}

TEST(CasterHistory, casters_are_news_where_they_go_from_when_they_are_withheld_and_where_they_come_back) {
  CasterHistory history;
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 25)});
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 25)});
  EXPECT_EQ(changed_of(history), Changed{});
  history.withhold(withheld({{2, 1}}));
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 25)});
  EXPECT_EQ(changed_of(history), (Changed{20, 25})) << "all its primitives";
  EXPECT_EQ(changed(history), Changed{});
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 26)});
  EXPECT_EQ(changed_of(history), Changed{});
  history.withhold({});
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 26)});
  EXPECT_EQ(changed_of(history), (Changed{20, 26}));
  history = history.advanced({state_of(1, 10), state_of(2, 20), state_of(2, 26)});
  EXPECT_EQ(changed_of(history), Changed{});
}

TEST(CasterHistory, casters_that_move_while_they_are_withheld_or_come_back_are_news_at_one_place) {
  const auto places = [](Changed found) {
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  };
  CasterHistory history;
  history = history.advanced({state_of(2, 20)});
  history.withhold(withheld({{2, 1}}));
  history = history.advanced({state_of(2, 21)});
  EXPECT_EQ(places(changed_of(history)), Changed{20});
  history.withhold({});
  history = history.advanced({state_of(2, 22)});
  EXPECT_EQ(places(changed_of(history)), Changed{22});
}

TEST(CasterHistory, of_two_that_change_places_only_the_one_that_is_withheld_is_no_news) {
  CasterHistory history;
  history.withhold(withheld({{2, 1}}));
  history = history.advanced({state_of(1, 10), state_of(2, 20)});
  history = history.advanced({state_of(1, 20), state_of(2, 10)});
  EXPECT_EQ(changed_of(history), (Changed{10, 20}));
}

TEST(CasterHistory, unsteady_casters_change_every_frame) {
  CasterHistory history;
  for (int i = 0; i < 3; ++i) history = history.advanced({state(1), state(2, true)});
  EXPECT_EQ(changed(history), (Changed{2, 2}));
}

TEST(CasterHistory, one_of_two_equal_casters_goes) {
  CasterHistory history;
  history = history.advanced({state(4), state(4), state(5)});
  history = history.advanced({state(4), state(5)});
  EXPECT_EQ(changed(history), Changed{4});
}

TEST(CasterHistory, casters_rest_that_have_not_changed_for_long) {
  CasterHistory history;
  history = history.advanced({state(1), state(2), state(3, true)});
  history = history.advanced({state(1), state(9), state(3, true)});
  EXPECT_TRUE(history.rests(0)) << "it has never changed";
  EXPECT_FALSE(history.rests(1));
  EXPECT_FALSE(history.rests(2));
  for (std::uint64_t i = 1; i < CasterHistory::kRestFrames; ++i)
    history = history.advanced({state(9), state(1), state(3, true)});
  EXPECT_FALSE(history.rests(0)) << "wherever in the list it is";
  EXPECT_TRUE(history.rests(1));
  history = history.advanced({state(9), state(1), state(3, true)});
  EXPECT_TRUE(history.rests(0));
  EXPECT_FALSE(history.rests(2)) << "unsteady ones never do";
}

TEST(SourceStates, sources_of_which_nothing_is_told_are_unsteady_and_take_no_turns) {
  CasterSource told, untold, turning;
  told.content_hash = 7;
  turning.content_hash = 7;
  for (CasterSource* source : {&untold, &turning}) source->turns = 4;
  turning.moving = true;
  const CasterSource* sources[] = {&told, &untold, &turning};
  const std::vector<CasterState> states = source_states(sources);
  EXPECT_FALSE(states[0].unsteady);
  EXPECT_TRUE(states[1].unsteady);
  EXPECT_EQ(states[1].box.turns, 1u);
  EXPECT_TRUE(states[2].unsteady);
  EXPECT_EQ(states[2].box.turns, 4u);
}

TEST(CasterStates, depend_on_the_pose_and_are_steady_where_it_is_known) {
  const auto executor = make_serial_executor();
  GpuPrimitive primitive;
  std::vector<Caster> casters(2);
  for (Caster& caster : casters) caster.primitive = &primitive;
  casters[1].moving = true;
  const std::uint64_t rest[] = {0, 11}, bent[] = {0, 12}, lost[] = {0, 0};
  const auto a = caster_states(casters, rest, *executor), b = caster_states(casters, bent, *executor),
             c = caster_states(casters, lost, *executor);
  EXPECT_EQ(a[0].hash, b[0].hash);
  EXPECT_NE(a[1].hash, b[1].hash);
  EXPECT_FALSE(a[1].unsteady);
  EXPECT_TRUE(c[1].unsteady);
  EXPECT_FALSE(c[0].unsteady);
}

}  // namespace
}  // namespace gloam
