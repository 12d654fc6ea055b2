# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests the checkers with good and bad samples: a checker that cannot fail is a defect. usage: self_test.py"""
import contextlib
import io
import json
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import formatting
import header_names
import headers_alone
import include_arrows
import licences
import module_graph
import one_definition
import packages
import sizes
import source_text
import sources_alone

sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts"))
import test_report  # noqa: E402


class Tree(unittest.TestCase):
    """A small source tree in a temporary folder."""

    def setUp(self):
        self.root = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.root)

    def write(self, name, text=""):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def assert_faults(self, faults, *parts):
        self.assertEqual(len(faults), len(parts), faults)
        for fault, part in zip(faults, parts):
            self.assertIn(part, fault)


class SourceText(unittest.TestCase):
    def test_comments_go_and_lines_stay(self):
        text = 'a // x\n/* y\n z */ b "// no" \'"\' // "\nc 1\'000 /* d */ 2\'000\n'
        clean = source_text.without_comments(text)
        self.assertEqual(clean.count("\n"), text.count("\n"))
        self.assertEqual(clean.split(), ["a", "b", '"//', 'no"', "'\"'", "c", "1'000", "2'000"])

    def test_raw_strings_keep_what_looks_like_a_comment(self):
        self.assertIn("/* in */", source_text.without_comments('R"x(/* in */ " )x" // out'))
        self.assertNotIn("out", source_text.without_comments('R"x(/* in */ " )x" // out'))

    def test_a_run_over_nothing_is_a_fault(self):
        self.assertEqual(source_text.report("silent", [], 0), 1)
        self.assertEqual(source_text.report("silent", [], 1), 0)


class TestReport(Tree):
    def report(self, status, seconds):
        self.write("build/junit.xml", f'<testsuite><testcase name="some" time="{seconds}" status="{status}"/></testsuite>')
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            code = test_report.main([f"release={self.root / 'build'}"])
        return code, printed.getvalue()

    def test_time_alone_fails_nothing_but_is_marked(self):
        code, printed = self.report("run", 299.0)
        self.assertEqual(code, 0)
        self.assertIn("release: some  (slow)", printed)
        self.assertIn("1 passed, 0 failed, 0 skipped", printed)

    def test_a_failure_fails(self):
        self.assertEqual(self.report("fail", 0.1)[0], 1)


class OneDefinition(Tree):
    def faults_of(self, first, second):
        self.write("engine/a.h", first)
        self.write("sandbox/b.cpp", second)
        faults, checked = one_definition.check(self.root)
        self.assertEqual(checked, 2)
        return faults

    def test_two_types_of_one_name_are_a_fault(self):
        for first, second in (("struct A { int x; };", "class A final : public B<int> { };"),
                              ("enum class A : int { x };", "enum A { y };"),
                              ("template <class T>\nstruct A { T x; };", "union A { int x; };")):
            faults = self.faults_of(f"namespace gloam {{\n{first}\n}}", f"namespace gloam {{\n\n{second}\n}}")
            self.assert_faults(faults, "gloam::A is also defined at engine/a.h:")
            self.assertTrue(faults[0].startswith("sandbox/b.cpp:3:"), faults)

    def test_nested_namespaces_have_one_name_however_they_are_opened(self):
        faults = self.faults_of("namespace gloam::gpu { struct A { }; }", "namespace gloam { namespace gpu { struct A { }; } }")
        self.assert_faults(faults, "gloam::gpu::A")

    def test_types_that_cannot_meet_are_no_fault(self):
        for second in ("namespace gloam { namespace { struct A { }; } }", "namespace gloam::test { struct A { }; }",
                       "namespace gloam { struct B { struct A { }; }; }", "namespace gloam { void f() { struct A { }; } }",
                       "namespace gloam { struct A; class B { A f() { } }; }", "namespace gloam { struct A::B { }; }",
                       "namespace gloam { // struct A { };\n}", "namespace gloam { struct A f() { } }"):
            self.assertEqual(self.faults_of("namespace gloam { struct A { }; }", second), [], second)


class Formatting(Tree):
    def test_what_the_formatter_would_change_is_a_fault(self):
        self.write(".clang-format", "BasedOnStyle: Google\nColumnLimit: 40\n")
        self.write("engine/core/good.h", "int f(int a);\n")
        self.write("engine/core/bad.h", "int g();\nint  f(int a );\n")
        self.write("shaders/core/long.glsl", "// a comment that does not fit into so few columns\n")
        faults, checked = formatting.check(self.root)
        self.assertEqual(checked, 3)
        self.assert_faults(sorted(faults), "engine/core/bad.h:2", "shaders/core/long.glsl:1")


