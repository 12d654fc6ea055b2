// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/storage/sealed_file.h"
#include "tests/support/temporary_folder.h"

// Sealed files of several processes, of processes that are killed, on full disks, behind links and with permissions.

namespace gloam {
namespace {

/// Runs a function in a process and returns its exit status; -1 if it did not exit.
int status_of_process(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
pid_t start_process(const std::function<int()>& run) {
  const pid_t process = fork();
  if (process == 0) _exit(run());
  return process;
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

TEST(SealedFile, that_several_processes_write_is_whole_at_any_time) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  const auto payload = [](int writer) {
    return std::string(static_cast<std::size_t>(100'000 + 70'000 * writer), static_cast<char>('a' + writer));
  };
  ASSERT_TRUE(write_sealed(path, "id", payload(0)).ok());
  std::vector<pid_t> writers;
  for (int writer = 0; writer < 3; ++writer) {
    writers.push_back(start_process([&] {
      int faults = 0;
      for (int round = 0; round < 60; ++round) {
        faults += write_sealed(path, "id", payload(writer)).ok() ? 0 : 1;
        const std::optional<std::string> read = read_sealed(path, "id");
        faults += read == payload(0) || read == payload(1) || read == payload(2) ? 0 : 1;
      }
      return faults;
    }));
  }
  for (const pid_t writer : writers) EXPECT_EQ(status_of_process(writer), 0);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"sealed"}) << "nothing else is left";
}

// A limit of the size of files fails as a full disk does: after a part was written.
TEST(SealedFile, that_does_not_fit_leaves_the_old_one_and_nothing_else) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  ASSERT_TRUE(write_sealed(path, "id", "old").ok());
  const auto write_too_much = [](const std::string& file) {
    return start_process([file] {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{8192, 8192};
      if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
      const Status written = write_sealed(file, "id", std::string(1'000'000, 'x'));
      return !written.ok() && written.error().message.find("cannot be written") != std::string::npos ? 0 : 1;
    });
  };
  EXPECT_EQ(status_of_process(write_too_much(path)), 0);
  EXPECT_EQ(read_sealed(path, "id"), "old");
  EXPECT_EQ(status_of_process(write_too_much(folder.path() + "/other")), 0);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"sealed"});
}

TEST(SealedFile, removes_what_killed_writers_of_the_same_file_have_left) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  const auto killed = [](const std::string& file) {  // by the first byte beyond the limit
    const pid_t process = start_process([file] {
      const rlimit limit{8192, 8192};
      if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
      return write_sealed(file, "id", std::string(1'000'000, 'x')).ok() ? 0 : 1;
    });
    EXPECT_EQ(status_of_process(process), -1) << "killed";
  };
  killed(path);
  ASSERT_EQ(names_in(folder.path()).size(), 1u);
  const std::string left = names_in(folder.path())[0];
  ASSERT_TRUE(left.starts_with(".gloam-") && left.ends_with(".partial")) << left;
  // .gloam-TARGET-HOST-PROCESS-UNIQUE.partial: of another host, and of a process that runs.
  const std::size_t host = left.find('-', 7) + 1, process = left.find('-', host) + 1;
  std::string of_other_host = left, of_this_process = left;
  of_other_host[host] = left[host] == '0' ? '1' : '0';
  char number[16];
  std::snprintf(number, sizeof(number), "%x", static_cast<unsigned>(getpid()));
  of_this_process.replace(process, left.find('-', process) - process, number);
  for (const std::string& name : {of_other_host, of_this_process})
    ASSERT_TRUE(write_whole_file(folder.path() + "/" + name, "part").ok());

  ASSERT_TRUE(write_sealed(folder.path() + "/other", "id", "payload").ok());
  EXPECT_TRUE(std::filesystem::exists(folder.path() + "/" + left)) << "of another target";
  ASSERT_TRUE(write_sealed(path, "id", "payload").ok());
  const std::vector<std::string> found = names_in(folder.path());
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()),
            (std::set<std::string>{"sealed", "other", of_other_host, of_this_process}));
}

TEST(SealedFile, a_signal_whose_handler_removes_unfinished_files_leaves_none) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  ASSERT_TRUE(write_sealed(path, "id", "old").ok());
  const pid_t process = start_process([&path] {
    std::signal(SIGXFSZ, [](int number) {  // in the middle of a file
      remove_unfinished_files();
      std::signal(number, SIG_DFL);
      std::raise(number);
    });
    const rlimit limit{8192, 8192};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 2;
    return write_sealed(path, "id", std::string(1'000'000, 'x')).ok() ? 0 : 1;
  });
  EXPECT_EQ(status_of_process(process), -1) << "killed";
  EXPECT_EQ(read_sealed(path, "id"), "old");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"sealed"});
}

TEST(SealedFile, that_a_link_names_is_replaced_and_the_link_stays) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed", link = folder.path() + "/link";
  ASSERT_TRUE(write_sealed(path, "id", "old").ok());
  std::filesystem::create_symlink("sealed", link);
  ASSERT_TRUE(write_sealed(link, "id", "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_sealed(path, "id"), "new");
}

TEST(SealedFile, a_link_to_a_file_that_is_not_there_makes_the_file) {
  const test::TestFolder folder;
  std::filesystem::create_directory(folder.path() + "/there");
  std::filesystem::create_symlink("second", folder.path() + "/first");
  std::filesystem::create_symlink("there/file", folder.path() + "/second");
  ASSERT_TRUE(write_whole_file(folder.path() + "/first", "bytes").ok());
  EXPECT_EQ(std::filesystem::file_size(folder.path() + "/there/file"), 5u);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() + "/second"));
  std::filesystem::create_symlink("round", folder.path() + "/round");
  EXPECT_FALSE(write_whole_file(folder.path() + "/round", "bytes").ok());
}

TEST(SealedFile, keeps_the_permissions_of_the_old_one) {
  const test::TestFolder folder;
  const std::string path = folder.path() + "/sealed";
  ASSERT_TRUE(write_sealed(path, "id", "old").ok());
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  ASSERT_TRUE(write_sealed(path, "id", "new").ok());
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

}  // namespace
}  // namespace gloam
