// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/scene/systems.h"

namespace gloam {
namespace {

constexpr std::size_t kRowsPerJob = 1024;

/// Whether two arrays of the same length hold the same bits. Types without padding: unlike ==, NaN equals itself.
template <class T>
bool same_bits(std::span<const T> a, std::span<const T> b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

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
  [[nodiscard]] bool placed_by_host() const { return matrices.empty() && locals.empty() && parents.empty(); }
};

std::vector<NodeChunk> gather_chunks(const TransformView& nodes) {
  std::vector<NodeChunk> chunks;
  std::size_t rows = 0;
  nodes.each_chunk([&](std::span<const Entity> entities, std::span<WorldTransform> worlds,
                       std::span<const LocalTransform> locals, std::span<const LocalMatrix> matrices,
                       std::span<const Parent> parents) {
    chunks.push_back({entities, worlds, locals, matrices, parents, rows});
    rows += entities.size();
  });
  GLOAM_ASSERT(rows < kNoParentRow, "row numbers of nodes have 32 bits");
  return chunks;
}

/// Whether the rows hold the same entities with the same parents and the same kinds of poses as in the last call.
bool is_same_tree(std::span<const NodeChunk> chunks, const TransformTree& tree) {
  return std::ranges::equal(chunks, tree.chunks, [&](const NodeChunk& chunk, const TransformTree::Inputs& last) {
    if (chunk.entities.size() != last.rows) return false;
    return chunk.matrices.size() == last.matrices.size() &&
           (!last.matrices.empty() || chunk.locals.size() == last.poses.size()) &&
           same_bits(chunk.entities, std::span(tree.entities).subspan(chunk.first_row, last.rows)) &&
           same_bits(chunk.parents, std::span(last.parents));
  });
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
  const std::uint32_t row = tree.row_of_index[entity.index];  // may be left over from an earlier tree
  return row < tree.entities.size() && tree.entities[row] == entity ? row : kNoParentRow;
}

/// Reads entities and parents anew. All rows are outdated. `kept`: room for the inputs of each chunk.
void rebuild_tree(std::span<const NodeChunk> chunks, JobExecutor& jobs, TransformTree& tree,
                  std::vector<TransformTree::Inputs>& kept) {
  tree.entities.clear();
  kept.resize(chunks.size());
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const NodeChunk& chunk = chunks[c];
    TransformTree::Inputs& inputs = kept[c];
    tree.entities.insert(tree.entities.end(), chunk.entities.begin(), chunk.entities.end());
    inputs.rows = chunk.entities.size();
    inputs.parents.assign(chunk.parents.begin(), chunk.parents.end());
    inputs.matrices.resize(chunk.matrices.size());
    inputs.poses.resize(chunk.matrices.empty() ? chunk.locals.size() : 0);
    inputs.placed.resize(chunk.placed_by_host() ? inputs.rows : 0);
  }
  index_rows(tree);
  const std::size_t count = tree.entities.size();
  tree.parents.resize(count);
  tree.depths.resize(count);
  tree.matrices.resize(count);
  tree.outdated.assign(count, 1);
  for (const NodeChunk& chunk : chunks) {
    jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const std::size_t row = chunk.first_row + i;
        const std::uint32_t parent = chunk.parents.empty() ? kNoParentRow : find_row(tree, chunk.parents[i].entity);
        tree.parents[row] = parent;
        tree.depths[row] = parent == kNoParentRow ? 0 : chunk.parents[i].depth;
      }
    });
  }
  build_levels(tree.parents, tree.depths, tree.levels);
}

/// Marks the rows [range) of a chunk whose values differ from the ones that were kept.
template <class T>
bool mark_different(std::span<const T> now, std::span<const T> kept, JobRange range, std::uint8_t* outdated) {
  if (now.empty()) return false;
  const std::size_t size = range.end - range.begin;
  if (same_bits(now.subspan(range.begin, size), kept.subspan(range.begin, size))) return false;
  for (std::size_t i = range.begin; i < range.end; ++i)
    outdated[i] = same_bits(now.subspan(i, 1), kept.subspan(i, 1)) ? 0 : 1;
  return true;
}

