// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/target.h"

#include <algorithm>

namespace gloam::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {scene_target(),  keys_target(),   ledgers_target(),
                                          blades_target(), caches_target(), c_interface_target()};
  return all;
}

const Target* find_target(std::string_view name) {
  const auto found = std::ranges::find(targets(), name, &Target::name);
  return found == targets().end() ? nullptr : &*found;
}

Outcome run(const Target& target, Input input) {
  if (target.formats.size() == 1) return target.formats.front().run(input);
  if (input.empty()) return refused();
  return target.formats[input[0] % target.formats.size()].run(input.subspan(1));
}

std::vector<Bytes> seeds(const Target& target) {
  std::vector<Bytes> all;
  for (std::size_t i = 0; i < target.formats.size(); ++i)
    for (Bytes& seed : target.formats[i].seeds()) {
      if (target.formats.size() > 1) seed.insert(seed.begin(), static_cast<std::uint8_t>(i));
      all.push_back(std::move(seed));
    }
  return all;
}

std::vector<std::string> words(const Target& target) {
  std::vector<std::string> all;
  for (const Format& format : target.formats)
    if (format.words != nullptr)
      for (std::string& word : format.words()) all.push_back(std::move(word));
  return all;
}

Outcome refused(const Error& error, ErrorKind kind, std::string_view place) {
  constexpr std::size_t kLongestMessage = 8192;  // lists of all knobs are long
  Outcome outcome = {.accepted = false, .error = error.message};
  const std::string& message = error.message;
  if (error.kind != kind)
    outcome.fault = "the error is of another kind: ";
  else if (message.find_first_not_of(' ') == std::string::npos)
    outcome.fault = "the error has no message";
  else if (std::ranges::any_of(message, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    outcome.fault = "the error is not one line: ";
  else if (message.size() > kLongestMessage)
    outcome.fault = "the error has " + std::to_string(message.size()) + " bytes: ";
  else if (message.find(place) == std::string::npos)
    outcome.fault = "the error does not name its place: ";
  if (!outcome.fault.empty()) outcome.fault += message.substr(0, kLongestMessage);
  return outcome;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string> with_json_signs(std::vector<std::string> words) {
  for (const char* sign : {"{", "}", "[", "]", ",", ":", "null", "true", "-1"}) words.emplace_back(sign);
  return words;
}

}  // namespace gloam::fuzz
