// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/input_script.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gloam {
namespace {

using Kind = ScriptEvent::Kind;

std::vector<Kind> kinds_of(InputScript& script, int frames) {
  std::vector<Kind> kinds;
  for (int i = 0; i < frames; ++i) kinds.push_back(script.next([](const std::string&) { return true; }).kind);
  return kinds;
}

TEST(InputScriptTest, gives_an_event_a_frame_and_then_waits) {
  auto script = InputScript::parse("# a tour\n\nwait 2\nkey f1\nclick 10 20.5\n", "tour");
  ASSERT_TRUE(script.ok()) << script.error().message;
  EXPECT_EQ(kinds_of(*script, 7),
            (std::vector{Kind::wait, Kind::wait, Kind::key, Kind::move, Kind::press, Kind::lift, Kind::wait}));
  EXPECT_TRUE(script->ended());
}

TEST(InputScriptTest, reads_arguments) {
  const auto script =
      InputScript::parse("move -3 4.5\ntype hello world\r\nscroll -2\ndrop a b.gltf\npace 0.05", "tour");
  ASSERT_TRUE(script.ok());
  const auto& events = script->events();
  ASSERT_EQ(events.size(), 5u);
  EXPECT_EQ(events[4].kind, Kind::pace);
  EXPECT_EQ(events[4].x, 0.05);
  EXPECT_EQ(events[0].x, -3.0);
  EXPECT_EQ(events[0].y, 4.5);
  EXPECT_EQ(events[1].text, "hello world");
  EXPECT_EQ(events[2].y, -2.0);
  EXPECT_EQ(events[3].text, "a b.gltf");
}

TEST(InputScriptTest, until_waits_for_its_file) {
  auto script = InputScript::parse("until go\nclose", "tour");
  ASSERT_TRUE(script.ok());
  const auto absent = [](const std::string&) { return false; };
  EXPECT_EQ(script->next(absent).kind, Kind::until);
  EXPECT_EQ(script->next(absent).kind, Kind::until);
  EXPECT_EQ(script->next([](const std::string& path) { return path == "go"; }).kind, Kind::until);
  EXPECT_EQ(script->next(absent).kind, Kind::close);
}

TEST(InputScriptTest, waits_count_only_frames_that_show_the_last_changes) {
  auto script = InputScript::parse("wait 2\npress\nlift\nwait 1\nclose", "tour");
  ASSERT_TRUE(script.ok());
  const auto next = [&](bool settled) { return script->next([](const std::string&) { return true; }, settled).kind; };
  EXPECT_EQ(next(true), Kind::wait);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(next(false), Kind::wait);
  EXPECT_EQ(next(true), Kind::wait);
  EXPECT_EQ(next(false), Kind::press) << "other events come at once";
  EXPECT_EQ(next(false), Kind::lift);
  EXPECT_EQ(next(false), Kind::wait);
  EXPECT_EQ(next(true), Kind::wait);
  EXPECT_EQ(next(true), Kind::close);
}

TEST(InputScriptTest, moves_parts_of_a_gamepad) {
  const auto script = InputScript::parse("pad left_y -0.5\npad  right_bumper 1", "tour");
  ASSERT_TRUE(script.ok()) << script.error().message;
  EXPECT_EQ(script->events()[0].text, "left_y");
  EXPECT_EQ(script->events()[0].x, -0.5);
  EXPECT_EQ(script->events()[1].text, "right_bumper");
}

TEST(InputScriptTest, refuses_what_is_no_event) {
  for (const char* wrong : {"jump", "move 1", "move 1 2 3", "move a b", "key", "wait", "close now", "movex 1 2",
                            "pad 1", "pad left_y", "pad left_z 1", "pad left_y 1 2"}) {
    const auto script = InputScript::parse(std::string("wait 1\n") + wrong, "tour");
    ASSERT_FALSE(script.ok()) << wrong;
    EXPECT_EQ(script.error().kind, ErrorKind::usage);
    EXPECT_TRUE(script.error().message.starts_with("tour:2: ")) << script.error().message;
  }
}

}  // namespace
}  // namespace gloam
