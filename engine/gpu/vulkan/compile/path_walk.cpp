// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/path_walk.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "engine/gpu/spirv/many_selections.h"
#include "engine/gpu/spirv/split_selections.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr std::uint32_t kSelections = 20;
constexpr double kLeastRatio = 4.0;  ///< of the times of both forms; other compilers are below 1.5
constexpr int kRuns = 2;

constexpr const char* kName = "path walk";  ///< of all objects of the measurement

/// A pipeline layout with one storage buffer.
class ProbeLayout {
 public:
  explicit ProbeLayout(Context& context) : context_(context) {
    const VkDescriptorSetLayoutBinding buffer = {.binding = 0,
                                                 .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                 .descriptorCount = 1,
                                                 .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 1, .pBindings = &buffer};
    if (null_on_failure(context.vk.vkCreateDescriptorSetLayout(context.device, &set, context.allocation, &set_),
                        set_) != VK_SUCCESS)
      return;
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &set_};
    const VkResult result = null_on_failure(
        context.vk.vkCreatePipelineLayout(context.device, &layout, context.allocation, &layout_), layout_);
    context.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_, kName);
    if (result == VK_SUCCESS) context.set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_, kName);
  }
  ~ProbeLayout() {
    context_.vk.vkDestroyPipelineLayout(context_.device, layout_, context_.allocation);
    context_.vk.vkDestroyDescriptorSetLayout(context_.device, set_, context_.allocation);
  }
  ProbeLayout(const ProbeLayout&) = delete;
  ProbeLayout& operator=(const ProbeLayout&) = delete;
  [[nodiscard]] VkPipelineLayout handle() const { return layout_; }

 private:
  Context& context_;
  VkDescriptorSetLayout set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

/// Seconds that the driver takes for a pipeline of the shader; 0 if it refuses.
double compile_time(Context& context, VkPipelineLayout layout, std::span<const std::uint32_t> words) {
  const auto start = std::chrono::steady_clock::now();
  const VkShaderModuleCreateInfo module_info = {
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = words.size_bytes(), .pCode = words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  if (context.vk.vkCreateShaderModule(context.device, &module_info, context.allocation, &module) != VK_SUCCESS)
    return 0.0;
  const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                            .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                      .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                      .module = module,
                                                      .pName = "main"},
                                            .layout = layout};
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result =
      context.vk.vkCreateComputePipelines(context.device, VK_NULL_HANDLE, 1, &info, context.allocation, &pipeline);
  const Seconds taken = std::chrono::steady_clock::now() - start;
  context.set_name(VK_OBJECT_TYPE_SHADER_MODULE, module, kName);
  if (result == VK_SUCCESS) context.set_name(VK_OBJECT_TYPE_PIPELINE, pipeline, kName);
  context.vk.vkDestroyPipeline(context.device, pipeline, context.allocation);
  context.vk.vkDestroyShaderModule(context.device, module, context.allocation);
  return result == VK_SUCCESS ? taken.count() : 0.0;
}

bool measure(Context& context) {
  const std::vector<std::uint32_t> joined = spirv::many_selections(kSelections);
  const std::vector<std::uint32_t> split = spirv::split_selections(joined);
  const ProbeLayout layout(context);
  if (layout.handle() == VK_NULL_HANDLE) return false;
  double joined_time = std::numeric_limits<double>::max(), split_time = joined_time;
  for (int i = 0; i < kRuns; ++i) {
    split_time = std::min(split_time, compile_time(context, layout.handle(), split));
    joined_time = std::min(joined_time, compile_time(context, layout.handle(), joined));
    if (joined_time < kLeastRatio * split_time) return false;
  }
  return true;
}

}  // namespace

bool walks_all_paths(Context& context) {
  using Driver = std::tuple<std::uint32_t, std::uint32_t, std::array<std::uint8_t, VK_UUID_SIZE>>;
  static std::mutex mutex;
  static std::map<Driver, bool> known;
  const std::lock_guard lock(mutex);
  const auto [place, fresh] =
      known.try_emplace(Driver(context.physical.vendor, context.physical.device, context.physical.cache_uuid));
  if (fresh) place->second = measure(context);
  return place->second;
}

}  // namespace gloam::gpu::vulkan
