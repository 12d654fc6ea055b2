// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// Runs gloam on a VkDevice that the host application has created. This is the only public header with Vulkan types.
// gloam makes every Vulkan call through the host's vkGetInstanceProcAddr and defines no Vulkan symbol, so the host may
// link libvulkan, volk or any other loader.
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam::gpu {

/// The device extensions that the host must enable in vkCreateDevice: none. No instance extension is required.
[[nodiscard]] std::span<const char* const> required_device_extensions();
/// The device extensions that gloam uses if the host enables them: VK_KHR_push_descriptor.
[[nodiscard]] std::span<const char* const> useful_device_extensions();

/// Sets the features that gloam requires to VK_TRUE and leaves all other features unchanged. The host owns and chains
/// the structures; sType and pNext are not touched.
void fill_required_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                            VkPhysicalDeviceVulkan13Features& v13);
/// Sets the optional features that gloam uses (anisotropic filtering, …) to VK_TRUE where the device supports them.
/// core_supported comes from vkGetPhysicalDeviceFeatures2.
void fill_useful_features(const VkPhysicalDeviceFeatures& core_supported, VkPhysicalDeviceFeatures& core);

/// A request for the memory of one buffer, one image, or one block in which buffers and images lie.
struct HostMemoryRequest {
  /// memoryTypeBits: only types that are usable; never protected or lazily allocated ones. A block of buffers and
  /// images gets alignment ≥ bufferImageGranularity.
  VkMemoryRequirements requirements = {};
  VkMemoryPropertyFlags required = 0;   ///< properties that the memory type must have
  VkMemoryPropertyFlags preferred = 0;  ///< properties that it should have
  bool mapped = false;                  ///< HostMemory::mapped must be set, and stay valid until the memory is freed
  bool image = false;                   ///< for optimal images; false: for buffers, or for a block of both (`block`)
  bool block = false;                   ///< for buffers and images together; must not share a granularity page
  std::string_view module;              ///< valid during the call
  std::string_view name;                ///< of the object; valid during the call
};

/// Memory that a host has given: bytes [offset, offset + requirements.size) of `memory`.
struct HostMemory {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< a multiple of requirements.alignment
  void* mapped = nullptr;   ///< address of the byte at `offset`, if the request has asked for it
  void* user = nullptr;     ///< of the host, for example a VmaAllocation
};

/// A host's allocator of GPU memory, for example one that calls VMA. Called from any thread, one call at a time for
/// each gpu::Device. Calls must not use that device.
class HostMemoryAllocator {
 public:
  virtual ~HostMemoryAllocator() = default;
  /// On VK_SUCCESS `memory` must be set, in a memory type that `request` allows; other results make the creation of the
  /// object fail with an Error.
  [[nodiscard]] virtual VkResult allocate(const HostMemoryRequest& request, HostMemory& memory) = 0;
  /// Frees memory from allocate. The GPU has finished with it.
  virtual void free(const HostMemory& memory) = 0;
};

/// A device that the host has created. The host owns all handles; they must outlive the gpu::Device created on them.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;  ///< receives all of gloam's work
  std::uint32_t queue_family = 0;  ///< of `queue`; must support graphics and compute
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  std::uint32_t api_version = VK_API_VERSION_1_3;  ///< VkApplicationInfo::apiVersion of the instance; ≥ 1.3
  /// The extensions and features that the host passed to vkCreateDevice; Vulkan cannot be queried for them. Read during
  /// creation only. The features' pNext chain may hold the structures of whole Vulkan versions or of single features;
  /// other structures are skipped.
  std::span<const char* const> enabled_extensions;
  const VkPhysicalDeviceFeatures2* enabled_features = nullptr;
  /// gloam locks this mutex around each use of `queue`. Set it if other threads of the host use the queue at the same
  /// time. Null: the host must not use the queue while a call to gloam's Device or Renderer runs.
  std::mutex* queue_mutex = nullptr;
  std::string cache_directory;         ///< as VulkanOptions::cache_directory
  std::size_t retained_pipelines = 0;  ///< as VulkanOptions::retained_pipelines
  LogSink* log = nullptr;              ///< must outlive the device
  /// Passed to every vkCreate…, vkAllocate…, vkDestroy… and vkFree… of gloam that takes callbacks. Copied; what it
  /// points to must outlive the device. Called from any thread, because pipelines are compiled on several. Null: none.
  const VkAllocationCallbacks* allocation_callbacks = nullptr;
  MemoryOptions memory;
  /// Gives all GPU memory of gloam; must outlive the device. Then gloam allocates none itself, and
  /// MemoryOptions::block_bytes has no effect. Null: gloam allocates blocks.
  HostMemoryAllocator* memory_allocator = nullptr;
};

