// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host that gives gloam all memory: pools of its own for the GPU, callbacks for the driver, an allocator for
// components. It draws the little world, has idle memory freed, and destroys everything: nothing may be left. Its
// picture must be the one that gloam draws with memory of its own. Exit code 77: there is no Vulkan device.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "checks.h"
#include "engine/core/cpu_allocator.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "vulkan_host.h"

namespace {

namespace gpu = gloam::gpu;
using host::check, host::fail, host::value_of;

/// Pools of GPU memory with a list of free ranges. A pool holds one kind of objects, so neighbours never share a page
/// of bufferImageGranularity.
class Pools final : public gpu::HostMemoryAllocator {
 public:
  explicit Pools(const gpu::HostDevice& host) : device_(host.device) {
    vkGetPhysicalDeviceMemoryProperties(host.physical_device, &properties_);
  }
  ~Pools() override {
    for (const Pool& pool : pools_) vkFreeMemory(device_, pool.memory, nullptr);
  }
  Pools(const Pools&) = delete;
  Pools& operator=(const Pools&) = delete;

  VkResult allocate(const gpu::HostMemoryRequest& request, gpu::HostMemory& memory) override {
    const std::uint32_t type = type_of(request);
    if (type == VK_MAX_MEMORY_TYPES) return VK_ERROR_FEATURE_NOT_PRESENT;
    const int kind = request.block ? 2 : request.image ? 1 : 0;
    for (Pool& pool : pools_)
      if (pool.type == type && pool.kind == kind && take(pool, request, memory)) return VK_SUCCESS;
    const VkResult added = add(type, kind, std::max(kPoolBytes, request.requirements.size));
    if (added != VK_SUCCESS) return added;
    return take(pools_.back(), request, memory) ? VK_SUCCESS : VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  void free(const gpu::HostMemory& memory) override {
    Pool& pool = *static_cast<Pool*>(memory.user);
    const VkDeviceSize size = pool.taken.at(memory.offset);
    pool.taken.erase(memory.offset);
    used_ -= size;
    auto next = pool.free.emplace(memory.offset, size).first;
    if (next != pool.free.begin()) {
      const auto before = std::prev(next);
      if (before->first + before->second == next->first) {
        before->second += next->second;
        pool.free.erase(next);
        next = before;
      }
    }
    const auto after = std::next(next);
    if (after == pool.free.end() || next->first + next->second != after->first) return;
    next->second += after->second;
    pool.free.erase(after);
  }
  [[nodiscard]] VkDeviceSize used() const { return used_; }
  [[nodiscard]] VkDeviceSize reserved() const {
    VkDeviceSize sum = 0;
    for (const Pool& pool : pools_) sum += pool.size;
    return sum;
  }

 private:
  static constexpr VkDeviceSize kPoolBytes = VkDeviceSize{16} << 20;
  struct Pool {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;
    std::uint32_t type = 0;
    int kind = 0;
    std::map<VkDeviceSize, VkDeviceSize> free, taken;  ///< sizes by offset
  };

  /// The first type with the preferred properties, or else with the required ones.
  [[nodiscard]] std::uint32_t type_of(const gpu::HostMemoryRequest& request) const {
    for (const VkMemoryPropertyFlags wanted : {request.required | request.preferred, request.required})
      for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type)
        if ((request.requirements.memoryTypeBits & (1u << type)) != 0 &&
            (properties_.memoryTypes[type].propertyFlags & wanted) == wanted)
          return type;
    return VK_MAX_MEMORY_TYPES;
  }
  VkResult add(std::uint32_t type, int kind, VkDeviceSize size) {
    Pool pool;
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = size, .memoryTypeIndex = type};
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &pool.memory);
    if (result != VK_SUCCESS) return result;
    if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
      void* begin = nullptr;
      if (vkMapMemory(device_, pool.memory, 0, VK_WHOLE_SIZE, 0, &begin) == VK_SUCCESS)
        pool.mapped = static_cast<std::byte*>(begin);
    }
    pool.size = size;
    pool.type = type;
    pool.kind = kind;
    pool.free[0] = size;
    pools_.push_back(std::move(pool));
    return VK_SUCCESS;
  }
  bool take(Pool& pool, const gpu::HostMemoryRequest& request, gpu::HostMemory& memory) {
    const VkDeviceSize alignment = request.requirements.alignment, size = request.requirements.size;
    for (const auto& [offset, free] : pool.free) {
      const VkDeviceSize begin = (offset + alignment - 1) / alignment * alignment;
      if (begin + size > offset + free) continue;
      const VkDeviceSize end = offset + free;
      if (begin > offset)
        pool.free[offset] = begin - offset;
      else
        pool.free.erase(offset);
      if (begin + size < end) pool.free[begin + size] = end - begin - size;
      pool.taken[begin] = size;
      used_ += size;
      memory = {.memory = pool.memory,
                .offset = begin,
                .mapped = request.mapped ? pool.mapped + begin : nullptr,
                .user = &pool};
      return true;
    }
    return false;
  }

  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_ = {};
  std::list<Pool> pools_;  // a list: HostMemory::user points to its elements
  VkDeviceSize used_ = 0;
};

