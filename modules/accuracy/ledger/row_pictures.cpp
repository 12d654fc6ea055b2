// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/module.h"

namespace gloam {
namespace {

bool differs(const LedgerRow& row) {
  return row.flip && row.flip->mean > 0.0 && !row.picture.empty() && !row.reference_picture.empty();
}

}  // namespace

std::string LedgerRow::heat_map() const {
  return differs(*this) ? "flip-" + picture + "-" + reference_picture : std::string();
}

std::string LedgerRow::worst_areas() const {
  return differs(*this) && !worst.empty() ? "worst-" + picture + "-" + reference_picture : std::string();
}

std::vector<std::string> row_pictures(const LedgerRow& row) {
  std::vector<std::string> names;
  for (std::string name : {row.picture, row.reference_picture, row.heat_map(), row.worst_areas()})
    if (!name.empty()) names.push_back(std::move(name));
  return names;
}

}  // namespace gloam
