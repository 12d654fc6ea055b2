// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/site_costs.h"

namespace gloam {

SiteCosts::Site SiteCosts::site(const std::type_info& type, std::size_t salt) {
  // Uses the address, because hash_code() hashes the type's name character by character.
  auto mixed = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(&type)) + salt * 0x9e3779b97f4a7c15ull;
  mixed = (mixed ^ (mixed >> 31)) * 0xbf58476d1ce4e5b9ull;
  return static_cast<Site>(mixed ^ (mixed >> 29));
}

float SiteCosts::recall(Site site) const {
  const Entry& entry = entries_[site % entries_.size()];
  if (entry.site.load(std::memory_order_relaxed) != site) return kUnknownCost;
  return entry.ns.load(std::memory_order_relaxed);
}

void SiteCosts::learn(Site site, float ns) {
  Entry& entry = entries_[site % entries_.size()];
  const bool known = entry.site.load(std::memory_order_relaxed) == site;
  const float old = entry.ns.load(std::memory_order_relaxed);
  entry.ns.store(known && old != kUnknownCost ? (old + ns) * 0.5f : ns, std::memory_order_relaxed);
  if (!known) entry.site.store(site, std::memory_order_relaxed);
}

}  // namespace gloam
