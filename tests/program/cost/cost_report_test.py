# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tests the text of the page report.html of `cost`; report_page_test.py uses it in a browser. Needs a Vulkan device."""
import json
import re
from html.parser import HTMLParser
from urllib.parse import unquote

from program_case import ProgramCase, main

QUICK = ("cost", "builtin:shadows", "--quick", "--size", "192x108", "--knobs", "shadows.filter,lights.culling",
         "--points", "4")


class Page(HTMLParser):
    """Links, ids, and the elements that are open at the end."""

    def __init__(self, text):
        super().__init__()
        self.links, self.ids, self.sources, self.labels, self.fields, self.open = [], [], [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        if "href" in attributes:
            self.links.append(attributes["href"])
        if "src" in attributes:
            self.sources.append(attributes["src"])
        if tag == "label":
            self.labels.append(attributes["for"])
        if tag in ("input", "select"):
            self.fields.append(attributes["id"])
        if tag not in ("meta", "link", "img", "input", "line", "path", "rect", "circle", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in ("line", "path", "rect", "circle"):
            return
        while self.open and tag in ("option", "optgroup") and self.open[-1] != tag:
            self.open.pop()
        assert self.open and self.open[-1] == tag, f"</{tag}> closes <{self.open[-1:]}>"
        self.open.pop()


class CostReport(ProgramCase):
    def setUp(self):
        super().setUp()
        self.require_device()

    def measure(self, *more):
        self.expect(0, *QUICK, "--out", "ledger", *more)
        return (self.folder / "ledger/report.html").read_text(encoding="utf-8")

    def test_is_one_file_whose_links_exist(self):
        text = self.measure()
        self.assertLess(len(text.encode()), 3_000_000)
        self.assertNotRegex(text, r"https?:")
        page = Page(text)
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.ids), len(set(page.ids)), "ids are unique")
        self.assertEqual(sorted(page.labels), sorted(page.fields), "every field has a label")
        self.assertEqual(page.sources, [], "pictures are in the page")
        files = [link for link in page.links if not link.startswith(("#", "data:"))]
        self.assertTrue(any(link.startswith("pictures/") for link in files))
        for link in files:
            self.assertTrue((self.folder / "ledger" / link).is_file(), link)
        for link in page.links:
            if link.startswith("#"):
                self.assertIn(link[1:], page.ids)
        ledger = self.read_json("ledger/ledger.json")
        for row in ledger["rows"]:
            for name in (row["picture"], row["reference_picture"]):
                self.assertTrue((self.folder / f"ledger/pictures/{name}.png").is_file(), row)
                self.assertIn(f'\n"{name}":"data:image/jpeg;base64,', text)
            if row["error"]["flip"]["mean"] > 0.0:
                self.assertTrue(row["worst"], row)
        self.check_budgets(text, ledger)
        names = re.findall(r'^"([^"]+)":"data:', text, re.MULTILINE)
        self.assertEqual(len(names), len(set(names)), "every picture is embedded once")
        # The command line at the end measures the same rows.
        command = re.search(r'<code id="command">gloam (.*?)</code>', text).group(1).split(" ")
        self.assertIn("measured before", self.expect(0, *command).stdout)
        self.assertEqual((self.folder / "ledger/report.html").read_text(encoding="utf-8"), text)

    def check_budgets(self, text, ledger):
        """The first screen: every answer is a point, with its settings to download."""
        first = re.search(r'<section id="budgets".*?</section>', text, re.DOTALL).group(0)
        self.assertIn("What to turn down", first)
        settings = [point["settings"] for point in ledger["points"]]
        downloads = re.findall(r'href="data:application/json,([^"]*)" download=', first)
        self.assertTrue(downloads)
        for download in downloads:
            self.assertIn(json.loads(unquote(download)), settings)
        for point in ledger["points"]:
            if point["front"]:
                self.assertIn(f'\n"{point["picture"]}":"data:image/jpeg;base64,', text)

    def test_lost_pictures_are_made_again(self):
        self.measure()
        row = self.read_json("ledger/ledger.json")["rows"][0]
        lost = self.folder / f"ledger/pictures/{row['picture']}.png"
        before = lost.read_bytes()
        lost.unlink()
        self.measure()
        self.assertEqual(lost.read_bytes(), before)


if __name__ == "__main__":
    main()
