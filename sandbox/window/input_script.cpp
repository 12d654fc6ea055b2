// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/input_script.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "sandbox/window/gamepad.h"

namespace gloam {
namespace {

using Kind = ScriptEvent::Kind;

enum class Arguments : std::uint8_t { none, number, steps, point, text, named_number };

struct EventName {
  std::string_view name;
  Kind kind;
  Arguments arguments;
};
constexpr EventName kNames[] = {
    {"wait", Kind::wait, Arguments::number},
    {"pace", Kind::pace, Arguments::number},
    {"key", Kind::key, Arguments::text},
    {"hold", Kind::hold, Arguments::text},
    {"release", Kind::release, Arguments::text},
    {"move", Kind::move, Arguments::point},
    {"press", Kind::press, Arguments::none},
    {"lift", Kind::lift, Arguments::none},
    {"grab", Kind::grab, Arguments::none},
    {"let_go", Kind::let_go, Arguments::none},
    {"widget", Kind::widget, Arguments::text},
    {"scroll", Kind::scroll, Arguments::steps},
    {"type", Kind::type, Arguments::text},
    {"resize", Kind::resize, Arguments::point},
    {"minimise", Kind::minimise, Arguments::none},
    {"restore", Kind::restore, Arguments::none},
    {"pad", Kind::pad, Arguments::named_number},
    {"drop", Kind::drop, Arguments::text},
    {"say", Kind::say, Arguments::text},
    {"until", Kind::until, Arguments::text},
    {"close", Kind::close, Arguments::none},
    {"click", Kind::move, Arguments::point},
    {"click_widget", Kind::widget, Arguments::text},
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Takes a number from the begin of the text.
std::optional<double> take_number(std::string_view& text) {
  text = trimmed(text);
  double number = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return number;
}

/// Sets the event's members from the text after its name. Returns whether they fit.
bool read_arguments(std::string_view text, Arguments arguments, ScriptEvent& event) {
  if (arguments == Arguments::text) {
    event.text = trimmed(text);
    return !event.text.empty();
  }
  if (arguments == Arguments::named_number) {
    text = trimmed(text);
    event.text = text.substr(0, text.find(' '));
    text.remove_prefix(event.text.size());
    if (!Gamepad().set(event.text, 0.0f)) return false;
  }
  if (arguments == Arguments::number || arguments == Arguments::point || arguments == Arguments::named_number) {
    const auto x = take_number(text);
    if (!x) return false;
    event.x = *x;
  }
  if (arguments == Arguments::steps || arguments == Arguments::point) {
    const auto y = take_number(text);
    if (!y) return false;
    event.y = *y;
  }
  return trimmed(text).empty();
}

}  // namespace

Result<InputScript> InputScript::parse(std::string_view text, std::string_view source) {
  InputScript script;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::string_view name = line.substr(0, line.find(' '));
    ScriptEvent event;
    bool known = false;
    for (const EventName& candidate : kNames) {
      if (candidate.name != name) continue;
      event.kind = candidate.kind;
      known = read_arguments(line.substr(name.size()), candidate.arguments, event);
    }
    if (!known)
      return Error{ErrorKind::usage,
                   std::string(source) + ":" + std::to_string(number) + ": not an event: '" + std::string(line) + "'"};
    script.events_.push_back(std::move(event));
    if (name.starts_with("click")) {
      script.events_.push_back({.kind = Kind::press});
      script.events_.push_back({.kind = Kind::lift});
    }
  }
  return script;
}

}  // namespace gloam
