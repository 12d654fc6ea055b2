// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/sections.h"

namespace gloam {

extern const std::string_view kPageScript = R"js('use strict';
const pictures = JSON.parse(document.getElementById('pictures').textContent);
const byId = (id) => document.getElementById(id);

// Pictures without room in the page stay links, with their description as text.
for (const image of document.querySelectorAll('img[data-picture]')) {
  const data = pictures[image.dataset.picture];
  if (data) image.src = data;
  else image.replaceWith(image.alt + ' (not embedded: opens the file)');
}

function startLook() {
  const left = byId('left'), right = byId('right');
  if (!left) return;
  for (const child of left.children) right.append(child.cloneNode(true));

  const chosen = (select) => select.selectedOptions[0];
  const choose = (select, value) => {
    for (const option of select.options) if (option.value === value) { option.selected = true; return; }
  };
  const setImage = (image, name, text) => {
    image.hidden = !pictures[name];
    if (pictures[name]) image.src = pictures[name];
    image.alt = text;
  };
  const showAreas = (option) => {
    for (const old of document.querySelectorAll('.area')) old.remove();
    const size = byId('compare').dataset;
    if (!option.dataset.areas || !size.width) return;
    option.dataset.areas.split(';').forEach((text, index) => {
      const [x, y, width, height] = text.split(' ').map(Number);
      const area = document.createElement('span');
      area.className = 'area';
      area.setAttribute('aria-hidden', 'true');
      const number = document.createElement('span');
      number.textContent = index + 1;
      area.append(number);
      area.style.left = 100 * x / size.width + '%';
      area.style.top = 100 * y / size.height + '%';
      area.style.width = 100 * width / size.width + '%';
      area.style.height = 100 * height / size.height + '%';
      document.querySelector('.heat').append(area);
    });
  };
  const show = () => {
    const a = chosen(left), b = chosen(right);
    setImage(byId('left-picture'), a.dataset.picture, 'Left: ' + a.textContent);
    setImage(byId('right-picture'), b.dataset.picture, 'Right: ' + b.textContent);
    for (const [id, option] of [['left-full', a], ['right-full', b]]) {
      byId(id).href = 'pictures/' + option.dataset.picture + '.png';
      byId(id).setAttribute('aria-label', 'Full size: ' + option.textContent);
    }
    const missing = [a, b].filter((option) => !pictures[option.dataset.picture]).map((option) => option.textContent);
    byId('look-note').textContent = 'Left: ' + a.textContent + ' – ' + a.dataset.note + '. Right: ' + b.textContent +
        ' – ' + b.dataset.note + '.' + (missing.length ? ' Not embedded, only at full size: ' + missing.join(', ') + '.' : '');
    byId('heat-figure').hidden = !pictures[b.dataset.heat];
    byId('worst-figure').hidden = !pictures[b.dataset.worst];
    setImage(byId('heat-picture'), b.dataset.heat, 'FLIP of each pixel of ' + b.textContent);
    setImage(byId('worst-picture'), b.dataset.worst, 'Worst areas of ' + b.textContent + ' beside the reference');
    showAreas(b);
  };

  const slider = byId('slider'), compare = byId('compare');
  const move = () => {
    compare.style.setProperty('--border', slider.value + '%');
    slider.setAttribute('aria-valuetext', slider.value + ' % left');
  };
  const drag = (event) => {
    const box = compare.getBoundingClientRect();
    slider.value = Math.round(100 * (event.clientX - box.left) / box.width);
    move();
  };
  slider.addEventListener('input', move);
  compare.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    compare.setPointerCapture(event.pointerId);
    drag(event);
  });
  compare.addEventListener('pointermove', (event) => { if (event.buttons) drag(event); });
  left.addEventListener('change', show);
  right.addEventListener('change', show);
  document.addEventListener('click', (event) => {
    const link = event.target.closest('a[data-right]');
    if (!link) return;
    if (link.dataset.left) choose(left, link.dataset.left);
    choose(right, link.dataset.right);
    show();  // then the link moves the focus
  });
  const first = byId('look').dataset;
  if (first.left) choose(left, first.left);
  if (first.right) choose(right, first.right);
  show();
}

