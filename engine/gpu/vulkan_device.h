// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam::gpu {

/// How the resources of set 0, which CommandList::bind takes, get to the device.
enum class PushDescriptors : std::uint8_t {
  automatic,  ///< pushed where the device has VK_KHR_push_descriptor, otherwise in descriptor sets from pools
  never,      ///< in descriptor sets from pools
};

struct VulkanOptions {
  /// "auto" (prefers discrete, then integrated, then other devices, then cpu), "cpu", "gpu" (any type but cpu), or part
  /// of a device's name in any case.
  std::string device = "auto";
  bool validate = false;        ///< enables validation with synchronization checks; messages are logged and counted
  std::string cache_directory;  ///< directory of the pipeline cache file; empty: pipelines are not kept between runs
  /// How many compiled pipelines the device keeps after their destruction (the newest ones). A pipeline that is created
  /// again with the same code, constants and state is then not compiled again. 0: none.
  std::size_t retained_pipelines = 0;
  LogSink* log = nullptr;  ///< must outlive the device; null: nothing is logged
  MemoryOptions memory;
  /// vkGetInstanceProcAddr of a Vulkan loader that the caller has opened; null: of the system's libvulkan.
  void (*get_instance_proc_addr)() = nullptr;
  /// The instance extensions that the window system requires; empty: no window.
  std::vector<std::string> window_extensions;
  /// Creates a surface of the window, as for create_swapchain; called once, and the surface is destroyed after the
  /// choice. Only devices that can present to it are chosen. Null: any device with VK_KHR_swapchain can be chosen.
  std::function<std::uint64_t(void* instance)> create_surface;
  PushDescriptors push_descriptors = PushDescriptors::automatic;
  /// Replaces DeviceInfo::threads_in_turn, so that tests run the kernel variants of another kind of device.
  std::optional<bool> threads_in_turn;
  /// Whether shaders with many paths through a loop are compiled in the form that suits compilers which walk all of
  /// them. Empty: where the compiler is measured to do so.
  std::optional<bool> split_selections;
};

/// Fails with ErrorKind::no_device if no device fits; the error lists the devices found.
[[nodiscard]] Result<std::unique_ptr<Device>> create_vulkan_device(const VulkanOptions& options);

/// lavapipe 22.3 keeps compiled shaders on disk without noting the vector width (LP_NATIVE_VECTOR_WIDTH) that they were
/// compiled for, and code of another width overwrites memory. If that variable is set, this function selects a cache
/// directory for this width by setting MESA_SHADER_CACHE_DIR; otherwise it does nothing. Call it before the first
/// device is created and while no other thread uses the environment. Repeated calls have no effect.
void separate_driver_caches();

/// The images of a window, which are shown in turn.
class Swapchain {
 public:
  virtual ~Swapchain() = default;
  /// Recreates the images for this size in pixels. Call it between frames. At 0×0 (minimised) there are no images, and
  /// `acquire` returns none.
  [[nodiscard]] virtual Status resize(std::uint32_t width, std::uint32_t height) = 0;
  /// Call it between begin_frame and submit_frame. Returns the image to fill, which must end in Access::present.
  /// Returns none if the window is minimised or has changed size; then call resize and try again in the next frame.
  [[nodiscard]] virtual Result<ImageHandle> acquire() = 0;
  /// Shows the acquired image. Call it after submit_frame.
  [[nodiscard]] virtual Status present() = 0;
};

/// `create_surface` receives the VkInstance and returns a VkSurfaceKHR as an integer, or 0 on failure; the swapchain
/// owns the surface. The device must have been created with the window's extensions and must outlive the swapchain.
[[nodiscard]] Result<std::unique_ptr<Swapchain>> create_swapchain(
    Device& device, const std::function<std::uint64_t(void* instance)>& create_surface);

}  // namespace gloam::gpu
