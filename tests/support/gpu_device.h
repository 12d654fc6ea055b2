// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/env.h"
#include "engine/core/log.h"
#include "engine/gpu/vulkan_device.h"

namespace gloam::test {

/// Prints warnings and errors, so that a validation message appears beside the test that caused it.
inline LogSink& gpu_log() {
  static FunctionLog log([](LogLevel level, std::string_view line) {
    if (level >= LogLevel::warning) std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
  });
  return log;
}

/// The options of a test's device. Environment variables: GLOAM_TEST_DEVICE selects the device as
/// VulkanOptions::device does; GLOAM_TEST_PUSH_DESCRIPTORS=never sets VulkanOptions::push_descriptors.
[[nodiscard]] inline gpu::VulkanOptions test_device_options() {
  gpu::separate_driver_caches();
  gpu::VulkanOptions options;
  options.device = environment_text("GLOAM_TEST_DEVICE").value_or("auto");
  if (environment_text("GLOAM_TEST_PUSH_DESCRIPTORS") == "never")
    options.push_descriptors = gpu::PushDescriptors::never;
  options.log = &gpu_log();
  options.retained_pipelines = 1000;  // tests create the same pipelines again and again
  return options;
}

/// A Vulkan device for a test, or null if the machine has none. If the validation layer is absent, the device is not
/// validated.
[[nodiscard]] inline std::unique_ptr<gpu::Device> make_test_device(bool validate = true,
                                                                   gpu::VulkanOptions options = test_device_options()) {
  options.validate = validate;
  auto device = gpu::create_vulkan_device(options);
  if (!device && validate && device.error().kind != ErrorKind::no_device) {
    options.validate = false;
    device = gpu::create_vulkan_device(options);
  }
  if (device) return std::move(*device);
  std::fprintf(stderr, "%s\n", device.error().message.c_str());
  return nullptr;
}

/// The device of all tests of a program that need none of their own: pipelines are compiled once. Null if the machine
/// has none. A validation message in one test fails those after it, too.
[[nodiscard]] inline const std::shared_ptr<gpu::Device>& shared_test_device() {
  static const std::shared_ptr<gpu::Device> device = make_test_device();
  return device;
}

/// Skips the running test with a message if `device` is null.
#define GLOAM_REQUIRE_GPU(device) \
  if ((device) == nullptr) GTEST_SKIP() << "there is no usable Vulkan device on this machine"

/// Skips the running test on lavapipe at LP_NATIVE_VECTOR_WIDTH=512, where its compiler crashes at depth tests.
#define GLOAM_REQUIRE_DEPTH_TESTS(device)                                                    \
  if ((device)->info().name.rfind("llvmpipe", 0) == 0 && (device)->info().subgroup_size > 8) \
  GTEST_SKIP() << "lavapipe 22.3 crashes at depth tests with LP_NATIVE_VECTOR_WIDTH=512"

/// Records one frame with record(CommandList&), submits it and waits for its end. Any error fails the test.
template <class Record>
void run_frame(gpu::Device& device, Record&& record) {
  auto commands = device.begin_frame();
  ASSERT_TRUE(commands.ok()) << commands.error().message;
  record(**commands);
  const Status submitted = device.submit_frame();
  ASSERT_TRUE(submitted.ok()) << submitted.error().message;
  const Status idle = device.wait_idle();
  ASSERT_TRUE(idle.ok()) << idle.error().message;
}

/// Returns the value; on an error, fails the test and returns a default-constructed value.
template <class T>
[[nodiscard]] T value_of(Result<T> result) {
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result ? std::move(*result) : T();
}

/// An upload buffer that contains these items.
template <class T>
[[nodiscard]] gpu::BufferHandle make_upload(gpu::Device& device, std::span<const T> items) {
  using enum gpu::BufferUsage;
  const auto buffer =
      value_of(device.create_buffer({.name = "test upload",
                                     .module = "test",
                                     .size = items.size_bytes(),
                                     .usage = transfer_source | uniform | storage | vertex | index | indirect,
                                     .memory = gpu::MemoryKind::upload}));
  std::memcpy(device.mapped(buffer).data(), items.data(), items.size_bytes());
  return buffer;
}
template <class T>
[[nodiscard]] gpu::BufferHandle make_upload(gpu::Device& device, const std::vector<T>& items) {
  return make_upload(device, std::span<const T>(items));
}

/// A device buffer for storage and copies.
[[nodiscard]] inline gpu::BufferHandle make_storage(gpu::Device& device, std::uint64_t bytes) {
  using enum gpu::BufferUsage;
  return value_of(
      device.create_buffer({.name = "test storage",
                            .module = "test",
                            .size = bytes,
                            .usage = transfer_source | transfer_target | storage | indirect | index | vertex}));
}

[[nodiscard]] inline gpu::BufferHandle make_readback(gpu::Device& device, std::uint64_t bytes) {
  return value_of(device.create_buffer({.name = "test readback",
                                        .module = "test",
                                        .size = bytes,
                                        .usage = gpu::BufferUsage::transfer_target | gpu::BufferUsage::storage,
                                        .memory = gpu::MemoryKind::readback}));
}

/// The mapped bytes of a buffer as items. The frames that write the buffer must have ended.
template <class T>
[[nodiscard]] std::vector<T> items_of(gpu::Device& device, gpu::BufferHandle buffer) {
  const std::span<std::byte> bytes = device.mapped(buffer);
  std::vector<T> items(bytes.size() / sizeof(T));
  std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  return items;
}

}  // namespace gloam::test
