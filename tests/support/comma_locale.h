// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <string>

#include "tests/support/environment.h"

namespace gloam::test {

/// Sets the global locales of C and C++ to ones with decimal commas and grouped digits, and sets them back in the end.
/// The C locale is an installed one, or is made with localedef.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Commas))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "German_Germany.1252"})
      if (!set_) set_ = std::setlocale(LC_ALL, name) != nullptr;
    if (!set_) make_locale();
  }
  ~CommaLocale() {
    std::setlocale(LC_ALL, "C");
    set_environment("LOCPATH", nullptr);
    std::locale::global(before_);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Whether the C locale is set. The C++ locale is in any case.
  [[nodiscard]] bool is_set() const { return set_; }

 private:
  void make_locale() {
#ifndef _WIN32
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gloam_test_locales";
    std::filesystem::create_directories(folder);
    const std::string made = (folder / "de_DE.UTF-8").string();
    if (!std::filesystem::exists(made) &&
        std::system(("localedef -i de_DE -f UTF-8 '" + made + "' >/dev/null 2>&1").c_str()) != 0)
      return;
    set_environment("LOCPATH", folder.c_str());
    set_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
#endif
  }
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
  bool set_ = false;
};

}  // namespace gloam::test
