// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "engine/core/env.h"
#include "engine/gpu/vulkan_device.h"

namespace gloam::gpu {
namespace {

/// The directory in which Mesa keeps its cache; nullopt if the environment names none.
std::optional<std::filesystem::path> mesa_cache_directory() {
  for (const char* name : {"MESA_SHADER_CACHE_DIR", "XDG_CACHE_HOME"}) {
    if (const auto directory = environment_text(name)) return *directory;
  }
  if (const auto home = environment_text("HOME")) return std::filesystem::path(*home) / ".cache";
  return std::nullopt;
}

void set_environment(const char* name, const std::string& value) {
#ifdef _WIN32
  _putenv_s(name, value.c_str());
#else
  setenv(name, value.c_str(), 1);
#endif
}

}  // namespace

void separate_driver_caches() {
  const auto width = environment_text("LP_NATIVE_VECTOR_WIDTH");
  if (!width) return;
  const std::string folder = "gloam_lavapipe_" + *width;
  const auto directory = mesa_cache_directory();
  if (directory && directory->filename() == folder) return;
  std::error_code error;
  if (directory) std::filesystem::create_directories(*directory / folder, error);
  if (!directory || error) {
    set_environment("MESA_SHADER_CACHE_DISABLE", "true");
  } else {
    set_environment("MESA_SHADER_CACHE_DIR", (*directory / folder).string());
  }
}

}  // namespace gloam::gpu