MODULES = {"lights": (), "shadows": ("lights",), "closeups": ("shadows",), "lighting": ("closeups",), "reflections": ("lighting",),
           "grass": ("lighting",), "particles": ("lighting",), "depth_of_field": ("reflections", "grass", "particles"),
           "accuracy": ("depth_of_field",)}


class IncludeArrows(Tree):
    def faults_with(self, name, text, *others):
        for module, below in MODULES.items():
            self.write(f"modules/{module}/CMakeLists.txt", " ".join(f"gloam::{other}" for other in below))
        for other in others:
            self.write(other)
        self.write(name, text)
        return include_arrows.check(self.root)[0]

    def check_include(self, name, include, reason=None):
        faults = self.faults_with(name, f'#include "{include}"\n', include)
        if reason is None:
            self.assertEqual(faults, [], f"{name} may include {include}")
        else:
            self.assert_faults(faults, reason)
        for child in self.root.iterdir():
            shutil.rmtree(child)

    def test_layers_stand_only_on_what_lies_below(self):
        self.check_include("engine/schedule/a.cpp", "engine/core/b.h")
        self.check_include("engine/render/a.cpp", "engine/gpu/b.h")
        self.check_include("engine/ecs/a.cpp", "engine/math/b.h", "does not stand on engine/math")
        self.check_include("engine/core/a.cpp", "engine/jobs/b.h", "does not stand on engine/jobs")
        self.check_include("engine/scene/a.cpp", "engine/gpu/b.h", "does not stand on engine/gpu")
        self.check_include("engine/render/a.cpp", "modules/lights/module.h", "knows no module")
        self.check_include("engine/render/a.cpp", "sandbox/b.h", "nothing stands on the sandbox")
        self.check_include("engine/core/a.cpp", "tests/support/b.h", "only tests")

    def test_modules_see_three_files_of_modules_below(self):
        for leaf in ("components.h", "module.h", "outputs.h"):
            self.check_include("modules/grass/a.cpp", f"modules/lights/{leaf}")
        self.check_include("modules/grass/a.cpp", "modules/grass/wind.h")
        self.check_include("modules/depth_of_field/a.cpp", "modules/grass/outputs.h")
        self.check_include("modules/accuracy/a.cpp", "modules/particles/module.h")
        self.check_include("modules/shadows/a.cpp", "modules/lights/bins/z_bins.h", "of another module only")
        self.check_include("modules/lights/a.cpp", "modules/shadows/module.h", "does not stand on modules/shadows")
        self.check_include("modules/grass/a.cpp", "modules/particles/module.h", "does not stand on modules/particles")
        self.check_include("modules/particles/a.cpp", "modules/shadows/reference.h")
        self.check_include("modules/particles/a.cpp", "modules/lights/reference.h", "of another module only")
        self.check_include("modules/grass/a.cpp", "modules/module_list/module_list.h", "does not stand on")
        self.check_include("modules/module_list/a.cpp", "modules/accuracy/module.h")
        self.check_include("modules/module_list/a.cpp", "modules/lights/bins/z_bins.h", "of another module only")
        self.check_include("modules/lights/module.h", "modules/lights/lists/buffers.h", "public headers only")
        self.check_include("modules/unheard_of/a.cpp", "engine/core/b.h", "not in the architecture")

    def test_cpu_rooms_stand_on_layers_without_a_gpu(self):
        self.check_include("modules/lights/masks/a.cpp", "engine/math/b.h")
        self.check_include("modules/lights/masks/a.cpp", "modules/lights/components.h")
        self.check_include("modules/lights/masks/a.cpp", "shaders/lights/lights_shared.h")
        self.check_include("modules/closeups/umbra/a.cpp", "modules/lights/components.h")
        self.check_include("modules/lights/debug/a.cpp", "engine/render/view.h")
        self.check_include("modules/lights/masks/a.cpp", "engine/render/view.h", "CPU rooms only")
        self.check_include("modules/lights/masks/a.cpp", "engine/scene/assets.h", "CPU rooms only")
        self.check_include("modules/lights/masks/a.cpp", "modules/lights/outputs.h", "CPU rooms only")
        self.check_include("modules/lights/components.h", "engine/gpu/types.h", "CPU rooms only")
        self.check_include("modules/lights/masks/a.cpp", "shaders/lights/shaders.h", "CPU rooms only")
        self.check_include("modules/closeups/umbra/a.cpp", "modules/shadows/components.h", "CPU rooms only")

    def test_installed_headers_include_installed_headers_only(self):
        self.check_include("modules/lights/masks/a.h", "modules/lights/bins/z_bins.h")
        self.check_include("modules/lights/masks/a.h", "modules/lights/cpu_clones.h", "public headers only")

    def test_the_sandbox_sees_public_headers_and_tests_see_all(self):
        self.check_include("sandbox/a.cpp", "modules/lights/outputs.h")
        self.check_include("sandbox/a.cpp", "modules/module_list/module_list.h")
        self.check_include("sandbox/a.cpp", "modules/lights/bins/z_bins.h", "of another module only")
        self.check_include("tests/lights/a_test.cpp", "modules/lights/bins/z_bins.h")
        self.check_include("sandbox/bench/a.cpp", "modules/lights/bins/z_bins.h")

    def test_cpp_sees_its_own_shared_shader_headers(self):
        self.check_include("modules/lights/a.cpp", "shaders/lights/z_bin_shared.h")
        self.check_include("modules/lights/a.cpp", "shaders/common/prelude.h")
        self.check_include("modules/lights/a.cpp", "shaders/lights/shaders.h")
        self.check_include("modules/shadows/a.cpp", "shaders/lights/z_bin_shared.h", "only its own shaders")
        self.check_include("modules/lights/a.cpp", "shaders/lights/find_api.glsl", "*_shared.h only")

    def test_shaders_see_shaders(self):
        self.check_include("shaders/shadows/a.comp.glsl", "shaders/lights/find_api.glsl")
        self.check_include("shaders/shadows/a.comp.glsl", "shaders/shadows/map.glsl")
        self.check_include("shaders/shadows/a.comp.glsl", "shaders/common/reduce.glsl")
        self.check_include("shaders/shadows/a.comp.glsl", "shaders/render/view_shared.h")
        self.check_include("shaders/common/prelude.h", "shaders/common/vectors.h")
        self.check_include("shaders/common/prelude.h", "engine/math/types.h", "shaders include shaders only")
        self.check_include("engine/math/types.h", "shaders/common/vectors.h")
        self.check_include("shaders/shadows/a.comp.glsl", "shaders/lights/find.glsl", "only *_api.glsl")
        self.check_include("shaders/lights/a.comp.glsl", "shaders/shadows/map_api.glsl", "does not stand on")
        self.check_include("shaders/render/a.comp.glsl", "shaders/lights/find_api.glsl", "does not stand on")
        self.check_include("shaders/common/a.glsl", "shaders/lights/find_api.glsl", "stands on nothing")
        self.check_include("shaders/lights/a.comp.glsl", "engine/core/b.h", "shaders include shaders only")
        self.check_include("shaders/lights_test/a.comp.glsl", "shaders/common/a.glsl", "a shader stands in")
        self.check_include("shaders/elsewhere/a.comp.glsl", "shaders/common/a.glsl", "a shader stands in")

    def test_third_party_headers_stay_in_their_place(self):
        self.assertEqual(self.faults_with("engine/gpu/vulkan/a.cpp", "#include <vulkan/vulkan.h>\n"), [])
        self.assert_faults(self.faults_with("engine/frame/a.cpp", "#include <vulkan/vulkan.h>\n"), "Vulkan's headers stay")

    def test_public_headers_carry_no_heavy_header(self):
        self.assertEqual(self.faults_with("engine/gpu/vulkan_interop.h", "#include <vulkan/vulkan_core.h>\n"), [])
        self.assertEqual(self.faults_with("engine/scene/a.cpp", "#include <nlohmann/json.hpp>\n#include <OpenMesh/x.hh>\n"), [])
        faults = self.faults_with("engine/scene/b.h", "#include <nlohmann/json.hpp>\n#include <OpenMesh/x.hh>\n#include <tiny_gltf.h>\n")
        self.assert_faults(faults, "carry no such", "carry no such", "carry no such")

    def test_the_sandboxs_libraries_stay_there(self):
        self.assertEqual(self.faults_with("sandbox/window/window.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>\n"), [])
        self.assert_faults(self.faults_with("engine/gpu/a.h", "#include <GLFW/glfw3.h>\n"), "sandbox's libraries stay")

    def test_paths_are_full_and_exist(self):
        self.assert_faults(self.faults_with("engine/core/a.cpp", '#include "b.h"\n', "engine/core/b.h"), "full path")
        self.assert_faults(self.faults_with("engine/core/a.cpp", '#include "engine/core/c.h"\n'), "no such file")

    def test_the_embedding_host_names_its_own_headers(self):
        self.assertEqual(self.faults_with("tests/embedding/host/a.cpp", '#include "b.h"\n', "tests/embedding/host/b.h"), [])

    def test_the_own_header_comes_first(self):
        good = '// words\n#include "engine/core/a.h"\n#include <vector>\n'
        self.assertEqual(self.faults_with("engine/core/a.cpp", good, "engine/core/a.h"), [])
        bad = '#include <vector>\n#include "engine/core/a.h"\n'
        self.assert_faults(self.faults_with("engine/core/a.cpp", bad), "own header comes first")
        self.assert_faults(self.faults_with("engine/core/a.cpp", "int x;\n"), "own header comes first")

    def test_includes_in_comments_do_not_count(self):
        self.assertEqual(self.faults_with("engine/core/a.cpp", '// #include "modules/x.h"\n/*\n#include "b.h"\n*/\n'), [])

    def test_the_graph_of_layers_has_no_cycle(self):
        for name, below in include_arrows.LAYER_REACH.items():
            self.assertNotIn(name, below)


