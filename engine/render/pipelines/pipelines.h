// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/pipelines/pipeline_list.h"
#include "engine/render/pipelines/pipeline_record.h"

namespace gloam {

/// Pipelines by module and description (gpu::description_hash), compiled on first use. A description without a name
/// gets the name of its shader and its constants. Thread-safe.
class Pipelines {
 public:
  explicit Pipelines(gpu::Device& device) : device_(device) {}
  ~Pipelines();
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  /// The pipeline of this description, compiled if needed.
  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::ComputePipelineDesc& desc) { return find_or_make(desc); }
  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::GraphicsPipelineDesc& desc) { return find_or_make(desc); }
  /// The existing pipeline of this description, or a null handle.
  [[nodiscard]] gpu::PipelineHandle find(const gpu::ComputePipelineDesc& desc) const;
  [[nodiscard]] gpu::PipelineHandle find(const gpu::GraphicsPipelineDesc& desc) const;

  /// Identifies module and description.
  [[nodiscard]] static std::uint64_t key_of(const gpu::ComputePipelineDesc& desc);
  [[nodiscard]] static std::uint64_t key_of(const gpu::GraphicsPipelineDesc& desc);

  /// Whether all pipelines of a list are compiled. Missing ones are compiled in the background, each once. If one fails
  /// there, the error is logged and the pipeline counts as ready, so that `get` returns the error.
  [[nodiscard]] bool request(const PipelineList& list, LogSink& log);
  /// Number of pipelines that are queued or compiled in the background.
  [[nodiscard]] std::size_t pending() const;
  /// Name of the pipeline whose compilation in the background began last; empty: none so far.
  [[nodiscard]] std::string made_in_background() const;
  /// From now on, pipelines whose descriptions name this shader are made from these words. Existing ones are destroyed.
  /// No frame may be recorded meanwhile.
  void replace_shader(std::string_view name, std::vector<std::uint32_t> words);
  /// Calls of replace_shader() so far. Pictures of before may differ from those that the same inputs give now.
  [[nodiscard]] std::uint64_t replacements() const;
  /// The descriptions of the existing pipelines that get() or find() was asked for, as text for request_record() of a
  /// later process.
  [[nodiscard]] std::string record() const;
  /// Has the pipelines of a record made in the background, smallest shader first, for example while a scene is loaded:
  /// frames begin with the largest, so the two meet at a small one, which both may make.
  /// shaders: those that may be in the record; they must live as long as this object. Pipelines of others are left out,
  /// and a damaged record is. Returns the number of pipelines.
  std::size_t request_record(std::string_view record, std::span<const gpu::ShaderCode* const> shaders, LogSink& log);
  /// Destroys all pipelines of a module, removes its queued ones and forgets its failures. A pipeline that is being
  /// compiled in the background stays.
  void release(std::string_view module);
  /// Tells that a frame begins: a pipeline is in use in the frame in which it was last asked for.
  void begin_frame();
  /// Destroys the pipelines that were in no frame for kUnusedFrames frames: a host that tries many settings would
  /// gather pipelines without end. The GPU must have finished with them.
  void release_unused();

  static constexpr std::uint64_t kUnusedFrames = 600;

 private:
  template <class Desc>
  [[nodiscard]] Result<gpu::PipelineHandle> find_or_make(const Desc& desc, bool in_background = false);
  template <class Desc>
  [[nodiscard]] gpu::PipelineHandle find_existing(const Desc& desc) const;

  struct Entry {
    PipelineList::value_type desc;
    gpu::PipelineHandle pipeline;
    mutable bool asked_for = false;        ///< not only made in the background
    mutable std::uint64_t last_frame = 0;  ///< frame_ when it was asked for last
  };
  /// The pipeline, if it exists. Otherwise it is the caller's to make, and no longer queued.
  [[nodiscard]] std::optional<gpu::PipelineHandle> find_or_take(std::uint64_t key, bool in_background);
  /// The words that replace those of a shader; without words, the shader itself.
  [[nodiscard]] gpu::ShaderCode current(const gpu::ShaderCode& shader) const;
  void run_worker(const std::stop_token& stop, LogSink& log);
  /// Makes the first pipeline of the queue, without the lock meanwhile.
  void make_first(std::unique_lock<std::mutex>& lock, LogSink& log);

  gpu::Device& device_;
  mutable std::mutex mutex_;
  std::unordered_map<std::uint64_t, Entry> entries_;       ///< by hash of module and description, as the members below
  std::unordered_set<std::uint64_t> begun_;                ///< queued or being compiled in the background
  std::unordered_map<std::uint64_t, std::string> failed_;  ///< failed in the background: module
  /// By name. Devices may identify shaders by the address of their words, so that replaced words stay.
  std::unordered_map<std::string, std::deque<std::vector<std::uint32_t>>> replaced_;
  std::uint64_t replacements_ = 0;
  std::uint64_t frame_ = 0;  ///< calls of begin_frame() so far
  PipelineList queue_;
  PipelineNames names_;  ///< of constants, from records
  std::string made_;     ///< made_in_background
  std::condition_variable_any wake_;
  std::jthread worker_;  ///< started by the first request; destroyed before the members above
};

}  // namespace gloam
