// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// Writes JSON text piece by piece, indented by two spaces. Numbers that JSON has no word for (NaN, infinity) become
/// null. Misuse (a value without a key inside an object, unbalanced ends) asserts.
class JsonWriter {
 public:
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);

  JsonWriter& text(std::string_view value);
  JsonWriter& number(double value);  ///< shortest text that reads back as the same double
  JsonWriter& integer(std::int64_t value);
  JsonWriter& boolean(bool value);
  JsonWriter& null();

  /// The whole text with a final line break; everything must have been ended.
  [[nodiscard]] std::string finish();

 private:
  struct Level {
    bool object = false;
    bool empty = true;
  };
  void before_value();
  void end(bool object);
  void break_line();

  std::string out_;
  std::vector<Level> levels_;
  bool has_key_ = false;
};

}  // namespace gloam