class ModuleGraph(Tree):
    def setUp(self):
        super().setUp()
        for name, links in {"lights": "gloam::render gloam::shaders_lights", "fog": "gloam::lights_cpu gloam::lights",
                            "lens": "gloam::fog gloam::lights"}.items():
            self.write(f"modules/{name}/CMakeLists.txt", f"gloam_add_layer({name} PUBLIC {links})\n")
            self.write(f"modules/{name}/module.h", f"std::unique_ptr<Module> make_{name}_module();\n")
            self.write(f"tests/modules/{name}/CMakeLists.txt")
        self.write_list("lights", "fog", "lens")
        self.write("docs/architecture.md", "modules/   lights → fog → lens\n")

    def write_list(self, *names):
        self.write("modules/module_list/module_list.cpp", "".join(f"make_{name}_module();\n" for name in names))

    def faults(self):
        return module_graph.check(self.root)[0]

    def test_a_module_stands_on_what_it_links(self):
        self.assertEqual(module_graph.read(self.root), {"fog": ("lights",), "lens": ("fog", "lights"), "lights": ()})
        self.assertEqual(self.faults(), [])

    def test_a_cycle_is_a_fault(self):
        self.write("modules/lights/CMakeLists.txt", "gloam::lens")
        self.assertIn("modules/lights stands on itself", self.faults())

    def test_the_list_is_in_the_order_of_the_graph_and_lacks_none(self):
        self.write_list("fog", "lights", "lens")
        self.assert_faults(self.faults(), "lights comes after fog")
        self.write_list("lights", "lens")
        self.assert_faults(self.faults(), "make_all_modules lacks fog")

    def test_a_module_has_tests(self):
        shutil.rmtree(self.root / "tests/modules/fog")
        self.assert_faults(self.faults(), "modules/fog has no tests")

    def test_the_page_shows_the_graph_and_can_be_written(self):
        self.write("modules/mist/CMakeLists.txt", "gloam::lights")
        self.write("tests/modules/mist/CMakeLists.txt")
        self.assert_faults(self.faults(), "another graph than lights → {fog, mist} → lens")
        self.assertEqual(module_graph.check(self.root, write=True)[0], [])
        self.assertEqual(self.faults(), [])


