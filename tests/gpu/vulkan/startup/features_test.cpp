// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/features.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "engine/gpu/vulkan/startup/functions.h"
#include "shaders/every/shaders.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/spirv_needs.h"

namespace gloam::gpu::vulkan {
namespace {

using Names = std::set<std::string>;

/// The features that calls of these functions need.
const std::map<std::string_view, std::string_view> kFeaturesOfFunctions = {
    {"vkCmdBeginRendering", "dynamicRendering"},
    {"vkCmdEndRendering", "dynamicRendering"},
    {"vkCmdPipelineBarrier2", "synchronization2"},
    {"vkCmdSetEvent2", "synchronization2"},
    {"vkCmdWaitEvents2", "synchronization2"},
    {"vkCmdWriteTimestamp2", "synchronization2"},
    {"vkQueueSubmit2", "synchronization2"},
    {"vkGetSemaphoreCounterValue", "timelineSemaphore"},
    {"vkSignalSemaphore", "timelineSemaphore"},
    {"vkWaitSemaphores", "timelineSemaphore"},
    {"vkGetDeviceBufferMemoryRequirements", "maintenance4"},
    {"vkGetDeviceImageMemoryRequirements", "maintenance4"},
    {"vkResetQueryPool", "hostQueryReset"},
    {"vkGetBufferDeviceAddress", "bufferDeviceAddress"},
    {"vkCmdDrawIndirectCount", "drawIndirectCount"},
    {"vkCmdDrawIndexedIndirectCount", "drawIndirectCount"},
    {"vkCreatePrivateDataSlot", "privateData"},
};

Names device_functions() {
#define NAME(name) #name,
  return {GLOAM_VULKAN_DEVICE_FUNCTIONS(NAME)};
#undef NAME
}

Names required(bool of_shaders) {
  Names names;
  for (const RequiredFeature& feature : required_features()) {
    if (feature.of_shaders == of_shaders) names.emplace(feature.name);
  }
  return names;
}

Names needs_of(const ShaderCode& shader) {
  const test::SpirvNeeds needs = test::find_spirv_needs(shader.words);
  EXPECT_EQ(needs.unknown, Names()) << shader.name << ": extend the tables of spirv_needs.h";
  return needs.features;
}

// Hard case: passes.features
TEST(RequiredFeatures, of_shaders_are_exactly_those_that_their_spirv_needs) {
  Names needed;
  for (const ShaderCode* shader : every_shader()) needed.merge(needs_of(*shader));
  EXPECT_EQ(required(true), needed);
}

TEST(RequiredFeatures, of_calls_are_exactly_those_of_the_functions_that_are_called) {
  Names needed;
  for (const std::string& function : device_functions()) {
    const auto found = kFeaturesOfFunctions.find(function);
    if (found != kFeaturesOfFunctions.end()) needed.emplace(found->second);
  }
  for (const std::string& of_shaders : required(true)) needed.erase(of_shaders);
  EXPECT_EQ(required(false), needed);
}

TEST(RequiredFeatures, of_calls_name_a_function_that_needs_them) {
  const Names functions = device_functions();
  for (const RequiredFeature& feature : required_features()) {
    if (feature.of_shaders) continue;
    EXPECT_TRUE(functions.count(std::string(feature.needed_by)) == 1) << feature.needed_by;
    const auto found = kFeaturesOfFunctions.find(feature.needed_by);
    ASSERT_NE(found, kFeaturesOfFunctions.end()) << feature.needed_by;
    EXPECT_EQ(found->second, feature.name);
  }
}

TEST(RequiredFeatures, are_found_in_the_spirv_of_shaders_known_to_need_them) {
  using namespace shaders::gpu_test;
  EXPECT_EQ(needs_of(look_comp).count("imageCubeArray"), 1u);
  EXPECT_EQ(needs_of(layouts_comp).count("scalarBlockLayout"), 1u);
  EXPECT_EQ(needs_of(double_numbers_comp).count("scalarBlockLayout"), 0u);
  EXPECT_EQ(needs_of(add_in_place_comp).count("shaderStorageImageExtendedFormats"), 1u);
  EXPECT_EQ(needs_of(double_numbers_comp).count("maintenance4"), 1u);
  EXPECT_EQ(needs_of(triangle_vert).count("maintenance4"), 0u);
}

TEST(RequiredFeatures, that_are_off_are_named) {
  Features all;
  require_features(all.core.features, all.v12, all.v13);
  EXPECT_EQ(missing_features(all), "");
  all.v13.synchronization2 = VK_FALSE;
  all.core.features.shaderStorageImageExtendedFormats = VK_FALSE;
  EXPECT_EQ(missing_features(all), "shaderStorageImageExtendedFormats, synchronization2");
}

}  // namespace
}  // namespace gloam::gpu::vulkan
