// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/parsing/json_scan.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "engine/scene/gltf/parsing/json_rules.h"
#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

using Kind = SceneValue::Kind;

// Limited because later readers of extras and extensions recurse.
constexpr std::size_t kMaxDepth = 96;
constexpr double kMaxIndex = 2147483647.0;

/// An open object or array.
struct Frame {
  bool is_array = false;
  Form form = Form::any;         ///< form of this object or array
  std::string_view type;         ///< object: its type; array of objects: type of its items
  std::span<const Rule> rules;   ///< object: rules of its type
  std::uint64_t seen = 0;        ///< object: one bit per rule whose member was seen
  const Rule* rule = nullptr;    ///< object: rule of the open member; null if it has none
  const Rule* origin = nullptr;  ///< array, index map: rule of the member that holds it
  std::string member;            ///< object: name of the open member
  std::uint64_t items = 0;       ///< array: items begun so far
  bool stray_extras = false;     ///< object: extras of an element that takes no keys
  SceneValue* keep = nullptr;    ///< where the value is copied to, or null
};

std::string_view form_text(Form form) {
  switch (form) {
    case Form::text:
    case Form::texts:
    case Form::word:
      return "a string";
    case Form::boolean:
      return "true or false";
    case Form::number:
    case Form::numbers:
      return "a number";
    case Form::index:
    case Form::indices:
      return "an integer in 0…2147483647";
    case Form::size:
      return "an integer ≥ 0";
    case Form::object:
    case Form::objects:
    case Form::index_map:
    case Form::index_maps:
    case Form::any:
      break;
  }
  return "an object";
}

bool is_list(Form form) {
  return form == Form::numbers || form == Form::indices || form == Form::texts || form == Form::objects ||
         form == Form::index_maps;
}

bool fits(Form form, const SceneValue& value) {
  switch (form) {
    case Form::any:
      return true;
    case Form::text:
    case Form::word:
      return value.kind == Kind::text;
    case Form::boolean:
      return value.kind == Kind::boolean;
    case Form::number:
      return value.kind == Kind::number;
    case Form::index:
      return value.kind == Kind::number && value.integral && value.number >= 0.0 && value.number <= kMaxIndex;
    case Form::size:
      return value.kind == Kind::number && value.integral && value.number >= 0.0;
    default:
      return false;
  }
}

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

/// Form of the items of a list.
Form item_form(Form list) {
  switch (list) {
    case Form::numbers:
      return Form::number;
    case Form::indices:
      return Form::index;
    case Form::texts:
      return Form::text;
    case Form::objects:
      return Form::object;
    case Form::index_maps:
      return Form::index_map;
    default:
      return Form::any;
  }
}

class Scanner {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  bool null() { return scalar({}); }
  bool boolean(bool value) { return scalar({.kind = Kind::boolean, .boolean = value}); }
  bool number_integer(number_integer_t value) {
    exact_ = value < 0 ? 0 : static_cast<std::uint64_t>(value);  // -0
    return number(static_cast<double>(value), true);
  }
  bool number_unsigned(number_unsigned_t value) {
    exact_ = value;
    return number(static_cast<double>(value), true);
  }
  bool number_float(number_float_t value, const string_t&) { return number(value, false); }
  bool string(string_t& value) { return scalar({.kind = Kind::text, .text = std::move(value)}); }
  bool binary(binary_t&) { return false; }
  bool start_object(std::size_t) { return open(false); }
  bool start_array(std::size_t) { return open(true); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(string_t& name);
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    const std::string_view what = error.what();
    const std::size_t id_end = what.find("] ");
    error_ = "is not valid JSON: " + one_line(id_end == what.npos ? what : what.substr(id_end + 2), 200);
    return false;
  }

  /// Compares indices with the sizes of the arrays that they refer to. Call it after the whole text was read.
  void check_references();

  std::string error_;
  JsonScan scan_;

 private:
  struct Expected {
    Form form = Form::any;
    std::string_view item;
  };

  bool number(double value, bool integral) {
    return scalar({.kind = Kind::number, .number = value, .integral = integral});
  }
  bool scalar(SceneValue value);
  bool open(bool is_array);
  bool close();
  Expected expected() const;
  void wrong(const Expected& expected, bool list);
  void note(const std::string& fault);
  std::string here() const;
  SceneValue* kept_place(SceneValue value);
  SceneValue* attachment_place(const Frame& frame);
  void take(const SceneValue& value);
  void take_reference(const SceneValue& value);

  /// The largest index found under one rule, and its place.
  struct Reference {
    double index = -1.0;
    std::string place;
  };

  std::unordered_map<const Rule*, Reference> references_;
  std::unordered_map<std::string_view, std::uint64_t> counts_;  ///< sizes of the root's arrays
  std::vector<Frame> frames_;
  std::uint64_t exact_ = 0;  ///< last unsigned number; a double may round it
};