def statements(count):
    return "  f();\n" * count


class Sizes(unittest.TestCase):
    def faults(self, text, name="engine/core/a.cpp"):
        return sizes.check_text(name, text)

    def check_body(self, head, tail="}\n", limit=80, lines=None):
        """Checks that a body at the limit passes and one line more fails. `head` and `tail` count as two lines of the body."""
        inner = limit - 2 - head.count("\n") if lines is None else lines
        self.assertEqual(self.faults(head + "\n" + statements(inner) + tail), [], head)
        faults = self.faults(head + "\n" + statements(inner + 1) + tail)
        self.assertEqual(len(faults), 1, f"{head}: {faults}")
        self.assertIn(f"{limit + 1} lines", faults[0])

    def test_functions_of_all_kinds_stop_at_80_lines(self):
        for head in ("void f() {", "auto f(int a, std::vector<int> b = {}) -> std::map<int, int> {", "void C::f() const noexcept {",
                     "C::C(int a) : a_(a), b_{a}, c_{1, 2} {", "C::C() noexcept : base<int>() {", "template <class T>\nvoid f(T) requires(x) {",
                     "bool operator()(int) const {", "bool operator<(const A& b) {", "extern const int x; static void g() {",
                     "GLOAM_EXPORT struct A f() {", "void f(struct B* b) {", "void f()\n{", "T f() try {"):
            self.check_body(head)

    def test_functions_within_namespaces_and_classes_count(self):
        self.check_body("namespace a::b { void f() {", "}}\n")
        self.check_body("namespace { class A : public B { enum class E { x }; void f() override {", "}};}\n")
        self.check_body('extern "C" { void f() {', "}}\n")
        self.check_body("template <class T> struct A<T*> final : B<T> { int x = 0; std::vector<int> y{1}; void f() {", "};};\n")

    def test_inner_blocks_and_lambdas_belong_to_their_function(self):
        self.check_body("void f() { if (a) { g([&](int x) {", "}); } else { h(); } }\n")
        self.check_body("void f() { switch (a) { case 1: { struct A { void g() {", "} }; } } }\n")
        self.check_body("const auto f = [](int) {", "};\n")

    def test_blank_lines_and_comments_do_not_count(self):
        text = "void f() {\n" + "\n  // words\n  /* more\n words */\n" * 90 + statements(78) + "}\n"
        self.assertEqual(self.faults(text), [])

    def test_test_bodies_stop_at_150(self):
        for head in ("TEST(A, b) {", "TEST_F(A, b) {", "TEST_P(A, b) {", "RC_GTEST_PROP(A, b, (int x)) {"):
            self.check_body(head, limit=150)

    def test_tables_stop_at_150(self):
        for head in ("const int table[] = {", "std::vector<A> t{", "constexpr std::array<A, sizeof(B)> t = {{"):
            rows = "  {1, \"f(\"},\n"
            close = "}};\n" if head.endswith("{{") else "};\n"
            self.assertEqual(self.faults(head + "\n" + rows * 148 + close), [])
            self.assertEqual(len(self.faults(head + "\n" + rows * 149 + close)), 1, head)

    def test_a_table_in_a_function_has_the_tables_limit(self):
        rows = "    {1, 2},\n"
        text = "void f() {\n  const A t[] = {\n" + rows * 100 + "  };\n" + statements(40) + "}\n"
        self.assertEqual(self.faults(text), [])
        self.assertEqual(len(self.faults(text.replace(rows, rows * 2, 10))), 1)
        self.assertEqual(len(self.faults(text.replace("  f();\n", "  f();\n" * 2))), 1)

    def test_braces_in_strings_and_preprocessor_lines_are_not_code(self):
        text = 'void f() {\n  g("}{{", \'{\');\n#define X {\\\n  {\n#if A\n  if (a) {\n#else\n  if (b) {\n#endif\n  }\n}\n'
        self.assertEqual([b[0] for b in sizes.blocks(text)], ["function"])
        self.check_body('void g() { h("}"); }\n#define X { \\\n {\nvoid f() {', lines=78)

    def test_kernels_are_functions(self):
        self.check_body("layout(binding = 0) buffer B { uint a[]; } b;\nvoid main() {", lines=78)
        self.check_body("float f(const in float a[4]) {")

    def test_files_stop_at_500(self):
        self.assertEqual(self.faults("int x;\n" * 500 + "\n// c\n"), [])
        self.assertEqual(len(self.faults("int x;\n" * 501)), 1)


