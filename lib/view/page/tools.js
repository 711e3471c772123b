// Cards that open on request: search and filter, sun, and measure.
import {sunDirection} from './sun.js';
import {locale, texts} from './texts.js';

const byId = (id) => document.getElementById(id);
const number = (value, digits) => value.toLocaleString(locale, {maximumFractionDigits: digits});

// A button that opens and closes a card. @param onToggle receives whether it is open
function opens(button, card, onToggle = () => {}) {
  byId(button).addEventListener('click', () => {
    byId(card).hidden = !byId(card).hidden;
    byId(button).setAttribute('aria-expanded', String(!byId(card).hidden));
    onToggle(!byId(card).hidden);
  });
}

// Search by number or parcel, and filter by height.
export class Finder {
  // @param onFind receives a building @param onFilter is called when other buildings are shown
  constructor(town, onFind, onFilter) {
    Object.assign(this, {town, onFilter});
    opens('tofind', 'find');
    byId('findtext').addEventListener('change', () => {
      const building = this.find(byId('findtext').value.trim());
      byId('findnone').hidden = building >= 0 || byId('findtext').value.trim() === '';
      if (building >= 0)
        onFind(building);
    });
    for (const id of ['lowest', 'highest'])
      byId(id).addEventListener('change', () => this.filter(...this.heights()));
  }

  // Returns the building of that number, or else the first whose parcel is named so; -1 if there is none.
  find(text) {
    const byNumber = /^[0-9]+$/.test(text) ? this.town.numbered(Number(text)) : -1;
    const parcels = this.town.fields.get('parcel')?.values ?? [];
    return byNumber >= 0 || text === '' ? byNumber : parcels.findIndex((parcel) => String(parcel) === text);
  }

  heights() { return ['lowest', 'highest'].map((id) => byId(id).value === '' ? null : Number(byId(id).value)); }

  // @param low, high in metres; null for no limit
  filter(low, high) {
    [byId('lowest').value, byId('highest').value] = [low ?? '', high ?? ''];
    this.town.showHeights(low, high);
    this.onFilter();
  }
}

// Slider of the hour, and choice of a day.
export class SunCard {
  // @param onSun receives the direction to the sun, or null
  constructor(town, onSun) {
    Object.assign(this, {town, onSun});
    const {position} = town.about;
    byId('tosun').hidden = !position;
    if (!position)
      return;
    for (const [i, day] of texts.days.entries())
      byId('day').append(new Option(day, i, i === 1, i === 1));
    opens('tosun', 'sun', () => this.tell());
    byId('day').addEventListener('change', () => this.tell());
    byId('hour').addEventListener('input', () => this.tell());
  }

  // Returns the day and the hour; null if the card is closed.
  chosen() { return byId('sun').hidden ? null : [Number(byId('day').value), Number(byId('hour').value)]; }

  choose(day, hour) {
    [byId('day').value, byId('hour').value] = [day, hour];
    byId('sun').hidden = false;
    byId('tosun').setAttribute('aria-expanded', 'true');
    this.tell();
  }

  tell() {
    const chosen = this.chosen();
    if (chosen === null)
      return this.onSun(null);
    const [day, hour] = chosen;
    const direction = sunDirection(this.town.about.position[0], day, hour);
    const height = Math.round(Math.asin(direction[2]) * 180 / Math.PI);
    const minutes = String(Math.round(hour % 1 * 60)).padStart(2, '0');
    byId('suntime').textContent = texts.sunTime(`${Math.floor(hour)}:${minutes}`);
    byId('sunheight').textContent = direction[2] > 0 ? texts.sunHeight(height) : texts.sunDown;
    return this.onSun(direction);
  }
}

// Lengths between points that the user clicks.
export class Measure {
  // @param onChange receives the points: lists of x, y and z in metres
  constructor(onChange) {
    this.onChange = onChange;
    this.points = [];
    opens('tomeasure', 'measured', () => this.clear());
  }

  isOn() { return !byId('measured').hidden; }

  clear() {
    this.points = [];
    this.tell();
  }

  add(point) {
    this.points.push(point);
    this.tell();
  }

  tell() {
    let length = 0;
    for (let i = 1; i < this.points.length; ++i)
      length += Math.hypot(this.points[i][0] - this.points[i - 1][0], this.points[i][1] - this.points[i - 1][1]);
    const rises = this.points.length > 1 && this.points.every(([, , z]) => Number.isFinite(z));
    const rise = rises ? Math.abs(this.points.at(-1)[2] - this.points[0][2]) : 0;
    byId('measuretext').textContent = this.points.length < 2 ?
        texts.measureHelp :
        texts.measured(number(length, 1), rise >= 0.05 ? number(rise, 1) : '');
    this.onChange(this.points);
  }
}
