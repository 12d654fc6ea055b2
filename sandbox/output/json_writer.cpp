// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/json_writer.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

void append_escaped(std::string& out, std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20) {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace

JsonWriter& JsonWriter::begin_object() {
  before_value();
  out_ += '{';
  levels_.push_back({.object = true});
  return *this;
}

JsonWriter& JsonWriter::begin_array() {
  before_value();
  out_ += '[';
  levels_.push_back({.object = false});
  return *this;
}

JsonWriter& JsonWriter::end_object() {
  end(true);
  return *this;
}

JsonWriter& JsonWriter::end_array() {
  end(false);
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  GLOAM_ASSERT(!levels_.empty() && levels_.back().object && !has_key_, "a key stands in an object, before its value");
  if (!levels_.back().empty) out_ += ',';
  levels_.back().empty = false;
  break_line();
  append_escaped(out_, name);
  out_ += ": ";
  has_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::text(std::string_view value) {
  before_value();
  append_escaped(out_, value);
  return *this;
}

JsonWriter& JsonWriter::number(double value) {
  if (!std::isfinite(value)) return null();
  before_value();
  char digits[40];
  const auto [end, fault] = std::to_chars(digits, digits + sizeof(digits), value);
  GLOAM_ASSERT(fault == std::errc(), "a double fits 40 characters");
  out_.append(digits, end);
  return *this;
}

JsonWriter& JsonWriter::integer(std::int64_t value) {
  before_value();
  out_ += std::to_string(value);
  return *this;
}

JsonWriter& JsonWriter::boolean(bool value) {
  before_value();
  out_ += value ? "true" : "false";
  return *this;
}

JsonWriter& JsonWriter::null() {
  before_value();
  out_ += "null";
  return *this;
}

std::string JsonWriter::finish() {
  GLOAM_ASSERT(levels_.empty(), "every object and array is ended before the text is taken");
  out_ += '\n';
  return std::exchange(out_, std::string());
}

void JsonWriter::before_value() {
  if (has_key_) {
    has_key_ = false;
    return;
  }
  GLOAM_ASSERT(levels_.empty() || !levels_.back().object, "a value in an object follows its key");
  if (levels_.empty()) return;
  if (!levels_.back().empty) out_ += ',';
  levels_.back().empty = false;
  break_line();
}

void JsonWriter::end(bool object) {
  GLOAM_ASSERT(!levels_.empty() && levels_.back().object == object && !has_key_, "an end matches the innermost begin");
  const bool empty = levels_.back().empty;
  levels_.pop_back();
  if (!empty) break_line();
  out_ += object ? '}' : ']';
}

void JsonWriter::break_line() {
  out_ += '\n';
  out_.append(levels_.size() * 2, ' ');
}

}  // namespace gloam
