// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <unordered_map>
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

namespace gloam::c_interface {

/// An image of the host that an engine has imported, until the engine ends or the host has it forgotten.
struct ImportedImage {
  std::uint64_t image = 0;  ///< VkImage
  gpu::ImageDesc desc;
  gpu::ImageHandle handle;
};

struct EngineObject {
  std::unique_ptr<FunctionLog> log;
  std::unique_ptr<gpu::Device> device;
  std::unique_ptr<JobExecutor> executor;
  std::unique_ptr<Renderer> renderer;
  std::vector<ImportedImage> images;
  std::uint32_t worlds = 0;
};

struct WorldObject {
  EngineObject* engine = nullptr;
  World world;
};

/// A number that no other handle of this process has.
[[nodiscard]] std::uintptr_t next_handle();

/// Objects by their handles. A handle is a number in the form of a pointer, which nothing dereferences: one whose
/// object was destroyed, or that is of something else, is found out, because numbers are not used again.
template <class Object, class Handle>
class HandleTable {
 public:
  [[nodiscard]] Handle* add(std::unique_ptr<Object> object) {
    const std::scoped_lock lock(mutex_);
    const std::uintptr_t number = next_handle();
    objects_.emplace(number, std::move(object));
    return reinterpret_cast<Handle*>(number);
  }
  /// Null if there is no such object.
  [[nodiscard]] Object* find(const Handle* handle) const {
    const std::scoped_lock lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    return found == objects_.end() ? nullptr : found->second.get();
  }
  [[nodiscard]] std::unique_ptr<Object> remove(const Handle* handle) {
    const std::scoped_lock lock(mutex_);
    auto node = objects_.extract(reinterpret_cast<std::uintptr_t>(handle));
    return node.empty() ? nullptr : std::move(node.mapped());
  }

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::uintptr_t, std::unique_ptr<Object>> objects_;
};

/// The engines and worlds of the process. They are not destroyed when it ends: hosts that leave without destroying them
/// may have ended Vulkan before.
[[nodiscard]] HandleTable<EngineObject, gloam_engine>& engines();
[[nodiscard]] HandleTable<WorldObject, gloam_world>& worlds();

/// Keeps the sentence for gloam_error_message().
void keep_message(std::string sentence);

[[nodiscard]] gloam_result result_of(const Error& error);

[[nodiscard]] inline Error usage_error(std::string sentence) { return {ErrorKind::usage, std::move(sentence)}; }

/// The engine or world of a handle; usage error if there is none. function: names the caller.
[[nodiscard]] inline Result<EngineObject*> object_of(const gloam_engine* handle, const char* function) {
  if (EngineObject* found = engines().find(handle)) return found;
  return usage_error(std::string(function) + ": engine is " + (handle == nullptr ? "null" : "no engine that exists"));
}
[[nodiscard]] inline Result<WorldObject*> object_of(const gloam_world* handle, const char* function) {
  if (WorldObject* found = worlds().find(handle)) return found;
  return usage_error(std::string(function) + ": world is " + (handle == nullptr ? "null" : "no world that exists"));
}

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

/// guarded(), for a function of an engine or a world: body gets the object of the handle.
template <class Handle, class F>
[[nodiscard]] gloam_result guarded_with(const Handle* handle, const char* function, F&& body) {
  return guarded([&]() -> Status {
    const auto object = object_of(handle, function);
    if (!object) return object.error();
    return body(**object);
  });
}

/// Copies a versioned structure: members that the caller does not know keep the values of `defaults`. Usage error if it
/// is null, or larger than the library's.
template <class T>
[[nodiscard]] Status read_struct(const T* given, const T& defaults, const char* name, T& read) {
  read = defaults;
  if (given == nullptr) return usage_error(std::string(name) + " is null");
  // A multiple of the alignment does not end inside of a member.
  if (given->size < sizeof(std::size_t) || given->size > sizeof(T) || given->size % alignof(T) != 0)
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
[[nodiscard]] Status use_host_images(EngineObject& engine, const gloam_view& view, ViewRequest& request);

}  // namespace gloam::c_interface
