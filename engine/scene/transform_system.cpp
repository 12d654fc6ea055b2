// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <span>

#include "engine/core/assert.h"
#include "engine/scene/systems.h"

namespace gloam {
namespace {

constexpr std::size_t kRowsPerJob = 1024;

/// The columns of one archetype, and the TransformTree row of its first entity. Optional columns may be empty.
struct NodeChunk {
  std::span<const Entity> entities;
  std::span<WorldTransform> worlds;
  std::span<const LocalTransform> locals;
  std::span<const LocalMatrix> matrices;
  std::span<const Parent> parents;
  std::size_t first_row = 0;

  [[nodiscard]] dmat4 relative(std::size_t i) const {
    if (!matrices.empty()) return matrices[i].matrix;
    if (!locals.empty()) return local_matrix(locals[i]);
    return parents.empty() ? worlds[i].matrix : dmat4(1.0);
  }
};

std::vector<NodeChunk> gather_chunks(const TransformView& nodes, TransformTree& tree) {
  std::vector<NodeChunk> chunks;
  tree.entities.clear();
  nodes.each_chunk([&](std::span<const Entity> entities, std::span<WorldTransform> worlds,
                       std::span<const LocalTransform> locals, std::span<const LocalMatrix> matrices,
                       std::span<const Parent> parents) {
    chunks.push_back({entities, worlds, locals, matrices, parents, tree.entities.size()});
    tree.entities.insert(tree.entities.end(), entities.begin(), entities.end());
  });
  GLOAM_ASSERT(tree.entities.size() < kNoParentRow, "row numbers of nodes have 32 bits");
  return chunks;
}

void index_rows(TransformTree& tree) {
  for (std::uint32_t row = 0; row < tree.entities.size(); ++row) {
    const std::uint32_t index = tree.entities[row].index;
    if (index >= tree.row_of_index.size()) tree.row_of_index.resize(std::size_t{index} + 1);
    tree.row_of_index[index] = row;
  }
}

std::uint32_t find_row(const TransformTree& tree, Entity entity) {
  if (entity.index >= tree.row_of_index.size()) return kNoParentRow;
  const std::uint32_t row = tree.row_of_index[entity.index];  // may be left over from an earlier frame
  return row < tree.entities.size() && tree.entities[row] == entity ? row : kNoParentRow;
}

void read_nodes(const NodeChunk& chunk, JobExecutor& jobs, TransformTree& tree) {
  jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const std::size_t row = chunk.first_row + i;
      const std::uint32_t parent = chunk.parents.empty() ? kNoParentRow : find_row(tree, chunk.parents[i].entity);
      tree.parents[row] = parent;
      tree.depths[row] = parent == kNoParentRow ? 0 : chunk.parents[i].depth;
      tree.matrices[row] = chunk.relative(i);
    }
  });
}

void write_worlds(const TransformView& nodes, const NodeChunk& chunk, JobExecutor& jobs, const TransformTree& tree) {
  jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
    bool changed = false;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const dmat4& matrix = tree.matrices[chunk.first_row + i];
      changed = changed || chunk.worlds[i].matrix != matrix;
      chunk.worlds[i].matrix = matrix;
    }
    if (changed) nodes.mark_changed<WorldTransform>(chunk.entities.subspan(range.begin, range.end - range.begin));
  });
}

}  // namespace

void transform_system(TransformView nodes, Resource<TransformTree> tree, JobExecutor& jobs) {
  const std::vector<NodeChunk> chunks = gather_chunks(nodes, *tree);
  const std::size_t count = tree->entities.size();
  index_rows(*tree);
  tree->parents.resize(count);
  tree->depths.resize(count);
  tree->matrices.resize(count);
  for (const NodeChunk& chunk : chunks) read_nodes(chunk, jobs, *tree);
  build_levels(tree->parents, tree->depths, tree->levels);
  compose_worlds(tree->levels, tree->parents, jobs, tree->matrices);
  for (const NodeChunk& chunk : chunks) write_worlds(nodes, chunk, jobs, *tree);
}

}  // namespace gloam
