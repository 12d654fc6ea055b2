# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Rules of accessibility for a page in a browser: those of axe-core that a static page can break (Debian has no axe-core)."""

# Each rule returns texts that say where it is broken. `visible`: elements that are shown.
RULES = r"""(() => {
const all = (selector) => [...document.querySelectorAll(selector)];
const shown = (element) => element.checkVisibility({visibilityProperty: true}) && element.getClientRects().length > 0;
const place = (element) => element.tagName.toLowerCase() + (element.id ? '#' + element.id : '') +
    (element.className && element.className.baseVal === undefined ? '.' + element.className : '') + ' ' +
    (element.textContent || '').trim().slice(0, 40);
const rules = {};

rules.lang = () => document.documentElement.lang ? [] : ['html has no lang'];
rules.title = () => document.title.trim() ? [] : ['no title'];
rules.zoom = () => all('meta[name=viewport]').filter((meta) => /user-scalable|maximum-scale/.test(meta.content)).map(place);
rules.headings = () => {
  const faults = [];
  let last = 0;
  for (const heading of all('h1,h2,h3,h4,h5,h6').filter(shown)) {
    const level = Number(heading.tagName[1]);
    if (level > last + 1) faults.push(place(heading) + ' after level ' + last);
    if (!heading.textContent.trim()) faults.push(place(heading) + ' is empty');
    last = level;
  }
  if (all('h1').length !== 1) faults.push('not one h1');
  return faults;
};
rules.landmarks = () => {
  const faults = all('main,[role=main]').length === 1 ? [] : ['not one main'];
  for (const child of document.body.children)
    if (shown(child) && !child.matches('main,header,nav,footer,aside,script,.skip')) faults.push(place(child));
  const regions = all('section,nav,[role=region],[role=search]');
  const name = (element) => element.getAttribute('aria-label') ||
      (document.getElementById(element.getAttribute('aria-labelledby')) || {}).textContent;
  for (const region of regions.filter((element) => element.matches('section,nav,[role=region]')))
    if (!name(region)) faults.push(place(region) + ' has no name');
  return faults;
};
rules.images = () => all('img,svg,[role=img]').filter(shown)
    .filter((image) => image.getAttribute('aria-hidden') !== 'true' && !image.getAttribute('alt') && !image.getAttribute('aria-label') &&
        image.getAttribute('role') !== 'presentation')
    .map(place);
rules.ids = () => {
  const ids = all('[id]').map((element) => element.id);
  const twice = ids.filter((id, index) => ids.indexOf(id) !== index);
  const lost = all('[for],[aria-labelledby],[aria-describedby]').flatMap((element) =>
      ['for', 'aria-labelledby', 'aria-describedby'].flatMap((key) => (element.getAttribute(key) || '').split(' '))
          .filter((id) => id && !document.getElementById(id)));
  return [...twice, ...lost.map((id) => 'no element ' + id)];
};
rules.tables = () => all('table').flatMap((table) => {
  const faults = [];
  for (const head of table.querySelectorAll('th'))
    if (!head.scope) faults.push(place(head) + ' has no scope');
  for (const cell of table.tHead ? table.tHead.rows[0].cells : [])
    if (cell.tagName !== 'TH' || !cell.textContent.trim()) faults.push(place(cell) + ' is no header');
  if (!table.tHead) faults.push(place(table) + ' has no head');
  for (const row of table.tBodies[0].rows)
    if (!row.querySelector('th')) faults.push(place(row) + ' has no header');
  return faults;
});
rules.tabindex = () => all('[tabindex]').filter((element) => element.tabIndex > 0).map(place);
rules.lists = () => [...all('li').filter((item) => !item.parentElement.matches('ul,ol')),
    ...all('ul,ol').filter((list) => [...list.children].some((child) => child.tagName !== 'LI')),
    ...all('dl').filter((list) => [...list.children].some((child) => !['DT', 'DD'].includes(child.tagName)))].map(place);
rules.nesting = () => all('a,button,select,input,summary')
    .filter((element) => element.querySelector('a,button,select,input,[tabindex]')).map(place);
// A name that lacks the visible text cannot be spoken to a computer.
rules.spoken = () => all('a[aria-label],button[aria-label]').filter(shown).filter((element) => {
  const text = [...(element.querySelectorAll('text').length ? element.querySelectorAll('text') : [element])]
      .map((part) => part.textContent.trim()).join(' ').toLowerCase();
  return !element.getAttribute('aria-label').toLowerCase().includes(text);
}).map(place);
rules.scrolling = () => all('*').filter((element) => {
  const style = getComputedStyle(element);
  return shown(element) && /auto|scroll/.test(style.overflowX + style.overflowY) && element !== document.documentElement &&
      (element.scrollWidth > element.clientWidth + 1 || element.scrollHeight > element.clientHeight + 1) &&
      element.tabIndex < 0;
}).map(place);
rules.width = () => document.documentElement.scrollWidth > innerWidth ? ['the page is wider than the window'] : [];
rules.motion = () => all('*').filter((element) => {
  const style = getComputedStyle(element);
  const moves = (times) => times.split(',').some((time) => parseFloat(time) > 0);
  return matchMedia('(prefers-reduced-motion: reduce)').matches &&
      (moves(style.transitionDuration) || moves(style.animationDuration) || style.scrollBehavior === 'smooth');
}).map(place);

const channels = (color) => {
  const parts = color.match(/[\d.]+/g).map(Number);
  return parts.length > 3 ? parts : [...parts, 1];
};
const over = (top, below) => [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3]));
const luminance = (color) => {
  const linear = color.slice(0, 3).map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
};
const ratio = (a, b) => {
  const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (high + 0.05) / (low + 0.05);
};
// Behind text on pictures everything from black to white may lie.
const backgrounds = (element) => {
  const layers = [];
  for (let at = element; at; at = at.parentElement) {
    const style = getComputedStyle(at);
    layers.push(channels(style.backgroundColor));
    if (layers.at(-1)[3] === 1) break;
    if (style.position === 'absolute' && at.parentElement.querySelector(':scope > img')) return [[0, 0, 0], [255, 255, 255]].map((base) => layers.reduceRight((below, top) => over(top, below), base));
  }
  return [layers.reduceRight((below, top) => over(top, below), [255, 255, 255])];
};
rules.contrast = () => all('body *').filter((element) => shown(element) && !element.matches('script,style,option,optgroup,title') &&
    [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())).flatMap((element) => {
  const style = getComputedStyle(element), svg = element instanceof SVGElement;
  const size = parseFloat(style.fontSize);
  const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
  const text = channels(svg ? style.fill : style.color);
  const worst = Math.min(...backgrounds(svg ? element.ownerSVGElement : element).map((background) => ratio(over(text, background), background)));
  return worst < (large ? 3 : 4.5) ? [place(element) + ': ' + worst.toFixed(2)] : [];
});

return Object.fromEntries(Object.entries(rules).map(([name, rule]) => [name, rule()]));
})()"""

