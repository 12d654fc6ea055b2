// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "modules/c_interface/gloam.h"

// What the handles of gloam.h stand for, and what all its functions share.

/// An image of the host that an engine has imported, until the engine ends or the host has it forgotten.
struct gloam_imported_image {
  std::uint64_t image = 0;  ///< VkImage
  gloam::gpu::ImageDesc desc;
  gloam::gpu::ImageHandle handle;
};

struct gloam_engine {
  std::unique_ptr<gloam::FunctionLog> log;
  std::unique_ptr<gloam::gpu::Device> device;
  std::unique_ptr<gloam::JobExecutor> executor;
  std::unique_ptr<gloam::Renderer> renderer;
  std::vector<gloam_imported_image> images;
  std::uint32_t worlds = 0;
};

struct gloam_world {
  gloam_engine* engine = nullptr;
  gloam::World world;
};

namespace gloam::c_interface {

/// Keeps the sentence for gloam_error_message().
void keep_message(std::string sentence);

[[nodiscard]] gloam_result result_of(const Error& error);

[[nodiscard]] inline Error usage_error(std::string sentence) { return {ErrorKind::usage, std::move(sentence)}; }

/// Runs the body of a function of the interface: nothing is thrown out of it.
template <std::invocable F>
[[nodiscard]] gloam_result guarded(F&& body) {
  try {
    keep_message({});
    const Status status = body();
    return status.ok() ? GLOAM_OK : result_of(status.error());
  } catch (const std::bad_alloc&) {
    return result_of({ErrorKind::failed, "There is not enough memory"});
  } catch (const std::exception& fault) {
    return result_of({ErrorKind::failed, fault.what()});
  } catch (...) {
    return result_of({ErrorKind::failed, "An exception of unknown type was thrown"});
  }
}

/// Copies a versioned structure: members that the caller does not know keep the values of `defaults`. Usage error if it
/// is null, or larger than the library's.
template <class T>
[[nodiscard]] Status read_struct(const T* given, const T& defaults, const char* name, T& read) {
  read = defaults;
  if (given == nullptr) return usage_error(std::string(name) + " is null");
  if (given->size < sizeof(std::size_t) || given->size > sizeof(T))
    return usage_error(std::string(name) + "::size is " + std::to_string(given->size) + "; this library knows up to " +
                       std::to_string(sizeof(T)) + " bytes, set with its _INIT");
  std::memcpy(static_cast<void*>(&read), given, given->size);
  return {};
}

[[nodiscard]] inline gloam_entity number_of(Entity entity) {
  return std::uint64_t{entity.generation} << 32 | entity.index;
}
/// Usage error if there is no such entity.
[[nodiscard]] Result<Entity> entity_of(const World& world, gloam_entity number);

/// Usage error if the matrix is null, not finite, or a projection.
[[nodiscard]] Result<dmat4> matrix_of(const double* matrix, const char* name);

/// Creates the engine's device on a host's.
[[nodiscard]] Result<std::unique_ptr<gpu::Device>> create_device_on(const gloam_vulkan_device& host, LogSink* log,
                                                                    const char* cache_directory);
/// Fills in what the host's images replace in a view.
[[nodiscard]] Status use_host_images(gloam_engine& engine, const gloam_view& view, ViewRequest& request);

}  // namespace gloam::c_interface