/// Creates a gpu::Device on the host's device. The host's objects are never destroyed, renamed or waited for.
/// Validation messages go to the host's messenger, so Device::validation_messages stays 0. Fails with
/// ErrorKind::no_device; the error names every feature and extension that the device lacks or that the host has not
/// enabled.
[[nodiscard]] Result<std::unique_ptr<Device>> create_vulkan_device_on(const HostDevice& host);

// The functions below take a device made by create_vulkan_device_on or create_vulkan_device.

/// Returns a gloam handle for an image of the host. `desc` describes the image: its size, layers, mips, usage flags
/// that it was created with, and its format (or another format if it was created with
/// VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT). The image must be two-dimensional, with one sample and optimal tiling. It must
/// be usable on the device's queue family: concurrent, or exclusive and owned by this family or by none.
/// Device::destroy removes the handle and its views, never the image. The image must live until all frames that use it
/// have finished on the GPU.
[[nodiscard]] ImageHandle import_image(Device& device, VkImage image, const ImageDesc& desc);

/// Returns a gloam handle for a buffer of the host, so that passes can declare it (FrameGraph::import_buffer), commands
/// can bind it, and gloam places the barriers between them. `desc` states the buffer's size and the usage flags that it
/// was created with; `memory` stays MemoryKind::device, because gloam never maps it. The buffer must be usable on the
/// device's queue family: concurrent, or exclusive and owned by this family or by none. Device::destroy removes the
/// handle, never the buffer, which must live until all frames that use it have finished on the GPU. gloam cannot see
/// when the host changes the contents: a frame whose commands bind such a buffer is drawn even if nothing else has
/// changed (`scene.reuse`).
[[nodiscard]] BufferHandle import_buffer(Device& device, VkBuffer buffer, const BufferDesc& desc);

/// The layout of an image that gloam has left ready for an access, and the stages and accesses that a later barrier
/// must wait for.
struct HostImageLayout {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
/// access: one that images support, or Access::none (undefined layout). A host barrier after gloam's work uses the
/// result as its source (oldLayout, srcStageMask, srcAccessMask). A host barrier before gloam's work uses it as its
/// destination.
[[nodiscard]] HostImageLayout host_image_layout(Access access);

/// The stages and accesses of an access to a buffer, for the host's own barriers: as in host_image_layout.
struct HostBufferAccess {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
/// access: one that buffers support, or Access::none (no stages).
[[nodiscard]] HostBufferAccess host_buffer_access(Access access);

/// The Vulkan format of gloam's format, e.g. of kCasterDepthFormat for VkPipelineRenderingCreateInfo.
[[nodiscard]] VkFormat native_format(Format format);
/// The Vulkan objects behind gloam's handles, to be bound in native commands. They stay gloam's. A resource of the
/// frame graph (PassContext::buffer, PassContext::image) may be used in its pass only, in the ways that the pass
/// declares. The image is in the layout of the declared access (host_image_layout). The view lives as long as the
/// image; it is a 2D array if it has several layers or ImageView::as_array is set, also of cube images.
[[nodiscard]] VkBuffer native_buffer(Device& device, BufferHandle buffer);
[[nodiscard]] Result<VkImageView> native_view(Device& device, const ImageView& view);

/// The host records into gloam's command buffer while an object of this class lives. See native_commands.
class NativeCommands {
 public:
  ~NativeCommands();
  NativeCommands(const NativeCommands&) = delete;
  NativeCommands& operator=(const NativeCommands&) = delete;
  /// Null on a device that records without a GPU (make_recording_device), and in a frame whose recording has failed,
  /// for example because memory ran out: the host then records nothing.
  [[nodiscard]] VkCommandBuffer get() const { return buffer_; }

 private:
  friend NativeCommands native_commands(CommandList& commands, std::optional<std::uint64_t> revision);
  NativeCommands(CommandList& commands, std::optional<std::uint64_t> revision);

