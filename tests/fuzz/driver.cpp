// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Loads mutated scene files for GLOAM_FUZZ_SECONDS seconds (default 10), beginning with seed GLOAM_FUZZ_SEED (default
// 1). Ends with 1 and keeps the input if the loader breaks its promise, takes more than 20 s for one input or more than
// 6 GiB of memory. If it crashes, the input is the file that the first line of output names. With arguments, it loads
// the files that they name instead; "--seeds FOLDER" writes the sound files that are mutated.
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "tests/fuzz/loader_target.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/seeds.h"

namespace {

using gloam::fuzz::Bytes;
using Clock = std::chrono::steady_clock;

constexpr double kLongestInput_s = 20.0;
constexpr long kMostMemory_kib = 6l << 20;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

unsigned long number_from(const char* variable, unsigned long otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

long peak_memory_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

struct Counts {
  std::uint64_t loaded = 0;
  std::uint64_t refused = 0;
};

/// False, with the reason and a copy of the input, if the input is a finding. error: the loader's message.
bool run(const Bytes& bytes, Counts& counts, std::string& error) {
  const Clock::time_point start = Clock::now();
  const gloam::fuzz::LoadOutcome outcome = gloam::fuzz::load_bytes(bytes);
  ++(outcome.loaded ? counts.loaded : counts.refused);
  error = outcome.error;
  std::string fault = outcome.fault;
  if (seconds_since(start) > kLongestInput_s) fault = "took " + std::to_string(seconds_since(start)) + " s";
  if (peak_memory_kib() > kMostMemory_kib) fault = "took " + std::to_string(peak_memory_kib()) + " KiB of memory";
  if (fault.empty()) return true;
  const std::string kept = std::filesystem::temp_directory_path().string() + "/gloam_fuzz_finding.gltf";
  std::filesystem::copy_file(gloam::fuzz::scene_path(), kept, std::filesystem::copy_options::overwrite_existing);
  std::cerr << "finding: " << fault << "; input: " << kept << '\n';
  return false;
}

/// Loads every file and tells each refusal. Returns the number of refusals; −1 at a finding.
int load_all(const std::vector<Bytes>& files) {
  Counts counts;
  for (const Bytes& file : files) {
    std::string error;
    if (!run(file, counts, error)) return -1;
    if (!error.empty()) std::cerr << "refused: " << error << '\n';
  }
  return static_cast<int>(counts.refused);
}

std::vector<Bytes> read_files(int count, char** names) {
  std::vector<Bytes> files;
  for (int i = 0; i < count; ++i) {
    std::ifstream file(names[i], std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return files;
}

int write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::vector<Bytes> seeds = gloam::fuzz::seeds();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    std::ofstream(folder / ("seed" + std::to_string(i)), std::ios::binary)
        .write(reinterpret_cast<const char*>(seeds[i].data()), static_cast<std::streamsize>(seeds[i].size()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--seeds") return write_seeds(argv[2]);
  std::cout << "each input is written to " << gloam::fuzz::scene_path() << std::endl;
  if (argc > 1) return load_all(read_files(argc - 1, argv + 1)) < 0 ? 1 : 0;
  const unsigned long seconds = number_from("GLOAM_FUZZ_SECONDS", 10);
  const unsigned long seed = number_from("GLOAM_FUZZ_SEED", 1);
  const std::vector<Bytes> seeds = gloam::fuzz::seeds();
  if (load_all(seeds) != 0) return 1;
  Counts counts;
  std::string error;
  gloam::fuzz::Random random(seed);
  const Clock::time_point start = Clock::now();
  while (seconds_since(start) < static_cast<double>(seconds))
    if (!run(gloam::fuzz::mutate(seeds, random), counts, error)) return 1;
  std::cout << seconds << " s, seed " << seed << ": " << counts.loaded << " inputs loaded, " << counts.refused
            << " refused, peak memory " << peak_memory_kib() / 1024 << " MiB\n";
  return 0;
}
