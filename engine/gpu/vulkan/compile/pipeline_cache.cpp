// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/pipeline_cache.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/storage/sealed_file.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

namespace fs = std::filesystem;

/// Precedes the driver's data in the file. Drivers may crash on damaged data, so only data with a correct hash reaches
/// them.
struct FileHeader {
  std::uint64_t magic = 0x3163656e69706c67ull;
  std::uint64_t bytes = 0;
  std::uint64_t hash = 0;
};

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t b : bytes) {
    text += kDigits[b >> 4];
    text += kDigits[b & 15];
  }
  return text;
}

std::vector<std::byte> read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> chars{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(chars));
  return {bytes.begin(), bytes.end()};
}

bool of_this_driver(const PhysicalDevice& device, std::span<const std::byte> data) {
  VkPipelineCacheHeaderVersionOne header;
  if (data.size() < sizeof header) return false;
  std::memcpy(&header, data.data(), sizeof header);
  return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == device.vendor &&
         header.deviceID == device.device &&
         std::memcmp(header.pipelineCacheUUID, device.cache_uuid.data(), device.cache_uuid.size()) == 0;
}

/// The driver's data, or an empty span if the file is damaged or of another driver.
std::span<const std::byte> checked(const PhysicalDevice& device, std::span<const std::byte> file) {
  FileHeader header;
  if (file.size() < sizeof header) return {};
  std::memcpy(&header, file.data(), sizeof header);
  const auto data = file.subspan(sizeof header);
  const bool whole =
      header.magic == FileHeader().magic && header.bytes == data.size() && header.hash == hash_bytes(data);
  return whole && of_this_driver(device, data) ? data : std::span<const std::byte>();
}

}  // namespace

PipelineCache::PipelineCache(Context& context, const std::string& directory) : context_(context) {
  std::vector<std::byte> file;
  std::span<const std::byte> data;
  if (!directory.empty()) {
    file_ = fs::path(directory) / ("pipelines-" + hex(context.physical.cache_uuid) + ".bin");
    std::error_code absent;
    if (fs::is_regular_file(file_, absent)) {  // reading a folder throws
      file = read_file(file_);
      data = checked(context.physical, file);
      if (data.empty())
        context.log().warning(file_.string() + ": is damaged or of another driver; the pipeline cache is made again");
    }
  }
  VkPipelineCacheCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                    .initialDataSize = data.size(),
                                    .pInitialData = data.data()};
  VkResult result = context.vk.vkCreatePipelineCache(context.device, &info, context.allocation, &cache_);
  if (result != VK_SUCCESS) {
    cache_ = VK_NULL_HANDLE;
    context.log().warning("No pipeline cache: " + describe(result));
    return;
  }
  context.set_name(VK_OBJECT_TYPE_PIPELINE_CACHE, cache_, "pipelines");
}

PipelineCache::~PipelineCache() {
  if (cache_ == VK_NULL_HANDLE) return;
  if (!file_.empty()) save();
  context_.vk.vkDestroyPipelineCache(context_.device, cache_, context_.allocation);
}

void PipelineCache::save() const {
  std::size_t size = 0;
  context_.vk.vkGetPipelineCacheData(context_.device, cache_, &size, nullptr);
  std::vector<char> data(size);
  if (context_.vk.vkGetPipelineCacheData(context_.device, cache_, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);

  FileHeader header;
  header.bytes = size;
  header.hash = hash_bytes(std::as_bytes(std::span(data)));
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(data.data(), data.size());
  if (const Status written = write_whole_file(file_.string(), bytes); !written.ok())
    context_.log().warning("The pipeline cache could not be written: " + written.error().message);
}

}  // namespace gloam::gpu::vulkan
