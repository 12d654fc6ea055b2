// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/describe.h"

#include <string_view>

#include "engine/schedule/stage_plan.h"

namespace gloam {
namespace {

/// The type name without its leading keyword and namespaces.
std::string_view short_name(std::string_view name) {
  for (const std::string_view prefix : {"struct ", "class ", "gloam::", "{anonymous}::", "(anonymous namespace)::"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  return name;
}

void append_item(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

void append_clause(std::string& line, std::string_view word, const std::string& list) {
  if (list.empty()) return;
  line += line.back() == ':' ? " " : "; ";
  line.append(word).append(list);
}

std::string describe_access(const System& system) {
  std::string line = system.name + " (" + system.module + "):";
  std::string reads;
  std::string writes;
  for (const Access& access : system.access.accesses)
    append_item(access.write ? writes : reads, short_name(access.name));
  append_clause(line, "reads ", reads);
  append_clause(line, "writes ", writes);
  if (system.access.commands) append_clause(line, "records ", "commands");
  return line;
}

}  // namespace

std::string describe_stage(std::span<const std::unique_ptr<System>> systems, Stage stage,
                           const std::function<bool(const System&)>& runs) {
  const StagePlan plan = plan_stage(systems, stage, runs);
  std::string text;
  std::size_t next = 0;  // index of the node of the next system that runs
  for (std::size_t i = 0; i < systems.size(); ++i) {
    if (!contains(systems[i]->stages, stage)) continue;
    std::string line = (stage == Stage::world ? "world " : "view ") + describe_access(*systems[i]);
    if (next < plan.nodes.size() && plan.nodes[next].system == i) {
      std::string names;
      for (const std::uint32_t node : plan.nodes[next].waits_for)
        append_item(names, systems[plan.nodes[node].system]->name);
      append_clause(line, "waits for ", names);
      ++next;
    } else {
      append_clause(line, "", "disabled");
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace gloam
