// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "sandbox/play/shader_files.h"

namespace gloam {

/// Compiles one file of a source tree as the build does (glslangValidator, then spirv-opt). The error is the compiler's
/// message, several lines. file: relative to the tree, "shaders/fog/blur.frag.glsl".
[[nodiscard]] Result<std::vector<std::uint32_t>> compile_shader(const std::string& root, const std::string& file);

/// The source of an embedded shader, relative to the tree.
[[nodiscard]] std::string file_of(const gpu::ShaderCode& shader);

/// Watches the shaders of a source tree and compiles those that change, in a thread.
class ShaderReload {
 public:
  struct Compiled {
    const gpu::ShaderCode* shader = nullptr;  ///< the embedded one
    std::vector<std::uint32_t> words;
  };
  /// The result of one change of files.
  struct Change {
    std::vector<Compiled> compiled;
    std::string fault;  ///< the compiler's message about the first shader that failed; empty: none
  };

  /// Does nothing if the tree has no folder `shaders`.
  explicit ShaderReload(std::string root);

  /// The change that was compiled last, once.
  [[nodiscard]] std::optional<Change> take();

 private:
  void watch(const std::stop_token& stop);
  [[nodiscard]] Change compile(const std::vector<std::string>& shaders) const;

  std::string root_;
  std::mutex mutex_;
  std::optional<Change> change_;
  std::jthread thread_;  ///< destroyed before the members above
};

}  // namespace gloam
