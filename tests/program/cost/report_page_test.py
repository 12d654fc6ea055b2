# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Uses the page report.html of `cost` in a browser: by keyboard, in both themes, on screens and paper, and by the rules of
page_rules.py. Needs a Vulkan device and Chromium."""
import csv
import json
import re
import tempfile
from pathlib import Path

import page_rules
from browser import CHROMIUM, Browser
from program_case import ProgramCase, main

MEASURE = ("cost", "builtin:shadows", "--quick", "--size", "192x108", "--points", "4", "--out", "ledger", "--knobs",
           "shadows.filter,shadows.near,lights.culling,lighting.antialiasing,lighting.tone_map")
CAMERAS = ("cost", "builtin:shadows", "--quick", "--size", "48x27", "--points", "0", "--out", "ledger", "--knobs",
           "shadows.filter,grass.lod_pixels", "--cameras", "main,close")
SIZES = ((1280, 900), (400, 900))
# For each rule, changes of the page that break it.
MUTATIONS = {
    "lang": ["document.documentElement.lang = ''"],
    "title": ["document.title = ''"],
    "zoom": ["document.querySelector('meta[name=viewport]').content += ', user-scalable=no'"],
    "headings": ["document.querySelector('h3').outerHTML = '<h5>deep</h5>'", "document.querySelector('h1').remove()"],
    "landmarks": ["document.querySelector('main').outerHTML = '<div>' + document.querySelector('main').innerHTML + '</div>'",
                  "document.querySelector('.scroll').removeAttribute('aria-label')"],
    "images": ["document.querySelector('.lead img').alt = ''", "document.querySelector('svg').removeAttribute('aria-label')"],
    "ids": ["document.querySelector('h3').id = 'look'", "document.getElementById('slider').id = 'other'"],
    "tables": ["document.querySelector('th').removeAttribute('scope')",
               "document.querySelector('#rows tbody th').outerHTML = '<td>hard</td>'"],
    "tabindex": ["document.querySelector('.scroll').tabIndex = 3"],
    "lists": ["document.querySelector('.cards').append(document.createElement('p'))"],
    "nesting": ["document.querySelector('a').append(document.createElement('button'))"],
    "spoken": ["document.querySelector('[data-copy]').setAttribute('aria-label', 'something else')"],
    "scrolling": ["document.querySelectorAll('.scroll').forEach((region) => { region.removeAttribute('tabindex'); "
                  "region.style.width = '50px'; })"],
    "width": ["document.querySelector('h1').style.width = '2000px'"],
    "motion": ["document.querySelector('h1').style.transition = 'color 1s'"],
    "contrast": ["document.querySelector('p').style.color = '#888'", "document.querySelector('.tick').style.fill = '#888'",
                 "document.querySelector('.corner').style.background = 'rgba(0, 0, 0, .3)'"],
    "names": ["document.querySelector('label[for=slider]').remove()",
              "document.querySelector('label[for=filter]').textContent = ''"],
}


class ReportPage(ProgramCase):
    pages = {}  # by the arguments of `cost`: folders that live as long as the tests
    browser = None

    @classmethod
    def tearDownClass(cls):
        if cls.browser:
            cls.browser.close()
        for folder in cls.pages.values():
            folder.cleanup()

    def setUp(self):
        super().setUp()
        self.require_device()
        if CHROMIUM is None:
            self.skipTest("there is no Chromium")
        if ReportPage.browser is None:
            ReportPage.browser = Browser()
        self.open(MEASURE)

    def open(self, arguments, size=SIZES[0], theme="light", **media):
        if arguments not in self.pages:
            self.expect(0, *arguments)
            self.pages[arguments] = tempfile.TemporaryDirectory(prefix="gloam-page-")
            (self.folder / "ledger").rename(Path(self.pages[arguments].name) / "ledger")
        self.page = Path(self.pages[arguments].name) / "ledger/report.html"
        self.browser.emulate(*size, theme, **media)
        self.browser.open(self.page)

    def focus(self, element):
        self.browser.evaluate(f"document.querySelector({element!r}).focus()")

    def value(self, script):
        return self.browser.evaluate(script)

    def test_keeps_the_rules_on_all_screens_and_in_both_themes(self):
        for arguments in (MEASURE, CAMERAS):
            for size in SIZES:
                for theme in ("light", "dark"):
                    with self.subTest(arguments=arguments, size=size, theme=theme):
                        self.open(arguments, size, theme, motion="reduce")
                        background = self.value("getComputedStyle(document.body).backgroundColor")
                        self.assertEqual(background == "rgb(255, 255, 255)", theme == "light")
                        for folded in (True, False):
                            self.assertEqual(page_rules.broken_rules(self.browser), {}, f"folded: {folded}")
                            self.value("document.querySelectorAll('details').forEach((details) => details.open = true)")
                        self.assertEqual(self.browser.messages, [])
                        self.assertEqual(self.browser.requests, [f"file://{self.page}"])

    def test_the_example_of_the_documents_keeps_the_rules(self):
        example = self.source.resolve() / "docs/example-report.html"
        text = example.read_text(encoding="utf-8")
        self.assertLess(len(text.encode()), 3_000_000)
        shown = re.sub(r'<script type="application/json".*?</script>', "", text, flags=re.DOTALL)
        self.assertNotRegex(shown, r"/(tmp|home|root|work|usr|mnt)/", "no paths of a machine")
        self.assertIn("gloam cost builtin:", re.search(r'<code id="command">(.*?)</code>', shown).group(1))
        for theme in ("light", "dark"):
            self.browser.emulate(*SIZES[0], theme, motion="reduce")
            self.browser.open(example)
            self.assertEqual(page_rules.broken_rules(self.browser), {})
            self.assertEqual((self.browser.messages, self.browser.requests), ([], [f"file://{example}"]))

    def test_the_rules_find_what_breaks_them(self):
        self.assertEqual(set(MUTATIONS), set(self.value(page_rules.RULES)) | {"names"}, "a mutation for each rule")
        for rule, mutations in MUTATIONS.items():
            for mutation in mutations:
                with self.subTest(rule=rule, mutation=mutation):
                    self.open(MEASURE, motion="reduce")
                    self.value(f"void ({mutation})" if "forEach" not in mutation else mutation)
                    self.assertIn(rule, page_rules.broken_rules(self.browser))

    def test_the_focus_goes_through_all_controls_and_is_seen(self):
        self.value("document.querySelectorAll('details').forEach((details) => details.open = true)")
        self.assertGreater(self.value(page_rules.FOCUSABLE + ".length"), 40)
        self.assertEqual(page_rules.focus_faults(self.browser), [])
        self.value("void (document.querySelector('#filter').style.outline = 'none')")
        self.assertNotEqual(page_rules.focus_faults(self.browser), [], "an invisible focus is found")
        self.open(MEASURE)
        self.value("document.querySelector('.lead').style.cssText = 'display: flex; flex-direction: column-reverse'")
        self.value("void (document.querySelector('#slider').tabIndex = 1)")
        self.assertNotEqual(page_rules.focus_faults(self.browser), [], "a jump is found")

    def test_the_slider_moves_by_keys(self):
        self.focus("#slider")
        for key, expected in (("ArrowRight", "51"), ("ArrowRight", "52"), ("ArrowLeft", "51"), ("Home", "0"), ("End", "100")):
            self.browser.press(key)
            self.assertEqual(self.value("slider.value"), expected, key)
            self.assertEqual(self.value("compare.style.getPropertyValue('--border')"), expected + "%")
            self.assertEqual(self.value("slider.getAttribute('aria-valuetext')"), expected + " % left")

    def test_pictures_are_chosen_by_keys(self):
        self.focus("#right")
        before = self.value("[right.selectedIndex, document.getElementById('look-note').textContent]")
        self.browser.press("Home")
        self.browser.press("ArrowDown")
        after = self.value("[right.selectedIndex, document.getElementById('look-note').textContent]")
        self.assertEqual(after[0], 1)
        self.assertNotEqual(before, after)
        self.assertIn("Right: " + self.value("right.selectedOptions[0].textContent") + " – ", after[1])
        # A point of a plot shows its picture.
        self.focus(".knob .plot a")
        self.browser.press("Enter")
        self.assertEqual(self.value("document.activeElement.id"), "look-title")
        self.assertEqual(self.value("right.value"), self.value("document.querySelector('.knob .plot a').dataset.right"))
        self.assertEqual(self.value("getComputedStyle(document.querySelector('.heat img')).display"), "block")

    def test_the_table_sorts_and_filters_by_keys(self):
        sorts = "[...document.querySelectorAll('#rows th[aria-sort]')].map((head) => head.getAttribute('aria-sort'))"
        column = "[...rows.tBodies[0].rows].map((row) => row.cells[3].dataset.sort).map(Number)"
        count = self.value("rows.tBodies[0].rows.length")
        self.focus("#rows th:nth-child(4) button")
        for key, direction in (("Enter", "ascending"), (" ", "descending")):
            self.browser.press(key)
            self.assertEqual(self.value(sorts)[3], direction)
            self.assertEqual(set(self.value(sorts)) - {direction}, {"none"})
            numbers = self.value(column)
            self.assertEqual(len(numbers), count)
            self.assertEqual(numbers, sorted(numbers, reverse=direction == "descending"))
        self.focus("#filter")
        for letter in "chs":
            self.browser.press(letter)
        shown = "[...rows.tBodies[0].rows].filter((row) => !row.hidden).map((row) => row.cells[1].textContent)"
        self.assertEqual(self.value(shown), ["chs (default)"])
        self.assertEqual(self.value("document.getElementById('shown').textContent"), f"1 of {count} rows")
        self.focus("#effect-only")
        self.browser.press(" ")
        self.assertTrue(self.value("document.getElementById('effect-only').checked"))

    def type_budget(self, text):
        self.focus("#budget")
        self.value("budget.select()")
        for letter in text:
            self.browser.press(letter)
        return self.value("document.getElementById('budget-answer').textContent")

    def test_a_time_is_typed_and_answered(self):
        points = self.value("[...points.tBodies[0].rows].map((row) => "
                            "({ms: Number(row.dataset.ms), flip: Number(row.dataset.flip), now: row.dataset.now === '1',"
                            " setting: row.cells[0].textContent})).sort((a, b) => a.ms - b.ms)")
        self.assertIn("No measured combination is as fast", self.type_budget("0"))
        for limit in [point["ms"] + 0.001 for point in points]:
            best = min((point for point in points if point["ms"] <= limit), key=lambda point: point["flip"])
            answer = self.type_budget(f"{limit:.4f}")
            self.assertTrue(answer.startswith("Your settings: " if best["now"] else best["setting"] + ": "), answer)
        before = self.value("budget.value")
        self.browser.press("ArrowUp")
        self.assertNotEqual(self.value("budget.value"), before)

    def test_settings_are_copied_by_keys(self):
        self.focus("[data-copy]")
        self.browser.press("Enter")
        self.browser.wait_until("document.querySelector('[data-copy]').textContent !== 'Copy settings'")
        if self.value("document.querySelector('[data-copy]').textContent") != "Copied":  # no access to the clipboard
            text = self.value("document.getElementById(document.querySelector('[data-copy]').dataset.copy).textContent")
            self.assertEqual(self.value("getSelection().toString()").strip(), text.strip())

    def test_shows_all_pictures(self):
        lost = self.value("[...document.images].filter((image) => image.checkVisibility() && !image.naturalWidth).length")
        self.assertEqual(lost, 0)
        self.assertNotIn("not embedded", self.value("document.body.innerText"))
        self.assertEqual(self.value("document.getElementById('shown').textContent"),
                         self.value("rows.tBodies[0].rows.length + ' of ' + rows.tBodies[0].rows.length + ' rows'"))
        # What cost has switched off, so that frames at rest cost what others do, is no advice.
        self.assertNotIn("reuse", self.value("document.querySelector('.lead').innerText"))
        first = self.value("document.querySelector('.lead').getBoundingClientRect().bottom")
        self.assertLess(first, SIZES[0][1], "the answer and its pictures stand on the first screen")

    def test_shows_the_numbers_of_the_ledger(self):
        folder = self.page.parent
        ledger = json.loads((folder / "ledger.json").read_text(encoding="utf-8"))
        heads = self.value("[...rows.tHead.rows[0].cells].map((cell) => cell.textContent)")
        table = self.value("[...rows.tBodies[0].rows].map((row) => [...row.cells].map((cell) => [cell.textContent, cell.dataset.sort]))")
        self.assertEqual(len(table), len(ledger["rows"]))
        edges = 0
        for cells, row in zip(table, ledger["rows"]):
            cell = dict(zip(heads, cells))
            self.assertEqual((cell["Knob"][0], cell["Value"][0].removesuffix(" (default)")), (row["knob"], row["value"]))
            error = row["error"]
            numbers = {"Ratio": row["ratio"], "Frame, ms": row["ms"]["median"], "FLIP mean": error.get("flip", {}).get("mean"),
                       "FLIP p99": error.get("flip", {}).get("p99"), "FLIP at edges": error.get("edges", {}).get("flip", {}).get("mean"),
                       "RMSE, cd/m²": error.get("rmse"), "Counted": error.get("counted", {}).get("value"),
                       "Whole frame, FLIP": row.get("whole_frame", {}).get("flip", {}).get("mean")}
            edges += numbers["FLIP at edges"] is not None
            for head, number in numbers.items():
                text, sort = cell[head]
                if number is None:
                    self.assertEqual((text, sort), ("–", None), (head, row))
                    continue
                self.assertAlmostEqual(float(sort), number, delta=1e-8 * abs(number) + 1e-12)
                if text != "< noise":
                    # Two decimals; two or three significant digits.
                    rounding = 0.00501 if head == "Ratio" else (0.0501 if abs(number) < 1e-4 else 0.00501) * abs(number)
                    self.assertAlmostEqual(float(re.match(r"[-+.\de]+", text).group()), number, delta=rounding)
        self.assertGreater(edges, 4, "errors at edges were measured")
        with open(folder / "points.csv", encoding="utf-8", newline="") as file:
            points = list(csv.DictReader(file))
        shown = self.value("[...points.tBodies[0].rows].map((row) => [row.cells[0].textContent, Number(row.dataset.ms),"
                           " Number(row.dataset.flip), JSON.parse(row.dataset.config)])")
        self.assertEqual(len(shown), len(points))
        for (setting, ms, flip, config), point, measured in zip(shown, points, ledger["points"]):
            self.assertEqual((setting, config), (point["settings"], measured["settings"]))
            self.assertAlmostEqual(ms, float(point["median_ms"]), delta=1e-8 * ms)
            self.assertAlmostEqual(flip, float(point["flip_mean"]), delta=1e-8)
        self.check_recommendation(points)

    def check_recommendation(self, points):
        """The first screen has the fastest point of the front whose error is below 0.01 or that of the user's, or else below 0.03."""
        users = next(float(point["flip_mean"]) for point in points if point["default"] == "1")
        faster = [point for point in points if float(point["ratio_high"]) < 1.0 and point["front"] == "1"]
        right = [point for point in faster if float(point["flip_mean"]) < 0.01 or float(point["flip_mean"]) <= users] or \
                [point for point in faster if float(point["flip_mean"]) < 0.03]
        answer = self.value("document.querySelector('.answer').textContent")
        if not right:
            self.assertRegex(answer, r"^(Nothing|Single values only)\. No measured combination")
            return
        best = min(right, key=lambda point: float(point["median_ms"]))
        self.assertAlmostEqual(float(re.search(r"takes ([\d.]+) ", answer).group(1)), float(best["ratio"]), delta=0.006)
        settings = self.value("[...document.querySelectorAll('.lead li')].map((item) => item.querySelector('code').textContent"
                              " + '=' + item.querySelector('strong').textContent).join(' ')")
        self.assertEqual(settings, best["settings"])

    def test_prints_without_controls_and_cuts(self):
        paper = (680, 960)  # pixels of a page of A4 or letter within its margins
        self.open(MEASURE, paper, media="print")
        self.value("void dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.value("document.querySelectorAll('details:not([open])').length"), 0, "everything is unfolded")
        shown = ".filter((element) => element.checkVisibility() && element.getClientRects().length)"
        self.assertEqual(self.value(f"[...document.querySelectorAll('select,input,:not(th) > button,nav a')]{shown}.length"), 0)
        wide = f"[...document.querySelectorAll('main *')]{shown}.filter((element) => element.getBoundingClientRect().right > innerWidth + 1)"
        self.assertEqual(self.value(wide + ".map((element) => element.outerHTML.slice(0, 80))"), [])
        scrolled = "[...document.querySelectorAll('.scroll,pre')].filter((element) => element.scrollWidth > element.clientWidth + 1)"
        self.assertEqual(self.value(scrolled + ".map((element) => element.outerHTML.slice(0, 80))"), [])
        cut = f"""[...document.querySelectorAll('main img, main svg')]{shown}.filter((image) => {{
            let whole = false;
            for (let at = image; at && at !== document.body; at = at.parentElement)
                whole ||= getComputedStyle(at).breakInside === 'avoid';
            return !whole || image.getBoundingClientRect().height > {paper[1]};
        }})"""
        self.assertEqual(self.value(cut + ".map((image) => image.outerHTML.slice(0, 80))"), [])
        self.value("void dispatchEvent(new Event('afterprint'))")
        self.assertGreater(self.value("document.querySelectorAll('details:not([open])').length"), 0)
        pdf = self.browser.pdf()
        pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
        self.assertTrue(2 <= pages <= 14, pages)


if __name__ == "__main__":
    main()