  CommandList& commands_;
  VkCommandBuffer buffer_;
};

/// Gives the host the VkCommandBuffer that gloam records, in the function of a pass (PassContext::commands) or of a
/// caster source (CasterSource::record), so that it draws or dispatches with its own pipelines, descriptor sets and
/// buffers. The host records until the returned object ends; meanwhile calls of CommandList assert.
///
/// On entry: a primary command buffer of HostDevice::queue_family that is being recorded. In a caster source, and
/// between begin_rendering and end_rendering in a pass, it is inside dynamic rendering without VkRenderingFlags, with
/// view mask 0 and one sample; viewport 0 (of negative height, so clip space has Y up) and scissor 0 are set. Resources
/// are ready for the accesses that the pass has declared. No pipeline, descriptor set, push constant, vertex or index
/// buffer is defined.
///
/// On exit:
/// - Rendering is as it was: begun with the same attachments, or not begun. Inside rendering there are no barriers,
///   copies, dispatches and secondary command buffers, as Vulkan demands.
/// - Queries, labels and conditional rendering that the host has begun are ended.
/// - Images of gloam are in the layout in which they were, and resources that the pass declares have been accessed in
///   the declared ways only. What the host uses and the pass does not declare (import_buffer makes that possible), the
///   host synchronises itself.
/// - The command buffer has not been ended, reset or submitted.
/// Pipelines, sets, push constants, buffers and dynamic state need not be restored. gloam sets viewport and scissor
/// again. Whoever goes on with CommandList binds pipeline, bindings and buffers first; otherwise draws and dispatches
/// assert.
///
/// revision: a number that changes with what the commands do: with the commands themselves, their constants, and the
/// contents of the host's resources that they read. The renderer may drop the commands of a frame in which no such
/// number and nothing else has changed, because the results are there already (`scene.reuse=exact`). None: frames with
/// these commands are never dropped for that reason. In a caster source it is not needed: CasterSource::content_hash
/// decides whether the source is drawn at all. A frame that is given up after an error is dropped in any case, so the
/// host must not take recorded commands for executed ones.
[[nodiscard]] NativeCommands native_commands(CommandList& commands, std::optional<std::uint64_t> revision = {});

/// A semaphore for synchronisation with work on other queues. Work on the same queue needs none: gloam's barriers wait
/// for everything submitted before, and a host barrier with host_image_layout as its source waits for gloam.
struct HostSemaphore {
  VkSemaphore semaphore = VK_NULL_HANDLE;
  std::uint64_t value = 0;  ///< of a timeline semaphore; ignored for a binary semaphore
};

/// Adds semaphores to the frame being recorded: all of its work waits for `waits`, and `signals` are signalled after
/// all of its work. Call it between begin_frame and submit_frame; with a Renderer, from ViewTarget::acquire. A frame
/// that is abandoned while it is being recorded still waits and signals.
void add_frame_semaphores(Device& device, std::span<const HostSemaphore> waits,
                          std::span<const HostSemaphore> signals = {});

/// The next frame (begin_frame; with a Renderer, the next call of render) is recorded into a command buffer of the host
/// and not submitted. The command buffer is a primary one for `queue_family`; the host has begun it, and records before
/// and after gloam what it likes, outside of rendering. Then it ends the command buffer, submits it once to
/// HostDevice::queue, and calls host_submitted before it uses gloam's device or renderer again. Such a frame has no
/// semaphores of its own (add_frame_semaphores, swapchains): those of the host's submission hold for it.
///
/// If render returns an error, its commands may be incomplete: the host resets the command buffer, and must not call
/// host_submitted.
void record_next_frame_into(Device& device, VkCommandBuffer commands);
/// Tells that the host has submitted the frame that was recorded into its command buffer. Submits a signal of gloam's
/// timeline to the same queue.
[[nodiscard]] Status host_submitted(Device& device);

/// gloam's timeline semaphore, and the value it reaches when all work submitted so far has finished. Work on another
/// queue, or vkWaitSemaphores, can wait for this value. The semaphore lives as long as the device; the host must not
/// signal it.
[[nodiscard]] HostSemaphore frame_timeline(Device& device);

}  // namespace gloam::gpu