/// Counts what the driver takes through the callbacks. Each block begins with its size.
struct DriverMemory {
  static constexpr std::size_t kHeader = 64;
  static void* allocate(void* user, std::size_t size, std::size_t alignment, VkSystemAllocationScope) {
    const std::size_t header = std::max(kHeader, alignment);
    auto* begin = static_cast<std::byte*>(std::aligned_alloc(header, (size + 2 * header - 1) / header * header));
    if (begin == nullptr) return nullptr;
    auto* bytes = begin + header;
    reinterpret_cast<std::size_t*>(bytes)[-1] = size;
    reinterpret_cast<std::size_t*>(bytes)[-2] = header;
    static_cast<DriverMemory*>(user)->live += static_cast<std::int64_t>(size);
    return bytes;
  }
  static void free(void* user, void* memory) {
    if (memory == nullptr) return;
    static_cast<DriverMemory*>(user)->live -= static_cast<std::int64_t>(static_cast<std::size_t*>(memory)[-1]);
    std::free(static_cast<std::byte*>(memory) - static_cast<std::size_t*>(memory)[-2]);
  }
  static void* reallocate(void* user, void* old, std::size_t size, std::size_t alignment,
                          VkSystemAllocationScope scope) {
    void* memory = size == 0 ? nullptr : allocate(user, size, alignment, scope);
    if (old != nullptr && memory != nullptr)
      std::copy_n(static_cast<std::byte*>(old), std::min(size, static_cast<std::size_t*>(old)[-1]),
                  static_cast<std::byte*>(memory));
    if (memory != nullptr || size == 0) free(user, old);
    return memory;
  }
  [[nodiscard]] VkAllocationCallbacks callbacks() { return {this, allocate, reallocate, free, nullptr, nullptr}; }

  std::atomic<std::int64_t> live = 0;
};

/// Memory of components and resources.
struct ComponentMemory final : gloam::CpuAllocator {
  void* allocate(std::size_t bytes, std::size_t alignment) override {
    live += static_cast<std::int64_t>(bytes);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  void free(void* memory, std::size_t bytes, std::size_t) noexcept override {
    live -= static_cast<std::int64_t>(bytes);
    std::free(memory);
  }
  std::atomic<std::int64_t> live = 0;
};

/// Draws three frames of the little world. told: prints memory before and after free_idle_memory.
std::vector<std::uint8_t> draw(const gpu::HostDevice& description, const gloam::WorldLimits& limits, const char* told) {
  const auto executor = gloam::make_pool_executor(2);
  auto device = value_of(gpu::create_vulkan_device_on(description));
  auto renderer = value_of(gloam::Renderer::create({.device = device.get(),
                                                    .executor = executor.get(),
                                                    .log = description.log,
                                                    .modules = gloam::make_all_modules()}));
  gloam::World world(limits);
  renderer->prepare_world(world);
  host::build_little_world(world, {.meshes = true, .shadows = true});
  gloam::ViewRequest view;
  view.settings.width = 240;
  view.settings.height = 136;
  view.settings.world_from_camera[3] = gloam::dvec4(0.0, 2.2, 6.0, 1.0);
  for (int frame = 0; frame < 3; ++frame) check(renderer->render(world, {&view, 1}));
  std::vector<std::uint8_t> rgba = value_of(renderer->read_picture(view.settings.id)).rgba;
  const gpu::MemoryTotals before = device->memory_totals();
  renderer->release_view(view.settings.id);
  renderer->free_idle_memory();
  const gpu::MemoryTotals after = device->memory_totals();
  std::printf("%s: %.1f MiB used of %.1f reserved; without the view %.1f of %.1f\n", told,
              static_cast<double>(before.used) / 1048576.0, static_cast<double>(before.reserved) / 1048576.0,
              static_cast<double>(after.used) / 1048576.0, static_cast<double>(after.reserved) / 1048576.0);
  if (after.used >= before.used) fail("free_idle_memory has freed nothing");
  return rgba;
}

}  // namespace

int main() {
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  gloam::LogSink& log = host::warning_log();
  gpu::separate_driver_caches();
  gpu::HostDevice description = vulkan->describe();
  description.log = &log;
  const std::vector<std::uint8_t> wanted = draw(description, {}, "gloam's own memory");
  DriverMemory driver;
  ComponentMemory components;
  VkDeviceSize reserved = 0, left = 0;
  {
    Pools pools(description);
    const VkAllocationCallbacks callbacks = driver.callbacks();
    description.memory_allocator = &pools;
    description.allocation_callbacks = &callbacks;
    gloam::WorldLimits limits;
    limits.allocator = &components;
    if (draw(description, limits, "the host's pools") != wanted) fail("the picture differs from gloam's own");
    left = pools.used();
    reserved = pools.reserved();
  }
  std::printf("pools of %.0f MiB; left: %llu bytes of the GPU, %lld of the driver, %lld of components\n",
              static_cast<double>(reserved) / 1048576.0, static_cast<unsigned long long>(left),
              static_cast<long long>(driver.live), static_cast<long long>(components.live));
  const std::uint64_t messages = vulkan->close();
  const bool right = reserved > 0 && left == 0 && driver.live == 0 && components.live == 0 && messages == 0;
  std::printf("gloam in a host's memory: %s, %llu validation messages\n", right ? "right" : "wrong",
              static_cast<unsigned long long>(messages));
  return right ? 0 : 1;
}
