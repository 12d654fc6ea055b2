// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/resources.h"

#include "engine/core/assert.h"
#include "engine/scene/plain_text.h"

namespace gloam {

void SceneNames::add(std::string_view kind, std::string_view name, Entity entity) {
  auto found = kinds_.find(kind);
  if (found == kinds_.end()) found = kinds_.emplace(std::string(kind), decltype(kinds_)::mapped_type()).first;
  found->second.emplace_back(std::string(name), entity);
}

Result<Entity> SceneNames::find(std::string_view kind, std::string_view name) const {
  const std::string what(kind);
  const auto found = kinds_.find(kind);
  Entity entity = kNoEntity;
  std::size_t count = 0;
  if (found != kinds_.end()) {
    for (const auto& [known, candidate] : found->second) {
      if (known != name) continue;
      if (count++ == 0) entity = candidate;
    }
  }
  if (count == 1) return entity;
  if (count > 1)
    return Error{ErrorKind::input, "the name " + in_quotes(name) + " is used by " + std::to_string(count) + " " + what +
                                       " nodes, so it names none of them"};
  const std::vector<std::string> valid = names(kind);
  if (valid.empty()) return Error{ErrorKind::usage, "no " + what + " is named " + in_quotes(name) + ", there is none"};
  std::string list;
  for (const std::string& known : valid) list += (list.empty() ? "" : ", ") + one_line(known);
  return Error{ErrorKind::usage, "no " + what + " is named " + in_quotes(name) + ", there are: " + list};
}

std::vector<std::string> SceneNames::names(std::string_view kind) const {
  std::vector<std::string> result;
  const auto found = kinds_.find(kind);
  if (found == kinds_.end()) return result;
  result.reserve(found->second.size());
  for (const auto& [name, entity] : found->second) result.push_back(name);
  return result;
}

std::string_view SceneNames::name_of(Entity entity) const {
  const auto search = [entity](const auto& named) -> std::string_view {
    for (const auto& [name, candidate] : named)
      if (candidate == entity) return name;
    return {};
  };
  // A node's own name comes before what a light or a camera on it is called.
  if (const auto nodes = kinds_.find("node"); nodes != kinds_.end())
    if (const std::string_view name = search(nodes->second); !name.empty()) return name;
  for (const auto& [kind, named] : kinds_)
    if (const std::string_view name = search(named); !name.empty()) return name;
  return {};
}

std::uint32_t SceneStrings::intern(std::string_view text) {
  for (std::size_t i = 0; i < texts_.size(); ++i)
    if (texts_[i] == text) return static_cast<std::uint32_t>(i);
  texts_.emplace_back(text);
  return static_cast<std::uint32_t>(texts_.size() - 1);
}

const std::string& SceneStrings::text(std::uint32_t id) const {
  GLOAM_ASSERT(id < texts_.size(), "a string's number comes from intern of the same SceneStrings");
  return texts_[id];
}

}  // namespace gloam
