# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Compiles wrong uses of knob_table.h, which the compiler must refuse for the right reason. usage: ROOT"""
import os
import re
import subprocess
import sys

HEAD = """
#include "engine/render/knobs/knob_table.h"
namespace gloam {
enum class Filter { none, box, tent };
constexpr std::string_view name_of(Filter filter) {
  switch (filter) {
    case Filter::none: return "none";
    case Filter::box: return "box";
    case Filter::tent: return "tent";
  }
  return {};
}
enum class Other { none, box };
inline constexpr EnumKnob<Filter> kFilter{.name = "lamp.filter", .meaning = "filter"};
inline constexpr NumberKnob kShare{.name = "lamp.share", .meaning = "share", .max = 1.0};
"""
ENUM = """
enum class Size {{ small, middle, large }};
constexpr std::string_view name_of(Size size) {{
  switch (size) {{ {} }}
  return {{}};
}}
inline constexpr EnumKnob<Size> kSize{{.name = "lamp.size", .meaning = "size"}};
"""
SMALL, MIDDLE, LARGE = (f'case Size::{name}: return "{name}";' for name in ("small", "middle", "large"))

# The code, and words of which the compiler's message has one; None: it compiles.
CASES = {
    "reads of the reference's type": ("Filter f(const KnobRegistry& k) { return k.value(kFilter); }", None),
    "names in any order, each value once": (ENUM.format(LARGE + SMALL + MIDDLE), None),
    "an enum's last value has no name": (ENUM.format(SMALL + MIDDLE), "large"),
    "an enum's middle value has no name": (ENUM.format(SMALL + LARGE), "must be 0, 1, 2"),
    "an enum's first value has no name": (ENUM.format(MIDDLE + LARGE), "must be 0, 1, 2"),
    "two values have one name": (ENUM.format(SMALL + MIDDLE + 'case Size::large: return "small";'), "different names"),
    "an enum without names": ("inline constexpr EnumKnob<Other> kOther{.name = \"a\"};", "constraint"),
    "a default of another enum": ("inline constexpr EnumKnob<Filter> k{.name = \"a\", .default_value = Other::box};", "Other"),
    "a value as another enum": ("Other f(const KnobRegistry& k) { return k.value(kFilter); }", "Other"),
    "a value as an index": ("int f(const KnobRegistry& k) { return k.value(kFilter); }", "int"),
    "a comparison with a text": ("bool f(const KnobRegistry& k) { return k.value(kFilter) == \"box\"; }", "operand"),
    "a read by name": ("double f(const KnobRegistry& k) { return k.number(\"lamp.share\"); }", "Knob"),
    "a text by name": ("std::string f(const KnobRegistry& k) { return k.text(\"lamp.share\"); }", "Knob"),
    "a set of another type": ("void f(KnobRegistry& k) { k.set(kFilter, Other::box); }", "set"),
    "an override of another type": ("KnobOverride f() { return override_of(kFilter, 1); }", "Filter|override_of"),
}


def main():
    compiler = [os.environ.get("CXX", "c++"), "-std=c++20", "-Wall", "-Wextra", "-Werror", f"-I{sys.argv[1]}",
                "-fsyntax-only", "-x", "c++", "-"]
    faults = []
    for name, (code, expected) in CASES.items():
        result = subprocess.run(compiler, input=HEAD + code + "\n}\n", text=True, capture_output=True, check=False)
        if expected is None and result.returncode != 0:
            faults.append(f"{name}: must compile:\n{result.stderr}")
        elif expected is not None and result.returncode == 0:
            faults.append(f"{name}: must not compile")
        elif expected is not None and not re.search(f"error: .*({expected})", result.stderr):
            faults.append(f"{name}: refused without {expected}:\n{result.stderr}")
    print("\n".join(faults) or f"{len(CASES)} cases")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