class Licences(Tree):
    def test_sources_begin_with_the_two_lines(self):
        two = "// SPDX-FileCopyrightText: The gloam authors\n// SPDX-License-Identifier: MIT\n"
        self.assertIsNone(licences.fault_of(two + "#pragma once\n", "//"))
        self.assertIsNone(licences.fault_of("#!/bin/sh\n" + two.replace("//", "#"), "#"))
        self.assertIsNotNone(licences.fault_of(two, "#"))
        self.assertIsNotNone(licences.fault_of("\n" + two, "//"))
        self.assertIsNotNone(licences.fault_of("", "//"))

    def test_every_kind_of_source_is_looked_at(self):
        names = ("CMakeLists.txt", "cmake/a.cmake", "engine/CMakeLists.txt", "engine/core/a.cpp", "engine/core/a.h",
                 "scripts/a.sh", "shaders/common/a.glsl", "tests/a.py")
        for name in names:
            self.write(name, "text\n")
        faults, checked = licences.check(self.root)
        self.assertEqual((len(faults), checked), (len(names), len(names)))


class Packages(unittest.TestCase):
    def test_one_name_a_line_and_nothing_else(self):
        self.assertEqual(packages.faults_of("p", "g++\nlibfoo1.2-dev\n"), [])
        for bad in ("g++\n\nlib\n", "# words\nlib\n", "lib \n", "two names\n", "lib", "lib\nlib\n", "Lib\n", "lib=1.0\n", ""):
            self.assertNotEqual(packages.faults_of("p", bad), [], bad)


