// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/program_knobs.h"

#include <gtest/gtest.h>

#include <string>

#include "modules/module_list/module_list.h"
#include "modules/reflections/module.h"

namespace gloam {
namespace {

bool recaptures(Command command, const std::string& assignment = {}) {
  Options options;
  options.command = command;
  if (!assignment.empty()) options.assignments.push_back(assignment);
  KnobRegistry knobs = all_knobs(make_all_modules());
  EXPECT_TRUE(set_knobs(knobs, options).ok());
  return knobs.value(kReflectionRecapture);
}

TEST(ProgramKnobs, play_alone_captures_again_unless_the_user_sets_the_knob) {
  EXPECT_TRUE(recaptures(Command::play));
  EXPECT_TRUE(recaptures(Command::play, "ssr.reach=4"));
  EXPECT_FALSE(recaptures(Command::play, "reflections.recapture=off"));
  for (const Command command : {Command::render, Command::bench, Command::cost, Command::selftest})
    EXPECT_FALSE(recaptures(command));
  EXPECT_TRUE(recaptures(Command::render, "reflections.recapture=budget"));
}

}  // namespace
}  // namespace gloam
