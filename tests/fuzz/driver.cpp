// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// usage: fuzz TARGET            runs mutated inputs for GLOAM_FUZZ_SECONDS seconds (default 1), beginning with seed
//                               GLOAM_FUZZ_SEED (default 1)
//        fuzz TARGET FILE…      runs these inputs
//        fuzz --list            prints the names of all targets
//        fuzz --seeds TARGET FOLDER  writes the inputs that are mutated
//        fuzz --words TARGET    prints a dictionary for libFuzzer
// Ends with 1 and keeps the input if the code under test breaks a promise, takes more than 20 s for one input or more
// than 6 GiB of memory. After a crash, the input is in the file that the first line of output names.
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"

namespace {

using gloam::fuzz::Bytes;
using gloam::fuzz::Target;
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

/// ext4 waits for the disk when a file is replaced in its place; a file of its own costs nothing.
void write_bytes(const std::filesystem::path& path, const Bytes& bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Runs the inputs of one target.
class Runner {
 public:
  explicit Runner(const Target& target) : target_(target) {
    const auto name = "gloam_fuzz_" + std::string(target.name) + "_" + std::to_string(getpid());
    input_ = std::filesystem::temp_directory_path() / name;
    std::cout << "each input is written to " << input_.string() << std::endl;
  }
  ~Runner() {
    if (!keep_) std::filesystem::remove(input_);
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// False, with the reason, if the input is a finding. error: the message of a refusal.
  bool run(const Bytes& bytes, std::string& error) {
    write_bytes(input_, bytes);
    const Clock::time_point start = Clock::now();
    const gloam::fuzz::Outcome outcome = gloam::fuzz::run(target_, bytes);
    ++(outcome.accepted ? accepted_ : refused_);
    error = outcome.error;
    std::string fault = outcome.fault;
    if (seconds_since(start) > kLongestInput_s) fault = "took " + std::to_string(seconds_since(start)) + " s";
    if (peak_memory_kib() > kMostMemory_kib) fault = "took " + std::to_string(peak_memory_kib()) + " KiB of memory";
    if (fault.empty()) return true;
    keep_ = true;
    std::cerr << "finding: " << fault << "; input: " << input_.string() << '\n';
    return false;
  }
  [[nodiscard]] std::uint64_t accepted() const { return accepted_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  const Target& target_;
  std::filesystem::path input_;
  bool keep_ = false;
  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;
};

/// Runs every input and prints each refusal. Returns the number of refusals; −1 at a finding.
int run_all(Runner& runner, const std::vector<Bytes>& inputs) {
  int refusals = 0;
  for (const Bytes& input : inputs) {
    std::string error;
    const std::uint64_t before = runner.refused();
    if (!runner.run(input, error)) return -1;
    if (runner.refused() == before) continue;
    ++refusals;
    std::cerr << "refused: " << error << '\n';
  }
  return refusals;
}

std::vector<Bytes> read_files(int count, char** names) {
  std::vector<Bytes> files;
  for (int i = 0; i < count; ++i) {
    std::ifstream file(names[i], std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return files;
}

int write_seeds(const Target& target, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::vector<Bytes> seeds = gloam::fuzz::seeds(target);
  for (std::size_t i = 0; i < seeds.size(); ++i) write_bytes(folder / ("seed" + std::to_string(i)), seeds[i]);
  return 0;
}

int print_words(const Target& target) {
  for (const std::string& word : gloam::fuzz::words(target)) {
    std::string line = "\"";
    for (const char c : word) {
      char code[8];
      std::snprintf(code, sizeof(code), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      line += code;
    }
    std::cout << line << "\"\n";
  }
  return 0;
}

int run_mutated(const Target& target) {
  const unsigned long seconds = number_from("GLOAM_FUZZ_SECONDS", 1);
  const unsigned long seed = number_from("GLOAM_FUZZ_SEED", 1);
  const std::vector<Bytes> seeds = gloam::fuzz::seeds(target);
  const std::vector<std::string> words = gloam::fuzz::words(target);
  const std::size_t fixed = target.formats.size() > 1 ? 1 : 0;
  Runner runner(target);
  if (run_all(runner, seeds) != 0) return 1;
  std::string error;
  gloam::fuzz::Random random(seed);
  const Clock::time_point start = Clock::now();
  while (seconds_since(start) < static_cast<double>(seconds))
    if (!runner.run(gloam::fuzz::mutate(seeds, words, fixed, random), error)) return 1;
  std::cout << target.name << ", " << seconds << " s, seed " << seed << ": " << runner.accepted()
            << " inputs accepted, " << runner.refused() << " refused, peak memory " << peak_memory_kib() / 1024
            << " MiB\n";
  return 0;
}

int list_targets() {
  for (const Target& target : gloam::fuzz::targets()) std::cout << target.name << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--list") return list_targets();
  const bool option = first.starts_with("--");
  const int at = option ? 2 : 1;
  const Target* target = argc > at ? gloam::fuzz::find_target(argv[at]) : nullptr;
  if (target == nullptr) {
    std::cerr << "usage: fuzz TARGET [FILE…] | --list | --seeds TARGET FOLDER | --words TARGET\n";
    return 2;
  }
  if (first == "--seeds" && argc == 4) return write_seeds(*target, argv[3]);
  if (first == "--words") return print_words(*target);
  if (argc == 2) return run_mutated(*target);
  Runner runner(*target);
  return run_all(runner, read_files(argc - 2, argv + 2)) < 0 ? 1 : 0;
}
