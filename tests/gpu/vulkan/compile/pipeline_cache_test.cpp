// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/pipeline_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "shaders/gpu_test/shaders.h"
#include "tests/support/gpu_device.h"

namespace gloam::gpu {
namespace {

namespace fs = std::filesystem;

class PipelineCacheFile : public ::testing::Test {
 protected:
  void SetUp() override {
    // Several processes may run this suite at the same time.
    directory_ = fs::path(GLOAM_BINARY_DIR) / "test_output" / ("pipeline_cache_" + std::to_string(::getpid())) /
                 ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(directory_);
    GLOAM_REQUIRE_GPU(test::make_test_device(false));
  }
  void TearDown() override { fs::remove_all(directory_.parent_path()); }

  std::unique_ptr<Device> open() {
    auto device = create_vulkan_device({.cache_directory = directory_.string(), .log = &log_});
    return device ? std::move(*device) : nullptr;
  }
  /// Opens a device, compiles a pipeline and closes the device again, which writes the file.
  void use_device() {
    auto device = open();
    ASSERT_NE(device, nullptr);
    const auto pipeline = device->create_pipeline({.name = "p", .shader = shaders::gpu_test::paint_comp});
    EXPECT_TRUE(pipeline.ok());
  }
  std::vector<fs::path> files() const {
    if (!fs::exists(directory_)) return {};
    return {fs::directory_iterator(directory_), fs::directory_iterator()};
  }
  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  fs::path directory_;
  std::atomic<int> complaints_ = 0;
  std::atomic<int> warnings_ = 0;
  FunctionLog log_{[this](LogLevel level, std::string_view line) {
    if (line.find("damaged or of another driver") != std::string_view::npos) ++complaints_;
    if (level >= LogLevel::warning) ++warnings_;
  }};
};

TEST_F(PipelineCacheFile, is_written_when_the_device_closes_and_read_by_the_next_one) {
  use_device();
  ASSERT_EQ(files().size(), 1u);  // and no temporary file beside it
  EXPECT_GT(fs::file_size(files()[0]), 32u);
  use_device();
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EQ(complaints_, 0);
  EXPECT_EQ(warnings_, 0);
}

TEST_F(PipelineCacheFile, counts_as_absent_when_damaged_and_is_written_anew) {
  use_device();
  const fs::path file = files().at(0);
  const std::string whole = read(file);
  std::string flipped = whole;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
  for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() - 1), whole + "x", flipped}) {
    complaints_ = warnings_ = 0;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << damaged;
    use_device();
    EXPECT_EQ(complaints_, 1);
    EXPECT_EQ(warnings_, 1);
    EXPECT_EQ(read(file).size(), whole.size());
  }
}

TEST_F(PipelineCacheFile, a_folder_in_its_place_costs_a_warning) {
  use_device();
  const fs::path file = files().at(0);
  fs::remove(file);
  fs::create_directory(file);
  use_device();
  EXPECT_EQ(warnings_, 1);
  EXPECT_TRUE(fs::is_directory(file));
}

TEST_F(PipelineCacheFile, a_directory_that_cannot_be_made_costs_a_warning) {
  fs::create_directories(directory_.parent_path());
  std::ofstream(directory_) << "a file stands where the directory should be";
  use_device();
  EXPECT_EQ(warnings_, 1);
}

}  // namespace
}  // namespace gloam::gpu
