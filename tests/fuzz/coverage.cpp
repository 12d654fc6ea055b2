// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Entry points of libFuzzer. The environment variable GLOAM_FUZZ_TARGET names the target.
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

namespace {

const gloam::fuzz::Target& chosen() {
  static const gloam::fuzz::Target* const target = [] {
    const char* name = std::getenv("GLOAM_FUZZ_TARGET");
    const auto* found = gloam::fuzz::find_target(name == nullptr ? "" : name);
    if (found == nullptr) {
      std::cerr << "GLOAM_FUZZ_TARGET names no target\n";
      std::exit(2);
    }
    return found;
  }();
  return *target;
}

}  // namespace

extern "C" {

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gloam::fuzz::Outcome outcome = gloam::fuzz::run(chosen(), {data, size});
  if (outcome.fault.empty()) return 0;
  std::cerr << outcome.fault << '\n';
  std::abort();
}

/// Our mutations know words and numbers; libFuzzer's own know what it has seen compared.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0 || size < 2) return LLVMFuzzerMutate(data, size, most);
  static const std::vector<std::string> words = gloam::fuzz::words(chosen());
  const std::size_t fixed = chosen().formats.size() > 1 ? 1 : 0;
  const std::vector<gloam::fuzz::Bytes> only = {{data, data + size}};
  gloam::fuzz::Random random(seed);
  const gloam::fuzz::Bytes mutated = gloam::fuzz::mutate(only, words, fixed, random);
  const std::size_t kept = std::min(mutated.size(), most);
  std::copy_n(mutated.begin(), kept, data);
  return kept;
}

}  // extern "C"