class HeaderNames(Tree):
    def check(self):
        return header_names.check(self.root)[0]

    def test_a_name_without_an_include_that_declares_it_fails(self):
        self.write("engine/core/low.h", "#pragma once\nstruct Low {};\nenum class Side { kLeft };\ninline constexpr int kMost = 1;\n")
        self.write("engine/core/middle.h", '#pragma once\n#include "engine/core/low.h"\n')
        self.write("engine/core/high.h", '#pragma once\n#include "engine/core/middle.h"\nLow low; Side side; int n = kMost;\n')
        self.assertEqual(self.check(), [])
        for text, word in (("Low low;", "Low"), ("Side side;", "Side"), ("int n = kMost;", "kMost"), ("core::Low low;", "Low")):
            self.write("engine/core/high.h", f"#pragma once\n{text}\n")
            self.assert_faults(self.check(), f"high.h: uses {word} ")
        self.write("engine/core/high.h", "#pragma once\nstruct Low; Low* low; // Side\n")
        self.assertEqual(self.check(), [])

    def test_members_and_template_parameters_are_no_uses(self):
        self.write("engine/core/low.h", "#pragma once\nstruct Value {};\ninline constexpr bool kFlag = true;\nstruct T {};\n")
        self.write("engine/core/high.h", "#pragma once\ntemplate <typename T>\ntypename T::Value f(T t) { return Box<T>::kFlag ? t.Value : 1; }\n")
        self.assertEqual(self.check(), [])

    def test_names_of_libraries(self):
        for text, include in (("glm::vec3 v;", "glm/vec3.hpp"), ("VkDevice d;", "vulkan/vulkan.h"), ("std::vector<int> v;", "vector")):
            self.write("engine/core/a.h", f"#pragma once\n{text}\n")
            self.assert_faults(self.check(), "a.h: uses ")
            self.write("engine/core/a.h", f"#pragma once\n#include <{include}>\n{text}\n")
            self.assertEqual(self.check(), [])


