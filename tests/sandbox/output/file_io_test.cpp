// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/file_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace gloam {
namespace {

TEST(FileIo, what_is_written_is_read) {
  const std::string path = ::testing::TempDir() + "/gloam_file_io/deep/er/file.txt";
  ASSERT_TRUE(make_folder_of(path).ok());
  const std::string text("line\n\0with a zero", 17);
  ASSERT_TRUE(write_file(path, text).ok());
  EXPECT_EQ(*read_text_file(path, ErrorKind::usage), text);
  std::filesystem::remove_all(::testing::TempDir() + "/gloam_file_io");
}

TEST(FileIo, an_absent_file_is_an_error_of_the_callers_kind) {
  const auto read = read_text_file("/no/such/file", ErrorKind::usage);
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().kind, ErrorKind::usage);
  EXPECT_NE(read.error().message.find("/no/such/file"), std::string::npos);
  EXPECT_FALSE(read_text_file("/", ErrorKind::input).ok());
}

TEST(FileIo, a_full_disk_is_noticed) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const Status status = write_file("/dev/full", std::string(100000, 'x'));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::failed);
}

TEST(FileIo, a_name_without_a_folder_needs_none) { EXPECT_TRUE(make_folder_of("file.txt").ok()); }

}  // namespace
}  // namespace gloam