Scanner::Expected Scanner::expected() const {
  if (frames_.empty()) return {Form::object, kRootType};
  const Frame& top = frames_.back();
  if (top.is_array) return {item_form(top.form), top.type};
  if (top.form == Form::index_map) return {Form::index, {}};
  if (top.rule == nullptr) return {};
  return {top.rule->form, top.rule->item};
}

/// Current place of the scan: "node 12: ", "mesh 3, primitive 0: ", "accessor 7, sparse: "; empty at the root.
std::string Scanner::here() const {
  std::string text;
  for (std::size_t i = 1; i < frames_.size(); ++i) {
    const Frame& frame = frames_[i];
    if (frame.is_array || frame.form == Form::any) continue;
    const Frame& around = frames_[i - 1];
    if (!text.empty()) text += ", ";
    text +=
        around.is_array ? place(frame.type.empty() ? "item" : frame.type, around.items - 1) : one_line(around.member);
  }
  return text.empty() ? text : text + ": ";
}

void Scanner::note(const std::string& fault) {
  if (scan_.first_fault.empty()) scan_.first_fault = here() + fault;
}

void Scanner::wrong(const Expected& expected, bool list) {
  std::string subject = "the root";
  if (!frames_.empty()) {
    const Frame& top = frames_.back();
    subject = one_line(top.is_array ? (frames_.size() > 1 ? frames_[frames_.size() - 2].member : "item") : top.member);
    if (top.is_array) subject += "[" + std::to_string(top.items - 1) + "]";
  }
  note(subject + " must be " + (list ? "an array" : std::string(form_text(expected.form))));
}

bool Scanner::key(string_t& name) {
  Frame& top = frames_.back();
  top.rule = nullptr;
  for (std::size_t i = 0; i < top.rules.size(); ++i) {
    if (top.rules[i].member != name) continue;
    top.rule = &top.rules[i];
    if ((top.seen >> i & 1u) != 0) note(std::string(name) + " is given twice");
    top.seen |= std::uint64_t{1} << i;
  }
  if (top.stray_extras && name.starts_with("gloam.")) scan_.stray_keys.push_back({here(), name});
  top.member = std::move(name);
  return true;
}

/// Where the open member is kept, if it is the extras or extensions of a type that keeps them; else null.
SceneValue* Scanner::attachment_place(const Frame& frame) {
  const bool extras = frame.member == "extras";
  if (!extras && frame.member != "extensions") return nullptr;
  if (frames_.size() == 1) return extras ? nullptr : &scan_.root_extensions;
  std::vector<Attachments>* list = frame.type == kNodeType       ? &scan_.nodes
                                   : frame.type == kMaterialType ? &scan_.materials
                                   : frame.type == kSceneType    ? &scan_.scenes
                                                                 : nullptr;
  if (list == nullptr) return nullptr;
  const std::uint64_t index = frames_[frames_.size() - 2].items - 1;
  if (index >= list->size()) list->resize(index + 1);
  SceneValue& value = extras ? (*list)[index].extras : (*list)[index].extensions;
  value = {};
  return &value;
}

/// Adds a value to the tree that is being kept and returns it there; null if it is not kept.
SceneValue* Scanner::kept_place(SceneValue value) {
  if (frames_.empty()) return nullptr;
  Frame& top = frames_.back();
  if (top.keep == nullptr) {
    SceneValue* place = top.is_array ? nullptr : attachment_place(top);
    if (place != nullptr) *place = std::move(value);
    return place;
  }
  if (top.is_array) return &top.keep->items.emplace_back(std::move(value));
  return &top.keep->members.emplace_back(SceneMember{top.member, std::move(value)}).value;
}

/// Stores the members that are needed before the document is read.
void Scanner::take(const SceneValue& value) {
  const Frame& top = frames_.back();
  if (top.is_array) {
    if (top.form != Form::texts || frames_.size() != 2) return;
    auto& list = frames_[0].member == "extensionsUsed" ? scan_.extensions_used : scan_.extensions_required;
    list.push_back(value.text);
    return;
  }
  if (top.type == "asset" && top.member == "version") scan_.version = value.text;
  if (top.type == "compressed buffer" && top.member == "fallback" && value.boolean && !scan_.buffers.empty())
    scan_.buffers.back().fallback = true;
  const bool buffer = top.type == "buffer";
  const std::uint64_t whole = value.integral ? exact_ : 0;
  if (frames_.size() == 3 && top.type == "buffer view") {
    if (top.member == "buffer") scan_.views.back().buffer = whole;
    if (top.member == "byteOffset") scan_.views.back().offset = whole;
    if (top.member == "byteLength") scan_.views.back().length = whole;
  }
  if (frames_.size() != 3 || (!buffer && top.type != "image")) return;
  ByteSource& source = (buffer ? scan_.buffers : scan_.images).back();
  if (top.member == "byteLength") source.byte_length = whole;
  if (top.member == "bufferView") source.view = whole;
  if (top.member != "uri") return;
  source.data_uri = value.text.starts_with("data:");
  source.uri = source.data_uri ? value.text.substr(0, 64) : value.text;
}

