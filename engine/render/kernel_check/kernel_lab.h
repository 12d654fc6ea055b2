// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/log.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Where kernels are checked: a device, and shaders that take the place of those of the program.
class KernelLab {
 public:
  using ReplacedShaders = std::map<std::string, std::span<const std::uint32_t>, std::less<>>;

  /// Both must outlive it.
  KernelLab(gpu::Device& device, LogSink& log) : device_(device), log_(log) {}
  KernelLab(const KernelLab&) = delete;
  KernelLab& operator=(const KernelLab&) = delete;

  [[nodiscard]] gpu::Device& device() const { return device_; }
  [[nodiscard]] LogSink& log() const { return log_; }

  /// Kernels that name this shader run these words, which must outlive the device: it tells shaders apart by address.
  void replace_shader(std::string_view name, std::span<const std::uint32_t> words) {
    replaced_.insert_or_assign(std::string(name), words);
  }
  [[nodiscard]] const ReplacedShaders& replaced_shaders() const { return replaced_; }
  /// The words that replace those of a shader; without words, the shader itself.
  [[nodiscard]] gpu::ShaderCode current(const gpu::ShaderCode& shader) const {
    const auto found = replaced_.find(shader.name);
    return found == replaced_.end() ? shader : gpu::ShaderCode{shader.name, found->second};
  }

 private:
  gpu::Device& device_;
  LogSink& log_;
  ReplacedShaders replaced_;
};

}  // namespace gloam
