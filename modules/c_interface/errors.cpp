// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "modules/c_interface/handles.h"

namespace gloam::c_interface {
namespace {

std::string& message() {
  thread_local std::string kept;
  return kept;
}

}  // namespace

void keep_message(std::string sentence) { message() = std::move(sentence); }

gloam_result result_of(const Error& error) {
  keep_message(error.message);
  switch (error.kind) {
    case ErrorKind::usage:
      return GLOAM_USAGE;
    case ErrorKind::input:
      return GLOAM_INPUT;
    case ErrorKind::no_device:
      return GLOAM_NO_DEVICE;
    case ErrorKind::failed:
      break;
  }
  return GLOAM_FAILED;
}

Result<Entity> entity_of(const World& world, gloam_entity number) {
  const Entity entity{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
  if (!world.alive(entity)) return usage_error("the world has no entity " + std::to_string(number));
  return entity;
}

Result<dmat4> matrix_of(const double* matrix, const char* name) {
  if (matrix == nullptr) return usage_error(std::string(name) + " is null");
  dmat4 read(1.0);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      const double value = matrix[4 * column + row];
      if (!std::isfinite(value)) return usage_error(std::string(name) + " holds a number that is not finite");
      read[column][row] = value;
    }
  if (read[0][3] != 0.0 || read[1][3] != 0.0 || read[2][3] != 0.0 || read[3][3] != 1.0)
    return usage_error(std::string(name) + ": the last row of a pose is 0, 0, 0, 1");
  return read;
}

}  // namespace gloam::c_interface

extern "C" const char* gloam_error_message(void) { return gloam::c_interface::message().c_str(); }
extern "C" uint32_t gloam_interface_version(void) { return GLOAM_C_INTERFACE; }
extern "C" const char* gloam_version(void) { return GLOAM_VERSION; }