@unittest.skipUnless(os.name == "posix", "drives a compiler as the build here does")
class HeadersAlone(Tree):
    def check(self):
        compiler = os.environ.get("CXX", "c++")
        source = self.root / "engine/core/a.cpp"
        entry = {"directory": str(self.root / "build"), "file": str(source),
                 "command": f"ccache {compiler} -std=c++20 -I{self.root} -o a.o -c {source}"}
        self.write("build/compile_commands.json", json.dumps([entry]))
        return headers_alone.check(self.root, self.root / "build")[0]

    def test_headers_that_lean_on_others_fail(self):
        self.write("engine/core/a.cpp", '#include "engine/core/good.h"\n')
        self.write("engine/core/good.h", "#pragma once\n#include <vector>\ninline std::vector<int> v;\n")
        self.assertEqual(self.check(), [])
        self.write("engine/core/no_type.h", "#pragma once\ninline Unknown x;\n")
        self.write("engine/core/no_guard.h", "struct A {};\n")
        self.write("engine/core/no_std.h", "#pragma once\ninline std::string s;\n")
        self.assert_faults(self.check(), "no_guard.h: does not", "no_std.h: does not", "no_type.h: does not")
        self.assert_faults(self.check(), "no_guard.h", "no_std.h", "no_type.h")  # failures are not remembered

    def test_precompiling_hides_no_absent_include(self):
        self.write("engine/core/a.cpp", "")
        for i in range(8):  # enough to be precompiled
            self.write(f"engine/core/uses{i}.h", "#pragma once\n#include <map>\ninline std::map<int, int> m;\n")
        self.write("engine/core/no_std.h", "#pragma once\ninline std::map<int, int> n;\n")
        self.assert_faults(self.check(), "no_std.h: does not")
        self.assertTrue((self.root / "build/hygiene/system.h.gch").is_file())

    def test_a_change_of_an_include_is_seen(self):
        self.write("engine/core/a.cpp", "")
        self.write("engine/core/low.h", "#pragma once\nstruct Low {};\n")
        self.write("engine/core/high.h", '#pragma once\n#include "engine/core/low.h"\ninline Low low;\n')
        self.assertEqual(self.check(), [])
        self.write("engine/core/low.h", "#pragma once\n")
        self.assert_faults(self.check(), "high.h")

    def test_what_a_built_source_includes_first_is_proven(self):
        self.write("engine/core/a.cpp", '#include "engine/core/a.h"\n')
        self.write("engine/core/a.h", "Unknown x;\n")
        self.assert_faults(self.check(), "a.h")
        self.write("build/a.o")
        self.assertEqual(self.check(), [])
        later = (self.root / "build/a.o").stat().st_mtime + 10
        os.utime(self.root / "engine/core/a.h", (later, later))
        self.write("engine/core/a.h", "Unknown y;\n")
        os.utime(self.root / "engine/core/a.h", (later, later))
        self.assert_faults(self.check(), "a.h")

    def test_only_the_first_source_of_a_group_proves_its_header(self):
        compiler = os.environ.get("CXX", "c++")
        group = self.root / "build/CMakeFiles/a.dir/Unity/unity_a_0_cxx.cxx"
        for name in "ab":
            self.write(f"engine/core/{name}.cpp", f'#include "engine/core/{name}.h"\n')
            self.write(f"engine/core/{name}.h", "Unknown x;\n")
        self.write(group.relative_to(self.root), f'#include "{self.root}/engine/core/a.cpp"\n#include "{self.root}/engine/core/b.cpp"\n')
        entry = {"directory": str(self.root / "build"), "file": str(group),
                 "command": f"{compiler} -std=c++20 -I{self.root} -o a.o -c {group}"}
        self.write("build/compile_commands.json", json.dumps([entry]))
        self.write("build/a.o")
        self.assert_faults(headers_alone.check(self.root, self.root / "build")[0], "b.h")


@unittest.skipUnless(os.name == "posix", "drives a compiler as the build here does")
class SourcesAlone(Tree):
    def check(self):
        compiler = os.environ.get("CXX", "c++")
        group = self.root / "build/CMakeFiles/a.dir/Unity/unity_a_0_cxx.cxx"
        self.write(group.relative_to(self.root), f'#include "{self.root}/engine/a.cpp"\n#include "{self.root}/engine/b.cpp"\n')
        entry = {"directory": str(self.root / "build"), "file": str(group),
                 "command": f"{compiler} -DFLAG=1 -std=c++20 -I{self.root} -o a.o -c {group}"}
        self.write("build/compile_commands.json", json.dumps([entry]))
        return sources_alone.check(self.root, self.root / "build")

    def test_a_source_that_leans_on_another_of_its_group_fails(self):
        self.write("engine/a.cpp", "#include <vector>\nstatic_assert(FLAG == 1);\n")
        self.write("engine/b.cpp", "std::vector<int> v;\n")
        faults, checked = self.check()
        self.assert_faults(faults, "b.cpp: does not")
        self.assertEqual(checked, 2)
        self.assert_faults(self.check()[0], "b.cpp: does not")  # failures are not remembered
        self.write("engine/b.cpp", "#include <vector>\nstd::vector<int> v;\n")
        self.assertEqual(self.check()[0], [])

    def test_a_change_of_an_include_is_seen(self):
        self.write("engine/a.cpp", '#include "engine/a.h"\nLow low;\n')
        self.write("engine/b.cpp")
        self.write("engine/a.h", "#pragma once\nstruct Low {};\n")
        self.assertEqual(self.check()[0], [])
        self.write("engine/a.h", "#pragma once\n")
        self.assert_faults(self.check()[0], "a.cpp: does not")


if __name__ == "__main__":
    unittest.main()
