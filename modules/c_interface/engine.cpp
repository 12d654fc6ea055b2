// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_device.h"
#include "modules/c_interface/handles.h"
#include "modules/module_list/module_list.h"

using gloam::c_interface::EngineObject;
using gloam::c_interface::guarded;
using gloam::c_interface::guarded_with;
using gloam::c_interface::usage_error;

namespace gloam::c_interface {
namespace {

constexpr std::uint32_t kMostThreads = 1024;

Result<std::unique_ptr<gpu::Device>> create_device(const gloam_engine_info& info, LogSink* log) {
  if (info.vulkan != nullptr) return create_device_on(*info.vulkan, log, info.cache_directory);
  gpu::VulkanOptions options;
  if (info.device != nullptr) options.device = info.device;
  if (info.cache_directory != nullptr) options.cache_directory = info.cache_directory;
  options.validate = info.validate != 0;
  options.log = log;
  return gpu::create_vulkan_device(options);
}

Status create_engine(const gloam_engine_info* given, gloam_engine** engine) {
  if (engine == nullptr) return usage_error("gloam_engine_create: engine is null");
  *engine = nullptr;
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  if (given != nullptr)
    GLOAM_TRY(read_struct(given, gloam_engine_info(GLOAM_ENGINE_INFO_INIT), "gloam_engine_info", info));
  if (info.threads > kMostThreads)
    return usage_error("gloam_engine_info::threads is " + std::to_string(info.threads) + "; at most " +
                       std::to_string(kMostThreads) + " are possible");
  auto made = std::make_unique<EngineObject>();
  if (info.log != nullptr)
    made->log =
        std::make_unique<FunctionLog>([write = info.log, user = info.log_user](LogLevel level, std::string_view line) {
          write(user, static_cast<gloam_log_level>(level), std::string(line).c_str());
        });
  auto device = create_device(info, made->log.get());
  if (!device) return device.error();
  made->device = std::move(*device);
  made->executor = make_pool_executor(info.threads);
  auto renderer = Renderer::create({.device = made->device.get(),
                                    .executor = made->executor.get(),
                                    .log = made->log.get(),
                                    .modules = make_all_modules()});
  if (!renderer) return renderer.error();
  made->renderer = std::move(*renderer);
  *engine = engines().add(std::move(made));
  return {};
}

}  // namespace
}  // namespace gloam::c_interface

extern "C" {

gloam_result gloam_engine_create(const gloam_engine_info* info, gloam_engine** engine) {
  return guarded([&] { return gloam::c_interface::create_engine(info, engine); });
}

gloam_result gloam_engine_destroy(gloam_engine* engine) {
  return guarded([&]() -> gloam::Status {
    if (engine == nullptr) return {};
    const auto found = gloam::c_interface::object_of(engine, "gloam_engine_destroy");
    if (!found) return found.error();
    if (const auto worlds = (*found)->worlds; worlds > 0)
      return usage_error("gloam_engine_destroy: " + std::to_string(worlds) + " worlds of the engine exist");
    const std::unique_ptr<gloam::c_interface::EngineObject> ending = gloam::c_interface::engines().remove(engine);
    const gloam::Status waited = ending->renderer->wait();
    for (const gloam::c_interface::ImportedImage& image : ending->images) ending->device->destroy(image.handle);
    ending->renderer.reset();
    return waited;
  });
}

const char* gloam_engine_device_name(const gloam_engine* engine) {
  const EngineObject* found = gloam::c_interface::engines().find(engine);
  return found == nullptr ? "" : found->device->info().name.c_str();
}

uint64_t gloam_engine_validation_messages(const gloam_engine* engine) {
  const EngineObject* found = gloam::c_interface::engines().find(engine);
  return found == nullptr ? 0 : found->device->validation_messages();
}

gloam_result gloam_engine_set_knob(gloam_engine* engine, const char* knob, const char* value) {
  return guarded_with(engine, "gloam_engine_set_knob", [&](EngineObject& of) -> gloam::Status {
    if (knob == nullptr || value == nullptr) return usage_error("gloam_engine_set_knob: an argument is null");
    return of.renderer->knobs().set(knob, value);
  });
}

gloam_result gloam_engine_wait(gloam_engine* engine) {
  return guarded_with(engine, "gloam_engine_wait", [](EngineObject& of) { return of.renderer->wait(); });
}

gloam_result gloam_engine_free_idle_memory(gloam_engine* engine) {
  return guarded_with(engine, "gloam_engine_free_idle_memory", [](EngineObject& of) -> gloam::Status {
    of.renderer->free_idle_memory();
    return {};
  });
}

}  // extern "C"
