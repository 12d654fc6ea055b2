// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/resources.h"

#include "engine/core/assert.h"
#include "engine/core/text/nearest_name.h"
#include "engine/core/text/plain_text.h"

namespace gloam {

void SceneNames::add(std::string_view kind, std::string_view name, Entity entity) {
  auto found = kinds_.find(kind);
  if (found == kinds_.end()) found = kinds_.emplace(std::string(kind), Kind()).first;
  found->second.order.emplace_back(name);
  Named& named = found->second.by_name[std::string(name)];
  if (named.count++ == 0) named.first = entity;
  if (kind == "node")
    names_.insert_or_assign(entity, std::string(name));
  else
    names_.try_emplace(entity, name);
}

Result<Entity> SceneNames::find(std::string_view kind, std::string_view name) const {
  const std::string what = one_line(kind);
  const auto unknown = [&](const std::vector<std::string>& names) {
    return Error{ErrorKind::usage, "no " + what + " is named " + in_quotes(name) + "; " + valid_names(name, names)};
  };
  const auto found = kinds_.find(kind);
  if (found == kinds_.end()) return unknown({});
  const auto named = found->second.by_name.find(std::string(name));
  if (named == found->second.by_name.end()) {
    std::vector<std::string> names;
    for (const std::string& known : found->second.order) names.push_back(one_line(known));
    return unknown(names);
  }
  if (named->second.count > 1)
    return Error{ErrorKind::input, "the name " + in_quotes(name) + " is used by " +
                                       std::to_string(named->second.count) + " " + what +
                                       " nodes, so it names none of them"};
  return named->second.first;
}

std::vector<std::string> SceneNames::names(std::string_view kind) const {
  const auto found = kinds_.find(kind);
  return found == kinds_.end() ? std::vector<std::string>() : found->second.order;
}

std::string_view SceneNames::name_of(Entity entity) const {
  const auto found = names_.find(entity);
  return found == names_.end() ? std::string_view() : std::string_view(found->second);
}

std::uint32_t SceneStrings::intern(std::string_view text) {
  const auto [found, added] = ids_.try_emplace(std::string(text), static_cast<std::uint32_t>(texts_.size()));
  if (added) texts_.emplace_back(text);
  return found->second;
}

const std::string& SceneStrings::text(std::uint32_t id) const {
  GLOAM_ASSERT(id < texts_.size(), "a string's number comes from intern of the same SceneStrings");
  return texts_[id];
}

}  // namespace gloam
