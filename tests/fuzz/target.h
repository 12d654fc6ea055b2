// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

// Fuzz targets: code of gloam that reads what others have written. An input is accepted, or refused in one sentence.

namespace gloam::fuzz {

using Bytes = std::vector<std::uint8_t>;
using Input = std::span<const std::uint8_t>;

/// The result of one input.
struct Outcome {
  bool accepted = false;
  std::string error;  ///< the message, if the input was refused
  std::string fault;  ///< the promise that the code under test has broken; empty: none
};

/// One kind of input.
struct Format {
  std::string_view name;
  Outcome (*run)(Input input);
  std::vector<Bytes> (*seeds)();  ///< small inputs that are all accepted
  /// Words that inputs consist of; null: there are none.
  std::vector<std::string> (*words)() = nullptr;
};

struct Target {
  std::string_view name;
  /// If there are several, the first byte of an input chooses one, modulo their number.
  std::vector<Format> formats;
};

[[nodiscard]] const std::vector<Target>& targets();
/// Null if there is no target of this name.
[[nodiscard]] const Target* find_target(std::string_view name);

[[nodiscard]] Outcome run(const Target& target, Input input);
/// The seeds of all formats, with the bytes that choose them.
[[nodiscard]] std::vector<Bytes> seeds(const Target& target);
/// The words of all formats.
[[nodiscard]] std::vector<std::string> words(const Target& target);

[[nodiscard]] inline Outcome accepted() { return {.accepted = true}; }
/// A broken promise.
[[nodiscard]] inline Outcome broken(std::string fault) { return {.accepted = true, .fault = std::move(fault)}; }
/// A refusal, which is to be of this kind, and one short line that contains `place`.
[[nodiscard]] Outcome refused(const Error& error, ErrorKind kind, std::string_view place = {});
/// A refusal without a message.
[[nodiscard]] inline Outcome refused() { return {}; }

[[nodiscard]] inline std::string_view text_of(Input input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}
[[nodiscard]] inline Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
/// The lines of a text, without line breaks.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);

/// These words and the signs of JSON.
[[nodiscard]] std::vector<std::string> with_json_signs(std::vector<std::string> words);

// The targets, each in a source of its own.
[[nodiscard]] Target scene_target();
[[nodiscard]] Target keys_target();
[[nodiscard]] Target ledgers_target();
[[nodiscard]] Target blades_target();
[[nodiscard]] Target caches_target();
[[nodiscard]] Target c_interface_target();

}  // namespace gloam::fuzz
