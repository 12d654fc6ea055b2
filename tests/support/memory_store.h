// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/render/reference/reference.h"

namespace gloam::test {

/// Keeps results in memory, and counts those that were found.
class MemoryStore final : public ReferenceStore {
 public:
  [[nodiscard]] std::optional<std::string> load(const std::string& identity) const override {
    const auto found = kept.find(identity);
    if (found == kept.end()) return std::nullopt;
    ++loads;
    return found->second;
  }
  [[nodiscard]] Status save(const std::string& identity, std::string_view bytes) const override {
    kept[identity] = bytes;
    return {};
  }
  mutable std::map<std::string, std::string> kept;
  mutable int loads = 0;
};

}  // namespace gloam::test
