// Panels next to the picture. Names come from files, so they are inserted as text, never as HTML.

import {locale, texts} from './texts.js';

const byId = (id) => document.getElementById(id);
const number = (value, digits) => value.toLocaleString(locale, {maximumFractionDigits: digits});

function spoken(value) {
  if (value === null || value === undefined)
    return texts.unknown;
  if (typeof value !== 'number')
    return value;
  return number(value, Math.abs(value) >= 1000 ? 0 : Math.abs(value) >= 100 ? 1 : 2);
}

function className(value) { return texts.classes[value] ?? value; }

function pair(name, value, title) {
  const row = document.createElement('div');
  const term = document.createElement('dt');
  const what = document.createElement('dd');
  term.textContent = name;
  term.title = title ?? '';
  what.textContent = value;
  row.append(term, what);
  return row;
}

function list(pairs) {
  const all = document.createElement('dl');
  all.append(...pairs);
  return all;
}

export function showSum(town) {
  const {crs} = town.about;
  const sum = texts.buildings(number(town.shown(), 0), number(town.all(), 0));
  byId('sum').textContent = `${sum}${crs ? `\n${crs}` : ''}`;
}

// Source, licence and date of the data.
export function showCredit(town) {
  const {credit, date} = town.about;
  const day = date ? new Date(`${date}T12:00:00`).toLocaleDateString(locale, {dateStyle: 'long'}) : '';
  const parts = [credit, day].filter((part) => part);
  byId('credit').hidden = parts.length === 0;
  byId('credit').textContent = `${texts.data}: ${parts.join(', ')}`;
}

export function showSource(town) {
  const items = Object.entries(town.about.metadata ?? {}).map(([name, value]) => pair(name, value));
  byId('source').append(...items);
}

export function showLevel(town, level) {
  const isRoofs = level > town.levels;
  const counts = isRoofs ? town.about.roofs : town.about.levels[level - 1];
  byId('leveltext').textContent = isRoofs ? texts.roofs : texts.levelsOf(level, town.levels);
  byId('contoursname').textContent = isRoofs ? texts.faces : texts.contours;
  byId('contours').textContent = counts ? number(counts.contours ?? counts.faces, 0) : '0';
  byId('corners').textContent = counts ? number(counts.corners, 0) : '0';
  byId('rmse').textContent = Number.isFinite(counts?.rmse) ? `${number(counts.rmse, 2)} m` : texts.unknown;
}

function classText(classes, i) {
  const [from, to] = [classes[i].from, classes[i + 1]?.from];
  return i === 0 ? texts.below(to) : to === undefined ? texts.above(from) : texts.between(from, to);
}

// A button for each of the alternatives. @param onChoose receives the value of one
export function showAlternatives(town, onChoose) {
  const pair = byId('alternatives');
  pair.hidden = town.alternatives.length < 2;
  if (pair.hidden)
    return;
  pair.replaceChildren(...town.alternatives.map((value) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.dataset.value = value;
    button.setAttribute('aria-pressed', String(value === town.alternative));
    button.textContent = texts.surveys[value] ?? value;
    button.addEventListener('click', () => onChoose(value));
    return button;
  }));
}

// Open if there is space.
export function showLegend(town) {
  const legend = byId('legend');
  const caption = document.createElement('p');
  caption.className = 'caption';
  const {classified, classes} = town.about.blockStyle;
  caption.textContent = classified ? texts.changeLegend : texts.heightLegend;
  const entries = document.createElement('ul');
  const add = (colour, label) => {
    const entry = document.createElement('li');
    const swatch = document.createElement('canvas');
    swatch.width = swatch.height = 1;
    swatch.getContext('2d').fillStyle = `rgb(${colour.join(',')})`;
    swatch.getContext('2d').fillRect(0, 0, 1, 1);
    const words = document.createElement('span');
    words.textContent = label;
    entry.append(swatch, words);
    entries.append(entry);
  };
  if (classified)
    classes.forEach(({colour, value}) => add(colour, className(value)));
  else
    town.about.classes.forEach(({colour}, i) => add(colour, classText(town.about.classes, i)));
  const {certainty, certain} = town.about.tierStyle;
  const values = town.fields.get(certainty)?.values ?? [];
  legend.open = window.matchMedia('(min-width: 761px) and (min-height: 620px)').matches;
  legend.append(caption, entries);
  if (!values.some((value) => value !== null && value < certain))
    return;
  const paler = document.createElement('p');
  paler.className = 'caption';
  paler.textContent = texts.paler;
  legend.append(paler);
}

export function showBuilding(town, building, onClose) {
  const card = byId('building');
  card.hidden = building < 0;
  if (building < 0)
    return;
  const {about} = town;
  const name = (field) => texts.fields[field.name] ?? field.alias.replace('(m2)', '(m²)').replace('(m3)', '(m³)');
  // Shows the median as well, because one height misleads where roofs lie at several.
  const median = town.value('p50', building), high = town.value('p90', building);
  const range = median !== null && high !== null && high - median > 5 ? `${spoken(median)} – ` : '';
  const value = ({name, values}) =>
      name === about.blockStyle.classified ? className(values[building]) : spoken(values[building]);
  const row = (field) => pair(name(field), (field.name === 'p90' ? range : '') + value(field), field.description);
  const head = document.createElement('h2');
  const close = document.createElement('button');
  head.append(`${texts.building} ${town.stack.id[building]}`, close);
  close.type = 'button';
  close.textContent = texts.close;
  close.addEventListener('click', onClose);
  const more = document.createElement('details');
  const summary = document.createElement('summary');
  summary.textContent = texts.allFields;
  more.append(summary, list(about.fields.filter(({name}) => !about.first.includes(name)).map(row)));
  const first = about.first.map((name) => town.fields.get(name)).filter((field) => field);
  card.replaceChildren(head, list(first.map(row)), more);
}
