// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/once_log.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace gloam {
namespace {

using Lines = std::vector<std::pair<LogLevel, std::string>>;

TEST(OnceLog, logs_each_sentence_once) {
  Lines lines;
  FunctionLog log([&](LogLevel level, std::string_view line) { lines.emplace_back(level, line); });
  OnceLog once;
  EXPECT_TRUE(once.warning(log, "the atlas is full"));
  EXPECT_TRUE(once.warning(log, "the list is full"));
  EXPECT_FALSE(once.warning(log, "the atlas is full"));
  EXPECT_FALSE(once.warning(log, "the list is full"));
  const Lines expected = {{LogLevel::warning, "the atlas is full"}, {LogLevel::warning, "the list is full"}};
  EXPECT_EQ(lines, expected);
}

TEST(OnceLog, a_key_decides_whether_sentences_are_the_same_warning) {
  Lines lines;
  FunctionLog log([&](LogLevel level, std::string_view line) { lines.emplace_back(level, line); });
  OnceLog once;
  EXPECT_TRUE(once.warning(log, "lights.dropped", "3 lights are left out"));
  EXPECT_FALSE(once.warning(log, "lights.dropped", "4 lights are left out"));
  EXPECT_TRUE(once.warning(log, "world 1: no transform", "entity 7 has no transform"));
  EXPECT_TRUE(once.warning(log, "world 2: no transform", "entity 7 has no transform"));
  const Lines expected = {{LogLevel::warning, "3 lights are left out"},
                          {LogLevel::warning, "entity 7 has no transform"},
                          {LogLevel::warning, "entity 7 has no transform"}};
  EXPECT_EQ(lines, expected);
}

TEST(OnceLog, objects_remember_apart) {
  int lines = 0;
  FunctionLog log([&](LogLevel, std::string_view) { ++lines; });
  OnceLog first;
  OnceLog second;
  EXPECT_TRUE(first.warning(log, "the atlas is full"));
  EXPECT_TRUE(second.warning(log, "the atlas is full"));
  EXPECT_EQ(lines, 2);
}

TEST(OnceLog, a_sink_may_call_it_again) {
  std::vector<std::string> lines;
  OnceLog once;
  FunctionLog log([&](LogLevel, std::string_view line) {
    lines.emplace_back(line);
    once.warning(log, "first");
    once.warning(log, "second");
  });
  EXPECT_TRUE(once.warning(log, "first"));
  EXPECT_EQ(lines, (std::vector<std::string>{"first", "second"}));
}

TEST(OnceLog, of_many_threads_exactly_one_logs_each_sentence) {
  constexpr int kThreads = 4;
  constexpr int kSentences = 200;
  std::vector<std::atomic<int>> logged(kSentences);
  FunctionLog log([&](LogLevel, std::string_view line) { ++logged[std::stoul(std::string(line))]; });
  OnceLog once;
  std::atomic<int> claimed = 0;
  std::atomic<int> waiting = kThreads;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      for (int i = 0; i < kSentences; ++i)
        if (once.warning(log, std::to_string(i))) ++claimed;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(claimed, kSentences);
  for (int i = 0; i < kSentences; ++i) EXPECT_EQ(logged[i], 1) << i;
}

}  // namespace
}  // namespace gloam
