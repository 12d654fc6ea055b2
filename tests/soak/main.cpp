// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Draws frames while a random schedule changes everything that a host may change, and measures live bytes after the
// tour and at the end of each cycle, in the base state. They must not grow after the tour. Writes them to
// FOLDER/memory.csv and the pictures of the checkpoints to FOLDER/state_N.ppm. With --state it brings itself to state N
// without the steps before it, and writes that picture: both must be equal.
// usage: gloam_soak FOLDER [--frames N] [--seed N] [--checkpoints N] [--state N] [--brief] [--validate]
// frames: of all cycles. The tour, and the frames in which states settle, come on top.
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/soak/host.h"
#include "tests/soak/plan.h"

namespace gloam::soak {
namespace {

constexpr int kSkipped = 77;
struct Arguments {
  std::string folder;
  std::uint64_t frames = 20000;
  std::uint32_t seed = 1;
  std::uint64_t checkpoints = 10;
  std::optional<std::uint64_t> state;
  bool brief = false;
  bool validate = false;
};

Arguments parse(int count, char** words) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto number = [&] { return i + 1 < count ? std::strtoull(words[++i], nullptr, 10) : 0; };
    if (word == "--frames") {
      arguments.frames = number();
    } else if (word == "--seed") {
      arguments.seed = static_cast<std::uint32_t>(number());
    } else if (word == "--checkpoints") {
      arguments.checkpoints = number();
    } else if (word == "--state") {
      arguments.state = number();
    } else if (word == "--brief") {
      arguments.brief = true;
    } else if (word == "--validate") {
      arguments.validate = true;
    } else {
      arguments.folder = word;
    }
  }
  return arguments;
}

/// Bytes of physical memory of this process.
std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4096;
}

void write(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Whether live bytes after so many frames have grown by more than a hundredth.
bool has_grown(const char* what, std::int64_t before, std::int64_t now, std::uint64_t frames) {
  if (now <= before + before / 100) return false;
  std::fprintf(stderr, "soak: live bytes of %s grew from %lld to %lld after %llu frames\n", what,
               static_cast<long long>(before), static_cast<long long>(now), static_cast<unsigned long long>(frames));
  return true;
}

class Run {
 public:
  Run(const Arguments& arguments, Host& host)
      : arguments_(arguments), host_(host), csv_(std::fopen((arguments.folder + "/memory.csv").c_str(), "w")) {
    if (csv_ == nullptr) throw std::runtime_error(arguments.folder + " is no folder that can be written");
    std::fprintf(csv_, "frames,heap,libraries,driver_heap,device,malloc,resident\n");
  }
  ~Run() { std::fclose(csv_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  bool run() {
    const Plan plan(arguments_.seed, arguments_.brief);
    for (const Step& step : plan.tour()) {
      host_.show(step.state);
      host_.complete();
      host_.draw(step);
    }
    base_ = measure();
    // Brief soaks have no time for the frames that go on while pipelines are compiled.
    if (!arguments_.brief) host_.set_readiness(Readiness::background);
    const std::uint64_t cycles = std::max<std::uint64_t>(1, arguments_.frames / plan.frames_of_a_cycle());
    for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
      run_cycle(plan.cycle(static_cast<std::uint32_t>(cycle)), cycle, cycles);
      judge(measure());
    }
    if (host_.validation_messages() > 0) {
      std::fprintf(stderr, "soak: %llu validation messages\n",
                   static_cast<unsigned long long>(host_.validation_messages()));
      good_ = false;
    }
    return good_;
  }

 private:
  /// There is one in each of equal shares of all steps, each at another part of its share: a share may be a whole
  /// number of cycles, which all begin and end alike.
  [[nodiscard]] bool is_checkpoint(std::uint64_t step, std::uint64_t all) const {
    if (arguments_.checkpoints == 0) return false;
    constexpr double kGoldenRatio = 0.6180339887498949;
    const std::uint64_t share = step * arguments_.checkpoints / all;
    const double part = kGoldenRatio * static_cast<double>(share + 1);
    const double place = static_cast<double>(share) + part - std::floor(part);
    const double steps = static_cast<double>(all) / static_cast<double>(arguments_.checkpoints);
    return step == static_cast<std::uint64_t>(place * steps);
  }
  void run_cycle(const std::vector<Step>& steps, std::uint64_t cycle, std::uint64_t cycles) {
    std::uint64_t number = cycle * steps.size();
    for (const Step& step : steps) {
      host_.show(step.state);
      host_.draw(step);
      if (is_checkpoint(number, steps.size() * cycles)) check_point(number, step);
      ++number;
    }
  }
  void check_point(std::uint64_t number, const Step& step) {
    host_.settle();
    write(arguments_.folder + "/state_" + std::to_string(number) + ".ppm", host_.pictures());
    std::printf("checkpoint %llu: %s in %s\n", static_cast<unsigned long long>(number), step.change.c_str(),
                step.state.scene.c_str());
    std::fflush(stdout);
  }
  /// Live bytes in the base state, with the scene loaded anew.
  LiveBytes measure() {
    host_.reload();
    const LiveBytes now = host_.live_bytes();
    const struct mallinfo2 used = mallinfo2();
    std::fprintf(csv_, "%llu,%lld,%lld,%lld,%lld,%zu,%lld\n", static_cast<unsigned long long>(host_.frames()),
                 static_cast<long long>(now.heap), static_cast<long long>(now.libraries),
                 static_cast<long long>(now.driver_heap), static_cast<long long>(now.device),
                 used.uordblks + used.hblkhd, static_cast<long long>(resident_bytes()));
    std::fflush(csv_);
    return now;
  }
  void judge(const LiveBytes& now) {
    const std::uint64_t frames = host_.frames();
    const bool heap = has_grown("operator new", base_.heap, now.heap, frames);
    const bool driver = has_grown("VkAllocationCallbacks", base_.driver_heap, now.driver_heap, frames);
    const bool device = has_grown("vkAllocateMemory", base_.device, now.device, frames);
    good_ = good_ && !heap && !driver && !device;
  }

  const Arguments& arguments_;
  Host& host_;
  std::FILE* csv_;
  LiveBytes base_;  ///< after the tour
  bool good_ = true;
};

void draw_state(const Arguments& arguments, Host& host) {
  const Plan plan(arguments.seed, arguments.brief);
  const std::size_t steps = plan.cycle(0).size();
  const Step step = plan.cycle(static_cast<std::uint32_t>(*arguments.state / steps))[*arguments.state % steps];
  host.show(step.state);
  host.settle();
  write(arguments.folder + "/fresh_" + std::to_string(*arguments.state) + ".ppm", host.pictures());
}

int run(const Arguments& arguments) {
  Host host(arguments.validate);
  if (!host.has_device()) return kSkipped;
  if (arguments.state) {
    draw_state(arguments, host);
    return host.validation_messages() == 0 ? 0 : 1;
  }
  return Run(arguments, host).run() ? 0 : 1;
}

}  // namespace
}  // namespace gloam::soak

int main(int count, char** words) {
  try {
    return gloam::soak::run(gloam::soak::parse(count, words));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "soak: %s\n", fault.what());
    return 1;
  }
}
