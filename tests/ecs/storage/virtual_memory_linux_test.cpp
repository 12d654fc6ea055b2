// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "engine/ecs/storage/virtual_memory.h"

// What Linux counts and limits: mappings, and writable memory.

namespace gloam {
namespace {

std::size_t mapping_count() {
  std::ifstream maps("/proc/self/maps");
  return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(maps), {}, '\n'));
}

TEST(ReservedMemory, takes_no_mapping_for_each_stretch) {
  const std::size_t page = ReservedMemory::page_size();
  const std::size_t before = mapping_count();
  std::vector<ReservedMemory> many;
  for (int i = 0; i < 500; ++i) {
    many.emplace_back(page * 1000);
    for (std::size_t begin = 0; begin < page * 1000; begin += page * 100) {
      ReservedMemory::Stretch stretch{.begin = begin, .limit = begin + page * 100, .committed = begin};
      many.back().extend(stretch, begin + 1);
      many.back().data()[begin] = std::byte{1};
    }
  }
  EXPECT_LT(mapping_count(), before + 60) << "for 5,000 stretches";
}

// Where the system counts writable pages that were never written to, pages become writable one by one.
TEST(ReservedMemory, works_under_a_limit_of_writable_memory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need more writable memory than the limit";
#endif
  const pid_t process = fork();
  if (process == 0) {
    const rlimit limit{std::size_t{256} << 20, std::size_t{256} << 20};
    setrlimit(RLIMIT_DATA, &limit);
    ReservedMemory memory(std::size_t{1} << 36);
    ReservedMemory::Stretch stretch{.limit = memory.size()};
    memory.extend(stretch, std::size_t{16} << 20);
    memory.data()[(std::size_t{16} << 20) - 1] = std::byte{1};
    _exit(0);
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace gloam
