// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/storage/sealed_file.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/expect_assert.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(SealedFile, keeps_any_bytes) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  for (const std::string& payload : {std::string(), std::string("\n\0\r\n\xff", 5), std::string(100000, 'x')}) {
    ASSERT_TRUE(write_sealed(path, "id", payload).ok());
    EXPECT_EQ(read_sealed(path, "id"), payload);
  }
  EXPECT_ASSERT((void)write_sealed(path, "two\nlines", ""), "one line");
}

TEST(SealedFile, of_another_identity_cut_short_or_altered_is_not_read) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/new folder/sealed";
  ASSERT_TRUE(write_sealed(path, "id", "payload").ok());
  EXPECT_FALSE(read_sealed(path, "other"));
  EXPECT_FALSE(read_sealed(path + "-absent", "id"));
  const std::string good = bytes_of(path);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string altered = good;
    altered[i] = static_cast<char>(altered[i] ^ 1);
    ASSERT_TRUE(write_whole_file(path, altered).ok());
    EXPECT_FALSE(read_sealed(path, "id")) << "byte " << i;
    ASSERT_TRUE(write_whole_file(path, good.substr(0, i)).ok());
    EXPECT_FALSE(read_sealed(path, "id")) << i << " bytes";
  }
}

TEST(SealedFile, that_is_not_read_has_a_reason) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  const auto fault_of = [](const std::string& file) {
    SealedFault fault = SealedFault::none;
    EXPECT_FALSE(read_sealed(file, "id", &fault));
    return fault;
  };
  EXPECT_EQ(fault_of(path), SealedFault::absent);
  EXPECT_EQ(fault_of(folder.path()), SealedFault::not_a_file);
  for (const std::string& text : {std::string(), std::string(4096, '\0'), std::string("gloam sealed 1 ")}) {
    ASSERT_TRUE(write_whole_file(path, text).ok());
    EXPECT_EQ(fault_of(path), SealedFault::damaged) << text;
  }
  ASSERT_TRUE(write_sealed(path, "id 2", "payload").ok());
  EXPECT_EQ(fault_of(path), SealedFault::other);
  ASSERT_TRUE(write_sealed(path, "id", "").ok());
  SealedFault fault = SealedFault::damaged;
  EXPECT_EQ(read_sealed(path, "id", &fault), "");
  EXPECT_EQ(fault, SealedFault::none);
}

}  // namespace
}  // namespace gloam
