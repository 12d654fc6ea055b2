// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A host that uses the job system alone: numbers the primes below a million on gloam's pool.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>

#include "engine/jobs/executor.h"

namespace {

bool is_prime(std::uint32_t n) {
  if (n < 2) return false;
  for (std::uint32_t d = 2; d * d <= n; ++d)
    if (n % d == 0) return false;
  return true;
}

}  // namespace

int main() {
  constexpr std::size_t kCount = 1'000'000;
  constexpr std::uint32_t kPrimes = 78498;  // below a million
  const auto pool = gloam::make_pool_executor(3);
  std::atomic<std::uint32_t> found = 0;
  pool->parallel_for(kCount, 4096, [&](gloam::JobRange range) {
    std::uint32_t here = 0;
    for (std::size_t n = range.begin; n < range.end; ++n) here += is_prime(static_cast<std::uint32_t>(n)) ? 1 : 0;
    found += here;
  });
  if (found == kPrimes) return 0;
  std::fprintf(stderr, "host_jobs: %u primes instead of %u\n", found.load(), kPrimes);
  return 1;
}
