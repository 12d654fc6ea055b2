// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/due_pipelines.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace gloam::declare {
namespace {

std::size_t words_of(const gpu::ComputePipelineDesc& desc) { return desc.shader.words.size(); }
std::size_t words_of(const gpu::GraphicsPipelineDesc& desc) {
  return desc.vertex.words.size() + desc.fragment.words.size();
}

std::string name_of(const PipelineList::value_type& desc) {
  const auto shader = [](const auto& d) {
    if constexpr (requires { d.fragment; })
      return d.fragment.words.empty() ? d.vertex.name : d.fragment.name;
    else
      return d.shader.name;
  };
  return std::visit([&](const auto& d) { return d.name.empty() ? std::string(shader(d)) : d.name; }, desc);
}

}  // namespace

template <class Desc>
const gpu::PipelineHandle* DuePipelines::add_any(const Desc& desc) {
  const std::uint64_t key = Pipelines::key_of(desc);
  for (const Due& due : due_)
    if (due.key == key) return &due.pipeline;
  return &due_.emplace_back(Due{.key = key, .desc = desc, .pipeline = {}, .status = {}}).pipeline;
}
template const gpu::PipelineHandle* DuePipelines::add_any(const gpu::ComputePipelineDesc&);
template const gpu::PipelineHandle* DuePipelines::add_any(const gpu::GraphicsPipelineDesc&);

Status DuePipelines::make_all(Pipelines& pipelines, JobExecutor& executor, PipelineProgress* progress) {
  std::vector<Due*> order;
  for (Due& due : due_) order.push_back(&due);
  const auto words = [](const Due* due) { return std::visit([](const auto& d) { return words_of(d); }, due->desc); };
  std::ranges::stable_sort(order, [&](const Due* a, const Due* b) { return words(a) > words(b); });
  if (progress != nullptr) progress->begin(order.size());
  executor.parallel_for(order.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (progress != nullptr) progress->begin_one(name_of(order[i]->desc));
      auto made = std::visit([&](const auto& desc) { return pipelines.get(desc); }, order[i]->desc);
      if (made.ok())
        order[i]->pipeline = *made;
      else
        order[i]->status = made.error();
      if (progress != nullptr) progress->end_one();
    }
  });
  for (const Due& due : due_) GLOAM_TRY(due.status);
  return {};
}

}  // namespace gloam::declare
