// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

namespace gloam {

/// How far the compilation of a frame's pipelines is. Renderers report to it; any thread may read it meanwhile.
class PipelineProgress {
 public:
  struct State {
    std::string name;       ///< of the pipeline whose compilation began last
    std::size_t done = 0;   ///< compiled pipelines of the frame
    std::size_t total = 0;  ///< 0: nothing is being compiled
  };
  [[nodiscard]] State state() const;

  /// total: pipelines that the frame needs and that do not exist yet.
  void begin(std::size_t total);
  void begin_one(const std::string& name);
  void end_one();

 private:
  mutable std::mutex mutex_;
  State state_;
};

}  // namespace gloam
