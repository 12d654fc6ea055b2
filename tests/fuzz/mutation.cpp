// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "tests/support/gltf_files.h"

namespace gloam::fuzz {
namespace {

std::size_t below(Random& random, std::size_t count) { return count == 0 ? 0 : random() % count; }

std::string_view interesting_number(Random& random) {
  constexpr std::array<std::string_view, 24> kNumbers = {"0",
                                                         "1",
                                                         "-1",
                                                         "2",
                                                         "3",
                                                         "255",
                                                         "256",
                                                         "65535",
                                                         "65536",
                                                         "16777216",
                                                         "2147483647",
                                                         "2147483648",
                                                         "4294967295",
                                                         "4294967296",
                                                         "9007199254740993",
                                                         "18446744073709551615",
                                                         "1e30",
                                                         "-1e30",
                                                         "1e300",
                                                         "0.5",
                                                         "1e-40",
                                                         "5126",
                                                         "5121",
                                                         "null"};
  return kNumbers[below(random, kNumbers.size())];
}

bool is_number_byte(std::uint8_t byte) { return (byte >= '0' && byte <= '9') || byte == '.' || byte == '-'; }

/// Replaces one of the numbers of a text; most of a data URI has letters between its digits, so structure is hit often.
void replace_number(Bytes& text, Random& random) {
  const std::size_t start = below(random, text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t at = (start + i) % text.size();
    const bool begins = is_number_byte(text[at]) && at > 0 &&
                        std::string_view(" [,:=x/\n").find(static_cast<char>(text[at - 1])) != std::string_view::npos;
    if (!begins) continue;
    std::size_t end = at;
    while (end < text.size() && is_number_byte(text[end])) ++end;
    const std::string number =
        below(random, 2) == 0 ? std::string(interesting_number(random)) : std::to_string(below(random, 12));
    text.erase(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end));
    text.insert(text.begin() + static_cast<std::ptrdiff_t>(at), number.begin(), number.end());
    return;
  }
}

/// Replaces digits of a data URI, which changes bytes of the buffer. Does nothing if there is none.
void change_data_uri(Bytes& text, Random& random) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::string_view kMark = "base64,";
  const auto mark = std::search(text.begin(), text.end(), kMark.begin(), kMark.end());
  const auto begin = text.end() - mark < 16 ? text.end() : mark + static_cast<std::ptrdiff_t>(kMark.size());
  const auto end = std::find(begin, text.end(), '=');
  const auto last = std::min(end, std::find(begin, text.end(), '"'));
  for (std::size_t i = 0, count = 1 + below(random, 8); i < count && begin != last; ++i)
    begin[static_cast<std::ptrdiff_t>(below(random, static_cast<std::size_t>(last - begin)))] =
        static_cast<std::uint8_t>(kDigits[below(random, kDigits.size())]);
}

/// A random range; mostly short.
std::span<const std::uint8_t> piece(const Bytes& bytes, Random& random) {
  const std::size_t begin = below(random, bytes.size());
  const std::size_t longest = below(random, 4) == 0 ? bytes.size() : 64;
  return std::span(bytes).subspan(begin, below(random, std::min(longest, bytes.size() - begin) + 1));
}

bool is_word_byte(std::uint8_t byte) {
  return is_number_byte(byte) || byte == '_' || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}

/// Puts a word at a random place, or in the place of the word that is there.
void put_word(Bytes& text, std::span<const std::string> words, Random& random) {
  if (words.empty() || text.empty()) return;
  const std::string& word = words[below(random, words.size())];
  const auto at = text.begin() + static_cast<std::ptrdiff_t>(below(random, text.size()));
  auto first = at, last = at;
  if (below(random, 3) > 0) {
    while (first != text.begin() && is_word_byte(first[-1])) --first;
    last = std::find_if_not(at, text.end(), is_word_byte);
  }
  text.insert(text.erase(first, last), word.begin(), word.end());
}

/// Overwrites four bytes at a multiple of four with a number at which binary formats end.
void put_number_bytes(Bytes& bytes, Random& random) {
  constexpr std::array<std::uint32_t, 10> kNumbers = {0,          1,          2,          0xffu,       0xffffu,
                                                      0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000u, 0x7fc00000u};
  if (bytes.size() < 4) return;
  const std::size_t at = below(random, bytes.size() / 4) * 4;
  const std::uint32_t number = kNumbers[below(random, kNumbers.size())];
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(number >> (8 * i));
}