function startTable() {
  const table = byId('rows'), body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells], rows = [...body.rows];
  const key = (row, column) => {
    const cell = row.cells[column];
    return cell.dataset.sort === undefined ? null : Number(cell.dataset.sort);
  };
  // Absent numbers come last in both directions. Equal rows keep the ledger's order.
  const sort = (column, direction) => {
    const numeric = heads[column].classList.contains('number');
    const sorted = rows.slice().sort((a, b) => {
      if (!numeric) return direction * a.cells[column].textContent.localeCompare(b.cells[column].textContent, 'en', {numeric: true});
      const x = key(a, column), y = key(b, column);
      if (x === null || y === null) return (x === null) - (y === null);
      return direction * (x - y);
    });
    body.append(...sorted);
    heads.forEach((head, index) => head.setAttribute('aria-sort',
        index !== column ? 'none' : direction > 0 ? 'ascending' : 'descending'));
  };
  heads.forEach((head, column) => head.firstElementChild.addEventListener('click',
      () => sort(column, head.getAttribute('aria-sort') === 'ascending' ? -1 : 1)));

  const filter = () => {
    const words = byId('filter').value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = [0, 1, 2].map((column) => row.cells[column].textContent.toLowerCase()).join(' ');
      row.hidden = !words.every((word) => text.includes(word)) ||
          (byId('front-only').checked && row.dataset.front === '0') ||
          (byId('effect-only').checked && row.dataset.effect === '0');
      shown += row.hidden ? 0 : 1;
    }
    byId('shown').textContent = shown + ' of ' + rows.length + ' rows';
  };
  for (const id of ['filter', 'front-only', 'effect-only']) byId(id).addEventListener('input', filter);
  document.querySelector('.filters').addEventListener('submit', (event) => event.preventDefault());
  filter();
}

// The measured combination with the least error within the time that is typed; of equal ones, the fastest.
function startBudget() {
  const input = byId('budget');
  if (!input) return;
  input.parentElement.hidden = false;
  const rows = [...byId('points').tBodies[0].rows];
  const answer = () => {
    const limit = Number(input.value), line = byId('budget-answer');
    let best = null;
    for (const row of rows)
      if (Number(row.dataset.ms) <= limit && (!best || Number(row.dataset.flip) < Number(best.dataset.flip))) best = row;
    if (!best) {
      line.textContent = 'No measured combination is as fast.';
      return;
    }
    if (best.dataset.now === '1') {
      line.textContent = 'Your settings: ' + best.cells[2].textContent + ', error ' + best.cells[4].textContent + '.';
      return;
    }
    const [ratio, time, , error] = [...best.cells].slice(1).map((cell) => cell.textContent);
    const file = document.createElement('a');
    file.href = 'data:application/json,' + encodeURIComponent(best.dataset.config);
    file.download = 'settings.json';
    file.textContent = 'download for --config';
    line.replaceChildren(best.cells[0].firstElementChild.cloneNode(true), ': ' + ratio + ' of your time, ' + time +
        ', error ' + error + '; ', file);
  };
  input.addEventListener('input', answer);
  answer();
}

// Copies the text of a setting's file. Without access to the clipboard, the text is selected.
function startCopying() {
  document.addEventListener('click', async (event) => {
    const button = event.target.closest('button[data-copy]');
    if (!button) return;
    const text = byId(button.dataset.copy);
    try {
      await navigator.clipboard.writeText(text.textContent);
      button.textContent = 'Copied';
    } catch {
      text.closest('details').open = true;
      getSelection().selectAllChildren(text);
      button.textContent = 'Selected: press Ctrl+C';
    }
    button.removeAttribute('aria-label');
  });
}

// Paper cannot unfold anything.
function startPrinting() {
  let folded = [];
  addEventListener('beforeprint', () => {
    folded = [...document.querySelectorAll('details:not([open])')];
    for (const details of folded) details.open = true;
  });
  addEventListener('afterprint', () => { for (const details of folded) details.open = false; });
}

startLook();
startBudget();
startPrinting();
startTable();
startCopying();
)js";

}  // namespace gloam
