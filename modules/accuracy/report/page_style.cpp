// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/sections.h"

namespace gloam {

extern const std::string_view kPageStyle = R"css(
:root { color-scheme: light dark; --page: #fff; --text: #1b1f24; --soft: #59636e; --line: #d5dae0; --panel: #f5f7f9;
  --link: #0b5cad; --front: #0b5cad; --other: #8a949e; --wrong: #b3261e; --bound: #9a5b00; }
@media (prefers-color-scheme: dark) {
  :root { --page: #14171a; --text: #e6e9ec; --soft: #a3adb8; --line: #3a424a; --panel: #1d2226;
    --link: #7db8f5; --front: #7db8f5; --other: #8a949e; --wrong: #ff8a80; --bound: #e0a64a; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 76rem; padding: 0 1.25rem 4rem; background: var(--page); color: var(--text);
  font: 1rem/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 1.5rem 0 .25rem; }
h2 { font-size: 1.35rem; margin: 2.5rem 0 .5rem; border-top: 2px solid var(--line); padding-top: 1rem; }
h3 { font-size: 1.12rem; margin: 1.75rem 0 .25rem; }
h4 { font-size: 1rem; margin: 0 0 .25rem; }
p { margin: .35rem 0; max-width: 52rem; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Consolas, monospace; font-size: .92em; }
h1 code { font-size: 1em; }
pre { background: var(--panel); border: 1px solid var(--line); padding: .75rem; overflow-x: auto; }
a { color: var(--link); }
:focus-visible { outline: 3px solid var(--link); outline-offset: 2px; }
h2:focus { outline: none; }
h2:focus-visible { outline: 3px solid var(--link); }
.skip { position: absolute; left: -999rem; }
.skip:focus { left: 1rem; top: .5rem; background: var(--page); padding: .5rem; }
nav a { margin-right: 1rem; display: inline-block; }
.meaning, .reference, .empty, .none { color: var(--soft); }
.cards { list-style: none; margin: .75rem 0; padding: 0; display: grid; gap: 1rem; align-items: start;
  grid-template-columns: repeat(auto-fill, minmax(min(22rem, 100%), 1fr)); }
.card, .knob { border: 1px solid var(--line); border-radius: 6px; background: var(--panel); padding: .9rem 1rem; }
.knob { margin: .75rem 0; }
.lead { margin: .75rem 0 1.5rem; }
.lead ul { margin: .25rem 0 .5rem; padding-left: 1.25rem; }
.answer { font-size: 1.2rem; max-width: none; }
.lead pre, .setting pre { max-height: 14rem; overflow: auto; margin: .4rem 0; }
.lead details, .setting details { margin: .4rem 0; }
.lead .do, .setting .do { justify-content: flex-start; }
#budget { width: 7rem; }
#budget-answer code { overflow-wrap: anywhere; }
.setting img { width: 100%; margin: .4rem 0; }
.setting ul { margin: .25rem 0; padding-left: 1.25rem; }
#points { width: 100%; }
#points code { white-space: normal; overflow-wrap: anywhere; }
.gain { font-size: 1.2rem; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .6rem; margin: .5rem 0; }
figure { margin: 0; }
figcaption { color: var(--soft); font-size: .88rem; }
img { display: block; max-width: 100%; }
.pair img { width: 100%; }
.and-worst { grid-template-columns: 1fr 1fr .56fr; }
.worst img { image-rendering: pixelated; }
#budgets h2 { margin-top: 1.25rem; }
.do { display: flex; flex-wrap: wrap; align-items: center; gap: .25rem 1.25rem; justify-content: space-between; }
.chart-and-table { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
.plot { flex: 1 1 26rem; min-width: 0; max-width: 35rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .92rem; }
.values { flex: 1 1 24rem; min-width: 0; }
.values table { width: 100%; font-size: .85rem; }
.values th, .values td { padding: .25rem .4rem; }
.values td:last-child { min-width: 7.5rem; }
th, td { text-align: left; padding: .25rem .6rem; border-bottom: 1px solid var(--line); vertical-align: top; font-weight: normal; }
thead th { font-weight: 600; }
.number { text-align: right; white-space: nowrap; }
.plot text { fill: var(--text); font-size: 12px; }
.plot .tick, .plot .axis { fill: var(--soft); }
.plot .x, .plot .name { text-anchor: middle; }
.plot .y, .plot .bound-text { text-anchor: end; }
.plot .grid { stroke: var(--line); }
.plot .bound { stroke: var(--bound); stroke-dasharray: 5 4; }
.plot .bound-text { fill: var(--bound); }
.plot .whisker { stroke: var(--text); stroke-width: 1.5; }
.plot .front-line { fill: none; stroke: var(--front); stroke-opacity: .5; stroke-width: 2; }
.plot .mark.front { fill: var(--front); stroke: var(--page); }
.plot .mark.other { fill: var(--other); stroke: var(--page); }
.plot .mark.default { fill: none; stroke: var(--text); stroke-width: 1.5; }
.plot .mark.wrong { fill: none; stroke: var(--wrong); stroke-width: 2.5; }
.plot a:hover .name, .plot a:focus .name { font-weight: 700; text-decoration: underline; }
.keys { color: var(--soft); font-size: .88rem; }
details { margin: 1rem 0; }
summary { cursor: pointer; font-weight: 600; }
select, input, button { font: inherit; color: inherit; background: var(--page); border: 1px solid var(--soft); border-radius: 4px; padding: .2rem .4rem; }
select { max-width: 100%; }
.pickers { display: flex; flex-wrap: wrap; gap: .25rem 2rem; max-width: 52rem; }
.pickers p { flex: 1 1 18rem; min-width: 0; }
.pickers select { width: 100%; }
.compare { position: relative; overflow: hidden; max-width: 52rem; background: #000; touch-action: none; cursor: ew-resize; }
.compare img { width: 100%; }
#right-picture { position: absolute; inset: 0; height: 100%; clip-path: inset(0 0 0 var(--border, 50%)); }
.bar { position: absolute; top: 0; bottom: 0; left: var(--border, 50%); width: 2px; margin-left: -1px; background: #fff;
  box-shadow: 0 0 0 1px #000; }
.corner { position: absolute; top: .5rem; padding: 0 .5rem; background: rgba(0, 0, 0, .7); color: #fff; font-size: .88rem; z-index: 1; }
.corner.left { left: .5rem; }
.corner.right { right: .5rem; }
#slider { width: 100%; display: block; padding: 0; }
.errors { display: flex; flex-wrap: wrap; gap: 1.5rem; margin-top: 1rem; align-items: flex-start; }
#heat-figure { flex: 1 1 26rem; max-width: 40rem; }
.heat { position: relative; }
.heat img { width: 100%; }
.area { position: absolute; border: 2px solid #fff; outline: 1px solid #000; color: #fff; font-size: .8rem; line-height: 1; }
.area span { background: #000; padding: 1px 3px; }
#worst-picture { width: 392px; max-width: 100%; image-rendering: pixelated; }
#worst-figure { max-width: min(392px, 100%); }
.legend { display: block; height: .8rem; max-width: 24rem; margin-top: .3rem;
  background: linear-gradient(90deg, rgb(0, 0, 0), rgb(70, 20, 120), rgb(185, 55, 105), rgb(250, 145, 55), rgb(255, 250, 195)); }
.legend-text { display: block; position: relative; height: 1.3rem; max-width: 24rem; }
.legend-text span { position: absolute; transform: translateX(-50%); }
.legend-text span:first-child { transform: none; }
.legend-text span:last-child { transform: translateX(-100%); }
.filters { display: flex; flex-wrap: wrap; gap: .25rem 1.5rem; align-items: center; }
.scroll { overflow-x: auto; }
#rows { width: 100%; font-size: .85rem; }
#rows th, #rows td { padding: .25rem .4rem; }
.unit { display: inline-block; white-space: normal; max-width: 8rem; text-align: left; }
#called-for details { margin: .2rem 0 .5rem; }
#rows thead th { white-space: normal; vertical-align: bottom; }
#rows code { white-space: nowrap; }
#rows thead button { border: 0; background: none; padding: 0; font-weight: 600; cursor: pointer; text-align: inherit; }
#rows th[aria-sort="ascending"] button::after { content: " ▲"; }
#rows th[aria-sort="descending"] button::after { content: " ▼"; }
@media (max-width: 40rem) {
  body { padding: 0 .9rem 3rem; }
  .plot text { font-size: 17px; }
  .and-worst { grid-template-columns: 1fr 1fr; }
}
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
@media print {
  :root { --page: #fff; --text: #000; --soft: #444; --line: #bbb; --panel: #fff; --link: #000; --front: #000; --other: #888; }
  body { padding: 0; max-width: none; font-size: .8rem; }
  nav, .skip, .filters, .pickers, .budget, #budget-answer, .do, #slider, label[for="slider"] { display: none; }
  .card, .knob, figure, tr, svg, pre, .lead .pair, .compare, .errors { break-inside: avoid; }
  .legend, .corner, .area, .area span, .bar { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  summary { list-style: none; }
  summary::-webkit-details-marker { display: none; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; }
  .chart-and-table, .errors { flex-wrap: nowrap; }
  .plot { flex: 1 1 48%; }
  .values { flex: 1 1 52%; }
  .values table { font-size: .6rem; }
  .values th, .values td { padding: .15rem .25rem; }
  .values td:last-child { min-width: 0; }
  #heat-figure, #worst-figure { flex: 1 1 50%; }
  .cards { grid-template-columns: 1fr 1fr; }
  h2, h3, h4, h2 + p, h3 + p, summary { break-after: avoid; }
  .scroll { overflow: visible; }
  .compare { max-width: 30rem; }
  #rows, #points { font-size: .55rem; }
  #rows code { overflow-wrap: anywhere; }
  #rows code, #rows th, #rows td { white-space: normal; }
  #rows th, #rows td { padding: .1rem .2rem; }
}
)css";

}  // namespace gloam
