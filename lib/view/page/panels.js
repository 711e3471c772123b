// Panels next to the picture. Names come from files, so they are inserted as text, never as HTML.

const byId = (id) => document.getElementById(id);
const number = (value, digits) => value.toLocaleString('en', {maximumFractionDigits: digits});

function spoken(value) {
  if (value === null || value === undefined)
    return 'not known';
  if (typeof value !== 'number')
    return value;
  return number(value, Math.abs(value) >= 1000 ? 0 : Math.abs(value) >= 100 ? 1 : 2);
}

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
  const {buildings, crs} = town.about;
  byId('sum').textContent = `${number(buildings, 0)} building${buildings === 1 ? '' : 's'}${crs ? `\n${crs}` : ''}`;
}

export function showSource(town) {
  const items = Object.entries(town.about.metadata ?? {}).map(([name, value]) => pair(name, value));
  byId('source').append(...items);
}

export function showLevel(town, level) {
  const counts = town.about.levels[level - 1];
  byId('leveltext').textContent = town.levels === 0 ? 'none' : `1 to ${level} of ${town.levels}`;
  byId('contours').textContent = counts ? number(counts.contours, 0) : '0';
  byId('corners').textContent = counts ? number(counts.corners, 0) : '0';
  byId('rmse').textContent = counts && counts.rmse !== null ? `${counts.rmse.toFixed(2)} m` : 'not known';
}

// Open if there is space.
export function showLegend(town) {
  const legend = byId('legend');
  const caption = document.createElement('p');
  caption.className = 'caption';
  caption.textContent = town.about.tierStyle.title;
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
  for (const {colour, label} of town.about.classes)
    add(colour, label);
  const {certainty, certain} = town.about.tierStyle;
  const values = town.fields.get(certainty)?.values ?? [];
  legend.open = window.matchMedia('(min-width: 761px) and (min-height: 620px)').matches;
  legend.append(caption, entries);
  if (!values.some((value) => value !== null && value < certain))
    return;
  const paler = document.createElement('p');
  paler.className = 'caption';
  paler.textContent = 'Paler: not certain to be a building';
  legend.append(paler);
}

export function showBuilding(town, building, onClose) {
  const card = byId('building');
  card.hidden = building < 0;
  if (building < 0)
    return;
  const {about} = town;
  const row = (field) => pair(
      field.alias.replace('(m2)', '(m²)').replace('(m3)', '(m³)'), spoken(field.values[building]), field.description);
  const head = document.createElement('h2');
  const close = document.createElement('button');
  head.append(`Building ${town.stack.id[building]}`, close);
  close.type = 'button';
  close.textContent = 'Close';
  close.addEventListener('click', onClose);
  const more = document.createElement('details');
  const summary = document.createElement('summary');
  summary.textContent = 'All fields';
  more.append(summary, list(about.fields.filter(({name}) => !about.first.includes(name)).map(row)));
  const first = about.first.map((name) => town.fields.get(name)).filter((field) => field);
  card.replaceChildren(head, list(first.map(row)), more);
}
