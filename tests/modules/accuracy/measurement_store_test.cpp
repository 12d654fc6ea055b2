// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/ledger/measurement_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/core/storage/sealed_file.h"
#include "modules/accuracy/ledger/reference_cache.h"
#include "tests/modules/accuracy/ledger_rows.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using test::measured;
using test::TestFolder;
using ::testing::HasSubstr;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

TEST(measurement_store, finds_what_was_saved_under_the_same_identity_alone) {
  const TestFolder folder;
  const MeasurementStore store(folder.path() + "/made/on/demand");
  EXPECT_FALSE(store.load("a"));
  ASSERT_TRUE(store.save("a", measured(1)).ok());
  ASSERT_TRUE(store.save("b", measured(2)).ok());
  EXPECT_EQ(store.load("a"), measured(1));
  EXPECT_EQ(store.load("b"), measured(2));
  EXPECT_FALSE(store.load("c"));
  ASSERT_TRUE(store.save("a", measured(3)).ok());
  EXPECT_EQ(store.load("a"), measured(3));
}

TEST(measurement_store, does_not_take_a_file_for_one_of_another_identity) {
  const TestFolder folder;
  const MeasurementStore store(folder.path());
  ASSERT_TRUE(store.save("a", measured()).ok());
  std::filesystem::copy_file(store.path_of("a"), store.path_of("b"));
  EXPECT_FALSE(store.load("b"));
}

TEST(measurement_store, ignores_damaged_files_and_replaces_them) {
  const TestFolder folder;
  const MeasurementStore store(folder.path());
  ASSERT_TRUE(store.save("what it is of", measured()).ok());
  const std::string path = store.path_of("what it is of");
  const std::string whole = bytes_of(path);
  for (std::size_t at = 0; at < whole.size(); at += 3) {
    put(path, whole.substr(0, at));
    EXPECT_FALSE(store.load("what it is of")) << "cut at " << at;
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    put(path, flipped);
    EXPECT_FALSE(store.load("what it is of")) << "a bit flipped at " << at;
  }
  put(path, whole + " ");
  EXPECT_FALSE(store.load("what it is of"));
  ASSERT_TRUE(store.save("what it is of", measured()).ok());
  EXPECT_EQ(store.load("what it is of"), measured());
}

TEST(measurement_store, ignores_what_a_killed_writer_left) {
  const TestFolder folder;
  const MeasurementStore store(folder.path());
  put(store.path_of("a") + ".partial", "half a r");
  EXPECT_FALSE(store.load("a"));
  ASSERT_TRUE(store.save("a", measured()).ok());
  EXPECT_EQ(store.load("a"), measured());
}

TEST(measurement_store, says_where_it_cannot_write) {
  const TestFolder folder;
  put(folder.path() + "/file", "");
  const Status status = MeasurementStore(folder.path() + "/file").save("a", measured());
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::failed);
  EXPECT_THAT(status.error().message, HasSubstr(folder.path() + "/file"));
}

JudgedReference reference_of(std::uint32_t width, std::uint32_t height, bool linear, bool picture) {
  JudgedReference reference = {.noise = 0.125};
  if (linear) reference.pictures.linear = {width, height, std::vector<float>(std::size_t{width} * height * 4, 1.5f)};
  if (picture)
    reference.pictures.picture = {width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4, 7)};
  return reference;
}

TEST(reference_cache, gives_back_pictures_and_noise) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  EXPECT_FALSE(cache.load("id"));
  for (const bool linear : {false, true}) {
    for (const bool picture : {false, true}) {
      const JudgedReference reference = reference_of(5, 3, linear, picture);
      ASSERT_TRUE(cache.save("id", reference).ok());
      const auto read = cache.load("id");
      ASSERT_TRUE(read);
      EXPECT_EQ(read->noise, 0.125);
      EXPECT_EQ(read->pictures.linear.width, linear ? 5u : 0u);
      EXPECT_EQ(read->pictures.linear.rgba, reference.pictures.linear.rgba);
      EXPECT_EQ(read->pictures.picture.height, picture ? 3u : 0u);
      EXPECT_EQ(read->pictures.picture.rgba, reference.pictures.picture.rgba);
    }
  }
}

TEST(reference_cache, ignores_damaged_and_impossible_files) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  ASSERT_TRUE(cache.save("id", reference_of(4, 4, true, true)).ok());
  const std::string whole = bytes_of(cache.path_of("id"));
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    put(cache.path_of("id"), whole.substr(0, size));
    EXPECT_FALSE(cache.load("id")) << size;
  }
  // The seal is valid, but the payload is shorter than its picture size says.
  std::string huge(sizeof(double), '\0');
  huge += std::string(8, '\xff');
  ASSERT_TRUE(write_sealed(cache.path_of("id"), "id", huge).ok());
  EXPECT_FALSE(cache.load("id"));
}

}  // namespace
}  // namespace gloam
