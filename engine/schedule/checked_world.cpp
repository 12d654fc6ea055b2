// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/checked_world.h"

#include <algorithm>
#include <string>

#include "engine/core/assert.h"

namespace gloam {
namespace {

// The checker and the system of the innermost Scope on this thread's stack.
thread_local const CheckedWorld* t_checker = nullptr;
thread_local const System* t_system = nullptr;

std::string sentence(const System& system, bool write, std::string_view what, std::string_view name, bool declared) {
  std::string text = "system \"" + system.name + "\" (module \"" + system.module + "\") ";
  text += write ? "writes " : "reads ";
  text.append(what).append(" ").append(name);
  text += declared ? ", which its signature declares as read only" : ", which its signature does not declare";
  return text;
}

}  // namespace

CheckedWorld::Scope::Scope(const CheckedWorld& checker, const System& system)
    : outer_checker_(t_checker), outer_system_(t_system) {
  t_checker = &checker;
  t_system = &system;
}

CheckedWorld::Scope::~Scope() {
  t_checker = outer_checker_;
  t_system = outer_system_;
}

const System* CheckedWorld::current() const { return t_checker == this ? t_system : nullptr; }

void CheckedWorld::component(ComponentId id, bool write) {
  const System* system = current();
  if (system == nullptr) return;
  const ComponentInfo& info = world_.components()[id];
  const Access* access = system->access.find(AccessKind::component, info.key);
  GLOAM_ASSERT(access != nullptr && (access->write || !write),
               sentence(*system, write, "component", info.name, access != nullptr));
}

void CheckedWorld::resource(std::string_view type_name, bool write) {
  const System* system = current();
  if (system == nullptr) return;
  bool declared = false;
  bool writable = false;
  for (const Access& access : system->access.accesses) {  // a type may be both a world's and a view's resource
    if (access.kind == AccessKind::component || access.name != type_name) continue;
    declared = true;
    writable = writable || access.write;
  }
  GLOAM_ASSERT(declared && (writable || !write), sentence(*system, write, "resource", type_name, declared));
}

void CheckedWorld::structure() {
  const System* system = current();
  GLOAM_ASSERT(system == nullptr, "system \"" + system->name + "\" (module \"" + system->module +
                                      "\") creates, destroys, adds or removes: it must record that in Commands");
}

void CheckedExecutor::run(std::span<const std::function<void()>> jobs) {
  inner_.parallel_for(jobs.size(), 1, [&](JobRange range) {
    const CheckedWorld::Scope scope(checker_, system_);
    jobs[range.begin]();
  });
}

void CheckedExecutor::parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) {
  inner_.parallel_for(count, grain, [&](JobRange range) {
    const CheckedWorld::Scope scope(checker_, system_);
    body(range);
  });
}

void CheckedExecutor::run_graph(std::span<JobNode> nodes) {
  std::vector<JobNode> checked(nodes.begin(), nodes.end());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    checked[i].work = [this, &work = nodes[i].work] {
      const CheckedWorld::Scope scope(checker_, system_);
      work();
    };
  }
  inner_.run_graph(checked);
}

}  // namespace gloam