bool Scanner::scalar(SceneValue value) {
  if (!frames_.empty() && frames_.back().is_array) ++frames_.back().items;
  const Expected wanted = expected();
  if (!fits(wanted.form, value)) {
    // Old exporters write version 1 as a number. Another number is a fault of a file of version 2.
    if (!frames_.empty() && frames_.back().type == "asset" && frames_.back().member == "version" &&
        value.kind == Kind::number && value.number < 2.0)
      scan_.version = nlohmann::json(value.number).dump();
    wrong(wanted, is_list(wanted.form));
    return !frames_.empty();
  }
  if (wanted.form == Form::word && !has_word(wanted.item, value.text))
    note(std::string(frames_.back().member) + " must be one of " + std::string(wanted.item) + ", is " +
         in_quotes(value.text));
  take_reference(value);
  take(value);
  kept_place(std::move(value));
  return true;
}

void Scanner::take_reference(const SceneValue& value) {
  const Frame& top = frames_.back();
  const Rule* rule = top.is_array || top.form == Form::index_map ? top.origin : top.rule;
  if (rule == nullptr || rule->refers.empty()) return;
  Reference& reference = references_[rule];
  if (value.number <= reference.index) return;
  reference = {value.number, here() + (top.form == Form::index_map ? one_line(top.member) : std::string(rule->member))};
}

void Scanner::check_references() {
  const Reference* first = nullptr;
  const Rule* first_rule = nullptr;
  for (const auto& [rule, reference] : references_) {
    if (reference.index < static_cast<double>(counts_[rule->refers])) continue;
    if (first_rule != nullptr && first_rule < rule) continue;
    first = &reference;
    first_rule = rule;
  }
  if (first == nullptr || !scan_.first_fault.empty()) return;
  scan_.first_fault = first->place + " is " + std::to_string(static_cast<std::uint64_t>(first->index)) +
                      ", but the file has " + std::to_string(counts_[first_rule->refers]) + " " +
                      std::string(first_rule->refers);
}

bool Scanner::open(bool is_array) {
  if (frames_.size() >= kMaxDepth) {
    error_ = "is nested deeper than " + std::to_string(kMaxDepth) + " levels";
    return false;
  }
  if (!frames_.empty() && frames_.back().is_array) ++frames_.back().items;
  const Expected wanted = expected();
  const bool list = is_list(wanted.form);
  const bool object = wanted.form == Form::object || wanted.form == Form::index_map;
  const bool right = wanted.form == Form::any || (is_array ? list : object);
  if (!right) wrong(wanted, list);
  Frame frame;
  frame.is_array = is_array;
  frame.keep = kept_place({.kind = is_array ? Kind::array : Kind::object});
  if (!frames_.empty() && !is_array && !frames_.back().is_array && frames_.back().member == "extras")
    frame.stray_extras = frames_.size() == 1 || frame.keep == nullptr || frames_.back().keep != nullptr;
  if (right) {
    frame.form = wanted.form;
    frame.type = wanted.item;
    if (!frames_.empty()) frame.origin = frames_.back().is_array ? frames_.back().origin : frames_.back().rule;
    if (!is_array && frame.form == Form::object) frame.rules = rules_of(frame.type);
  }
  if (frame.type == "compressed mesh") scan_.compressed_meshes = true;
  if (!is_array && frames_.size() == 2) {
    if (frame.type == "buffer") scan_.buffers.emplace_back();
    if (frame.type == "image") scan_.images.emplace_back();
    if (frame.type == "buffer view") scan_.views.emplace_back();
  }
  frames_.push_back(std::move(frame));
  return true;
}

bool Scanner::close() {
  const Frame& top = frames_.back();
  for (std::size_t i = 0; i < top.rules.size(); ++i)
    if (top.rules[i].required && (top.seen >> i & 1u) == 0) note(std::string(top.rules[i].member) + " is missing");
  if (top.is_array && top.origin != nullptr) {
    const Rule& rule = *top.origin;
    const std::string member(rule.member);
    if (frames_.size() == 2) counts_[rule.member] = top.items;
    if (top.form == Form::numbers && rule.count > 0 && top.items != rule.count)
      note(member + " must be " + std::to_string(rule.count) + " numbers, has " + std::to_string(top.items));
    if (top.form == Form::objects && rule.count > 0 && top.items > rule.count)
      note(member + " has " + std::to_string(top.items) + " items, more than " + std::to_string(rule.count));
  }
  frames_.pop_back();
  return true;
}

}  // namespace

Result<JsonScan> scan_json(std::string_view text) {
  Scanner scanner;
  const bool read = nlohmann::json::sax_parse(text.begin(), text.end(), &scanner);
  if (!read) {
    if (scanner.error_.empty()) scanner.error_ = "is not a glTF file: its root is not an object";
    return Error{ErrorKind::input, scanner.error_};
  }
  scanner.check_references();
  return std::move(scanner.scan_);
}

}  // namespace gloam::gltf
