// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/formatted.h"

#include <clocale>
#include <cstdarg>
#include <cstdio>

namespace gloam {
namespace {

#if defined(_WIN32)

int print_in_c_locale(char* target, std::size_t size, const char* format, std::va_list arguments) {
  static const _locale_t c_locale = _create_locale(LC_ALL, "C");
#ifndef _UCRT
  // The old C library writes exponents with three digits unless this is set, for the whole process.
  const unsigned before = _set_output_format(_TWO_DIGIT_EXPONENT);
#endif
  const int length = target == nullptr ? _vscprintf_l(format, c_locale, arguments)
                                       : _vsnprintf_l(target, size, format, c_locale, arguments);
#ifndef _UCRT
  _set_output_format(before);
#endif
  return length;
}

#else

/// Sets the thread's locale, and sets it back at the end of a scope.
class CLocale {
 public:
  CLocale() : before_(uselocale(shared())) {}
  ~CLocale() { uselocale(before_); }
  CLocale(const CLocale&) = delete;
  CLocale& operator=(const CLocale&) = delete;

 private:
  static locale_t shared() {
    static const locale_t made = newlocale(LC_ALL_MASK, "C", locale_t{});
    return made;
  }
  locale_t before_;
};

int print_in_c_locale(char* target, std::size_t size, const char* format, std::va_list arguments) {
  const CLocale c_locale;
  return std::vsnprintf(target, size, format, arguments);
}

#endif

}  // namespace

std::string formatted(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  const int length = print_in_c_locale(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  if (!text.empty()) print_in_c_locale(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

}  // namespace gloam
