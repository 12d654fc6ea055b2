// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/start/interrupts.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stop_token>

#include "engine/core/storage/sealed_file.h"

namespace gloam {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(20);
constexpr std::chrono::milliseconds kPatienceAtSignal(120);

// A signal handler can reach only objects of static storage.
std::atomic<int> signal_number = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void note_signal(int number) { signal_number.store(number); }

void watch(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  const auto pause = [&](std::chrono::milliseconds time) {
    return wake.wait_for(lock, stop, time, [] { return false; });
  };
  while (!stop.stop_requested()) {
    static_cast<void>(pause(kBetweenLooks));
    if (signal_number.load() == 0) continue;
    static_cast<void>(pause(kPatienceAtSignal));
    if (stop.stop_requested()) return;
    remove_unfinished_files();
    std::_Exit(kSignalExit + signal_number.load());
  }
}

}  // namespace

void end_process(int code) {
  std::fflush(nullptr);
  remove_unfinished_files();
  std::_Exit(code);
}

Interrupts::Interrupts() {
  signal_number.store(0);
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
  watch_ = std::jthread(watch);
}

Interrupts::~Interrupts() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int Interrupts::arrived() const { return signal_number.load(); }

}  // namespace gloam