/// Finds the outdated rows of a tree that is the same as in the last call, without their descendants. Returns whether
/// there are any.
bool find_outdated(const TransformView& nodes, std::span<const NodeChunk> chunks, JobExecutor& jobs,
                   TransformTree& tree) {
  std::ranges::fill(tree.outdated, std::uint8_t{0});
  std::atomic<bool> any = false;
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const NodeChunk& chunk = chunks[c];
    const TransformTree::Inputs& last = tree.chunks[c];
    std::uint8_t* const outdated = tree.outdated.data() + chunk.first_row;
    jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
      bool found = false;
      if (!chunk.matrices.empty()) {
        found = mark_different(chunk.matrices, std::span(last.matrices), range, outdated);
      } else if (!chunk.locals.empty()) {
        found = mark_different(chunk.locals, std::span(last.poses), range, outdated);
      } else if (chunk.placed_by_host()) {
        found = mark_different(std::span<const WorldTransform>(chunk.worlds), std::span(last.placed), range, outdated);
      }
      if (found) any.store(true, std::memory_order_relaxed);
    });
  }
  // World matrices that someone else has written.
  static_cast<void>(nodes.changed_since<WorldTransform>(
      tree.seen, [&](std::span<const Entity> entities, std::span<const WorldTransform> worlds, auto&&...) {
        for (std::size_t i = 0; i < entities.size(); ++i) {
          const std::uint32_t row = tree.row_of_index[entities[i].index];
          if (std::memcmp(&worlds[i].matrix, &tree.matrices[row], sizeof(dmat4)) == 0) continue;
          tree.outdated[row] = 1;
          any.store(true, std::memory_order_relaxed);
        }
      }));
  return any.load(std::memory_order_relaxed);
}

/// Keeps the inputs of the outdated rows, and takes their relative matrices.
void read_nodes(const NodeChunk& chunk, JobExecutor& jobs, TransformTree& tree, TransformTree::Inputs& inputs) {
  jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const std::size_t row = chunk.first_row + i;
      if (tree.outdated[row] == 0) continue;
      tree.matrices[row] = chunk.relative(i);
      if (!inputs.matrices.empty()) inputs.matrices[i] = chunk.matrices[i];
      if (!inputs.poses.empty()) inputs.poses[i] = chunk.locals[i];
      if (!inputs.placed.empty()) inputs.placed[i] = chunk.worlds[i];
    }
  });
}

void write_worlds(const TransformView& nodes, const NodeChunk& chunk, JobExecutor& jobs, const TransformTree& tree) {
  jobs.parallel_for(chunk.entities.size(), kRowsPerJob, [&](JobRange range) {
    bool changed = false;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (tree.outdated[chunk.first_row + i] == 0) continue;
      const dmat4& matrix = tree.matrices[chunk.first_row + i];
      changed = changed || chunk.worlds[i].matrix != matrix;
      chunk.worlds[i].matrix = matrix;
    }
    if (changed) nodes.mark_changed<WorldTransform>(chunk.entities.subspan(range.begin, range.end - range.begin));
  });
}

}  // namespace

void transform_system(TransformView nodes, Resource<TransformTree> tree, JobExecutor& jobs) {
  const std::vector<NodeChunk> chunks = gather_chunks(nodes);
  const bool same = is_same_tree(chunks, *tree);
  if (same && !find_outdated(nodes, chunks, jobs, *tree)) return;
  // Until all is written the tree has no inputs: after an exception the next call begins anew.
  std::vector<TransformTree::Inputs> kept = std::exchange(tree->chunks, {});
  if (same) {
    mark_descendants(tree->levels, tree->parents, tree->outdated);
  } else {
    rebuild_tree(chunks, jobs, *tree, kept);
  }
  for (std::size_t c = 0; c < chunks.size(); ++c) read_nodes(chunks[c], jobs, *tree, kept[c]);
  compose_worlds(tree->levels, tree->parents, tree->outdated, jobs, tree->matrices);
  for (const NodeChunk& chunk : chunks) write_worlds(nodes, chunk, jobs, *tree);
  tree->seen = nodes.changed_since<WorldTransform>(tree->seen, [](std::span<const WorldTransform>, auto&&...) {});
  tree->chunks = std::move(kept);
}

}  // namespace gloam
