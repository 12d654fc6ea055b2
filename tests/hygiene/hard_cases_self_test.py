# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests hard_cases.py with good and bad samples. usage: hard_cases_self_test.py"""
import unittest

import hard_cases
from self_test import Tree

CASES = "lamps.none | page.md §1 | no lamp\nlamps.many | page.md §1 | many lamps\n"
LAMP_TESTS = """// Hard case: lamps.none
TEST(Lamps, of_none_is_dark) { f(); }

TEST_F(Lamps, of_many_are_bright) {
  // Hard case: lamps.many
  f();
}
"""


class HardCases(Tree):
    def setUp(self):
        super().setUp()
        self.write("tests/hygiene/hard_cases.txt", "# The cases.\n\n" + CASES)
        self.write("tests/lamps_test.cpp", LAMP_TESTS)
        self.write("docs/hard-cases.md")
        hard_cases.check(self.root, write=True)

    def faults(self):
        return hard_cases.check(self.root)[0]

    def test_comments_above_and_inside_tests_count(self):
        self.assertEqual(self.faults(), [])
        page = (self.root / "docs/hard-cases.md").read_text(encoding="utf-8")
        self.assertIn("| no lamp | `Lamps.of_none_is_dark` | [lamps_test.cpp](../tests/lamps_test.cpp) |", page)
        self.assertIn("| many lamps | `Lamps.of_many_are_bright` |", page)

    def test_comments_of_python_tests_count(self):
        text = "class Lamps:\n    # Hard case: lamps.none\n    def test_none(self):\n        pass\n\n    def test_many(self):\n"
        self.write("tests/lamps_test.py", text + "        # Hard case: lamps.many, lamps.none\n        pass\n")
        tags = hard_cases.read_tags(self.root)[0]
        self.assertIn(("tests/lamps_test.py", "Lamps.test_none"), tags["lamps.none"])
        self.assertIn(("tests/lamps_test.py", "Lamps.test_many"), tags["lamps.none"])
        self.assertIn(("tests/lamps_test.py", "Lamps.test_many"), tags["lamps.many"])

    def test_a_case_without_a_test_is_a_fault(self):
        self.write("tests/lamps_test.cpp", LAMP_TESTS.replace("lamps.many", "lamps.none"))
        self.assert_faults(self.faults(), "lamps.many has no test: page.md §1: many lamps", "shows something else")

    def test_a_comment_that_names_no_case_or_belongs_to_no_test_is_a_fault(self):
        self.write("tests/lamps_test.cpp", LAMP_TESTS + "// Hard case: lamps.few\nTEST(Lamps, of_few) {\n}\n")
        self.assert_faults(self.faults(), "Lamps.of_few names the hard case 'lamps.few'")
        for after in ("", "int f();\nTEST(Lamps, of_few) {\n}\n"):
            self.write("tests/lamps_test.cpp", LAMP_TESTS + "// Hard case: lamps.none\n" + after)
            self.assert_faults(self.faults(), "tests/lamps_test.cpp:8: the hard case belongs to no test")

    def test_a_case_that_is_listed_twice_is_a_fault(self):
        self.write("tests/hygiene/hard_cases.txt", CASES + CASES.splitlines()[0] + "\nno line\n")
        self.assert_faults(self.faults(), "hard_cases.txt:3: lamps.none is listed twice", "hard_cases.txt:4: not of the form")

    def test_another_page_is_a_fault_and_can_be_written(self):
        self.write("docs/hard-cases.md", "something")
        self.assert_faults(self.faults(), "docs/hard-cases.md shows something else")
        self.assertEqual(hard_cases.check(self.root, write=True)[0], [])
        self.assertEqual(self.faults(), [])


if __name__ == "__main__":
    unittest.main()
