// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/subjects.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr std::size_t kMeshGrain = 1024;  // instances per job
constexpr int kDeepestNode = 4096;        // ends the search if parents form a cycle

/// A mesh instance of a subject.
struct OwnedMesh {
  std::size_t subject = 0;
  Entity entity;
};

std::vector<CloseupSubjects::Subject> enabled_subjects(const View<const CloseupSubject>& subjects) {
  std::vector<CloseupSubjects::Subject> found;
  subjects.each([&](Entity entity, const CloseupSubject& subject) {
    if (!subject.enabled) return;
    CloseupSubjects::Subject& to = found.emplace_back();
    to.entity = entity;
    to.priority = std::isnan(subject.priority) ? 0.0f : subject.priority;
    to.lights = subject.lights;
  });
  std::ranges::sort(found, {}, [](const CloseupSubjects::Subject& s) { return s.entity.index; });
  return found;
}

/// The innermost subject at or above a node; subjects.size() if there is none.
std::size_t owner_of(Entity node, const View<const Parent>& parents,
                     const std::vector<CloseupSubjects::Subject>& subjects) {
  for (int step = 0; step < kDeepestNode; ++step) {
    const auto subject = std::ranges::lower_bound(subjects, node.index, {},
                                                  [](const CloseupSubjects::Subject& s) { return s.entity.index; });
    if (subject != subjects.end() && subject->entity == node)
      return static_cast<std::size_t>(subject - subjects.begin());
    const Parent* parent = parents.try_get<Parent>(node);
    if (parent == nullptr) break;
    node = parent->entity;
  }
  return subjects.size();
}

/// Every mesh instance of a subject, in the order of the world's rows.
std::vector<OwnedMesh> owned_meshes(const PosedMeshes& meshes, const View<const Parent>& parents,
                                    const std::vector<CloseupSubjects::Subject>& subjects, JobExecutor& jobs) {
  std::vector<std::vector<OwnedMesh>> found(meshes.chunk_count(kMeshGrain));
  meshes.parallel_chunks(jobs, kMeshGrain,
                         [&](std::size_t ordinal, std::span<const Entity> entities, std::span<const MeshInstance>,
                             std::span<const WorldTransform>, std::span<const MorphInstance>) {
                           for (const Entity entity : entities) {
                             const std::size_t subject = owner_of(entity, parents, subjects);
                             if (subject < subjects.size()) found[ordinal].push_back({subject, entity});
                           }
                         });
  std::vector<OwnedMesh> all;
  for (const std::vector<OwnedMesh>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void find_box(const PosedScene& scene, const PosedMeshes& meshes, CloseupSubjects::Subject& subject) {
  BoxSum sum;
  for (const Entity entity : subject.casters)
    add_posed(scene, entity, *meshes.try_get<MeshInstance>(entity), meshes.try_get<WorldTransform>(entity)->matrix,
              meshes.try_get<MorphInstance>(entity), sum);
  if (sum.unknown || !sum.box.known()) return;
  subject.low = sum.box.min;
  subject.high = sum.box.max;
}

}  // namespace

void closeup_subjects_system(View<const CloseupSubject> subjects, PosedMeshes meshes, View<const Parent> parents,
                             Resource<const SceneAssets> assets, Resource<const JointMatrices> joints,
                             Resource<const MorphWeights> weights, Resource<CloseupMeshes> bounds,
                             Resource<CloseupSubjects> found, JobExecutor& jobs) {
  found->subjects = enabled_subjects(subjects);
  if (found->subjects.empty()) return;
  update_closeup_meshes(*assets, jobs, *bounds);
  for (const OwnedMesh& mesh : owned_meshes(meshes, parents, found->subjects, jobs))
    found->subjects[mesh.subject].casters.push_back(mesh.entity);
  const PosedScene scene{*assets, *bounds, *joints, *weights};
  jobs.parallel_for(found->subjects.size(), 1, [&](JobRange range) {
    for (std::size_t s = range.begin; s < range.end; ++s) {
      CloseupSubjects::Subject& subject = found->subjects[s];
      std::ranges::sort(subject.casters, {}, &Entity::index);
      find_box(scene, meshes, subject);
    }
  });
}

void closeup_receivers_system(View<const Light> lights, PosedMeshes meshes, Resource<const SceneAssets> assets,
                              Resource<const JointMatrices> joints, Resource<const MorphWeights> weights,
                              Resource<const CloseupMeshes> bounds, Resource<const CloseupSubjects> subjects,
                              Resource<CloseupReceivers> receivers, JobExecutor& jobs) {
  receivers->box = {};
  bool directional = false;
  lights.each([&](const Light& light) { directional = directional || light.kind == LightKind::directional; });
  if (!directional || std::ranges::none_of(subjects->subjects, &CloseupSubjects::Subject::known)) return;
  const PosedScene scene{*assets, *bounds, *joints, *weights};
  std::vector<BoxSum> found(meshes.chunk_count(kMeshGrain));
  meshes.parallel_chunks(
      jobs, kMeshGrain,
      [&](std::size_t ordinal, std::span<const Entity> entities, std::span<const MeshInstance> instances,
          std::span<const WorldTransform> transforms, std::span<const MorphInstance> morphs) {
        for (std::size_t i = 0; i < entities.size(); ++i)
          add_posed(scene, entities[i], instances[i], transforms[i].matrix, morphs.empty() ? nullptr : &morphs[i],
                    found[ordinal]);
      });
  BoxSum all;
  for (const BoxSum& part : found) all.add(part);
  receivers->box = all.box;  // all.unknown is ignored: an instance without a finite position shows no shadow
}

}  // namespace gloam
