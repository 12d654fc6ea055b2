// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Descriptions of the pipelines a module will ask for.
using PipelineList = std::vector<std::variant<gpu::ComputePipelineDesc, gpu::GraphicsPipelineDesc>>;

/// Pipelines by name, made on first use. A name stands for one description: it holds whatever varies (constants,
/// formats, states). Safe from many threads.
class Pipelines {
 public:
  explicit Pipelines(gpu::Device& device) : device_(device) {}
  ~Pipelines();
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  /// Asserts that a pipeline of that name was made from the same description.
  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::ComputePipelineDesc& desc) { return find_or_make(desc); }
  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::GraphicsPipelineDesc& desc) { return find_or_make(desc); }
  /// The pipeline of a name that was made before, or none.
  [[nodiscard]] gpu::PipelineHandle find(std::string_view name) const;

  /// Whether all pipelines of a list are made. Those that are not are begun in the background, each once; one that
  /// fails there is told to the log and counts as ready, so that `get` meets the error.
  [[nodiscard]] bool request(const PipelineList& list, LogSink& log);
  /// Pipelines that are made in the background, or wait for their turn there.
  [[nodiscard]] std::size_t pending() const;
  /// Destroys all pipelines of a module, drops those that wait for their turn in the background and forgets failures.
  /// One that is being compiled in the background stays.
  void release(std::string_view module);

 private:
  template <class Desc>
  [[nodiscard]] Result<gpu::PipelineHandle> find_or_make(const Desc& desc);

  struct Entry {
    std::string module;
    gpu::PipelineHandle pipeline;
    std::uint64_t description = 0;  ///< hash of all that it was made from
  };
  void run_worker(std::stop_token stop, LogSink& log);

  gpu::Device& device_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::set<std::string, std::less<>> begun_;                ///< names handed to the worker
  std::map<std::string, std::string, std::less<>> failed_;  ///< in the background; modules by name
  PipelineList queue_;
  std::condition_variable_any wake_;
  std::jthread worker_;  ///< started with the first request; ends before the members above
};

}  // namespace gloam
