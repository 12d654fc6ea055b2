// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gloam {

/// A JSON value whose objects keep the order of their keys. A file that uses it includes <nlohmann/json.hpp>.
using Json = nlohmann::ordered_json;

/// The text of json, indented by two spaces, with a final line break. NaN and infinity become null. Bytes that are not
/// UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace gloam