CONTROLS = {"link", "button", "checkbox", "combobox", "slider", "searchbox", "textbox", "spinbutton", "DisclosureTriangle", "image",
            "region"}
FOCUSABLE = """[...document.querySelectorAll('a[href],button,select,input,summary,[tabindex="0"]')]
    .filter((element) => element.checkVisibility({visibilityProperty: true}) && element.getClientRects().length > 0)"""
# Where the focus is among these elements, and whether it is seen.
FOCUS = f"""(() => {{
  const element = document.activeElement, style = getComputedStyle(element);
  return [{FOCUSABLE}.indexOf(element), style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2,
          element.outerHTML.slice(0, 80)];
}})()"""


def unnamed(browser):
    """Controls, images and regions without an accessible name."""
    faults = []
    for node in browser.call("Accessibility.getFullAXTree")["nodes"]:
        role = node.get("role", {}).get("value")
        if not node["ignored"] and role in CONTROLS and not node.get("name", {}).get("value", "").strip():
            faults.append(f"{role} {node.get('backendDOMNodeId')}")
    return faults


def broken_rules(browser):
    """The broken rules of the page as it is, with the places."""
    found = browser.evaluate(RULES)
    found["names"] = unnamed(browser)
    return {rule: places for rule, places in found.items() if places}


def focus_faults(browser):
    """Presses Tab through the whole page: every control gets the focus once, in the order of reading, and shows it."""
    faults = []
    count = browser.evaluate(FOCUSABLE + ".length")
    browser.evaluate("document.activeElement.blur(), scrollTo(0, 0)")
    for expected in range(count):
        browser.press("Tab")
        place, seen, text = browser.evaluate(FOCUS)
        if place != expected:
            return faults + [f"the focus is at {place}, not {expected}: {text}"]
        if not seen:
            faults.append(f"the focus is not seen: {text}")
    return faults