void change(Bytes& bytes, std::span<const Bytes> seeds, std::span<const std::string> words, Random& random) {
  if (bytes.empty()) return;
  const auto place = [&] { return bytes.begin() + static_cast<std::ptrdiff_t>(below(random, bytes.size())); };
  switch (below(random, 13)) {
    case 0:
      bytes.resize(below(random, bytes.size()));
      break;
    case 1:
    case 2:
      for (std::size_t i = 0, count = 1 + below(random, 16); i < count; ++i)
        *place() = static_cast<std::uint8_t>(random());
      break;
    case 3: {
      const std::span<const std::uint8_t> copied = piece(bytes, random);
      const Bytes copy(copied.begin(), copied.end());
      bytes.insert(place(), copy.begin(), copy.end());
      break;
    }
    case 4: {
      const std::span<const std::uint8_t> removed = piece(bytes, random);
      const auto begin = bytes.begin() + (removed.data() - bytes.data());
      bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(removed.size()));
      break;
    }
    case 5: {
      const std::size_t length = 1 + below(random, std::min<std::size_t>(bytes.size() / 2, 256));
      const std::size_t a = below(random, bytes.size() - length + 1), b = below(random, bytes.size() - length + 1);
      for (std::size_t i = 0; i < length; ++i) std::swap(bytes[a + i], bytes[b + i]);
      break;
    }
    case 6: {
      const std::span<const std::uint8_t> other = piece(seeds[below(random, seeds.size())], random);
      bytes.insert(place(), other.begin(), other.end());
      break;
    }
    case 7:
      put_number_bytes(bytes, random);
      break;
    case 8:
    case 9:
      put_word(bytes, words, random);
      break;
    default:
      replace_number(bytes, random);
      break;
  }
}

std::size_t word_at(const Bytes& bytes, std::size_t at) {
  return bytes[at] | std::size_t{bytes[at + 1]} << 8 | std::size_t{bytes[at + 2]} << 16 |
         std::size_t{bytes[at + 3]} << 24;
}

void flip_bytes(Bytes& bytes, Random& random) {
  for (std::size_t i = 0, count = 1 + below(random, 8); i < count && !bytes.empty(); ++i)
    bytes[below(random, bytes.size())] = static_cast<std::uint8_t>(random());
}

/// Changes the chunks of a sound .glb and packs them again.
void change_chunks(Bytes& glb, bool keep_form, std::span<const Bytes> seeds, std::span<const std::string> words,
                   Random& random) {
  const std::size_t json_end = 20 + word_at(glb, 12);
  Bytes json(glb.begin() + 20, glb.begin() + static_cast<std::ptrdiff_t>(json_end));
  Bytes bin(glb.begin() + static_cast<std::ptrdiff_t>(std::min(json_end + 8, glb.size())), glb.end());
  const bool in_buffer = below(random, 4) == 0;
  if (!keep_form)
    change(in_buffer ? bin : json, seeds, words, random);
  else if (in_buffer)
    flip_bytes(bin, random);
  else
    replace_number(json, random);
  glb = test::make_glb(std::string(json.begin(), json.end()), bin);
}

}  // namespace

Bytes mutate(std::span<const Bytes> seeds, std::span<const std::string> words, std::size_t fixed, Random& random) {
  const Bytes& seed = seeds[below(random, seeds.size())];
  fixed = std::min(fixed, seed.size());
  Bytes bytes(seed.begin() + static_cast<std::ptrdiff_t>(fixed), seed.end());
  const std::size_t changes = 1 + below(random, 4);
  const bool glb = bytes.size() > 20 && bytes[0] == 'g' && bytes[1] == 'l' && word_at(bytes, 12) <= bytes.size() - 20;
  const bool keep_form = below(random, 2) == 0;
  const bool keep_chunks = glb && (keep_form || below(random, 2) == 0);
  for (std::size_t i = 0; i < changes; ++i) {
    if (keep_chunks)
      change_chunks(bytes, keep_form, seeds, words, random);
    else if (keep_form && below(random, 4) == 0)
      change_data_uri(bytes, random);
    else if (keep_form && below(random, 2) == 0)
      put_word(bytes, words, random);
    else if (keep_form)
      replace_number(bytes, random);
    else
      change(bytes, seeds, words, random);
  }
  bytes.insert(bytes.begin(), seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(fixed));
  return bytes;
}

}  // namespace gloam::fuzz
