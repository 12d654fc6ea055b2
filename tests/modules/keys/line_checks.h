// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "tests/modules/keys/scene_format_table.h"

namespace gloam::test {

/// Sets a key as the importer does.
[[nodiscard]] Status set_key(const SceneKey& key, const SceneValue& value, KeyTarget& target);

/// The value of a default as the table prints it.
[[nodiscard]] SceneValue parsed_value(const std::string& words);

/// Expects that these lines are all keys of the module, that each key has the stated type, unit and default, stores the
/// good value, refuses the bad ones, and has as its default the value that the component begins with.
void expect_key_lines(std::string_view module, const std::vector<Line>& lines);

}  // namespace gloam::test
