// Map of the buildings from above, north up: used for printing and without WebGL.
import {chosen, edge} from './colours.js';

const paper = {
  light: '#f4f4f1',
  dark: '#14171b'
};
const ink = {
  light: '#232323',
  dark: '#ececea'
};
const text = (colour, opacity = 1) => `rgba(${colour.join(',')},${opacity})`;

export class FlatMap {
  // @param room returns the free part of the window: left, top, right, bottom @param onPick receives the
  // position of a click in metres
  constructor(town, relief, canvas, room, onPick) {
    Object.assign(this, {town, relief, canvas, room, onPick});
    this.pen = canvas.getContext('2d');
    this.level = town.lastLevel;
    this.theme = 'light';
    this.mark = -1;
    this.line = [];
    this.middle = [0, 0];
    this.scale = 1;  // pixels per metre
    this.fingers = new Map();
    this.watch();
  }

  // Fits everything into the part that is free of panels; there are none on paper.
  home() {
    const {width, height} = this.canvas;
    const [left, top, right, bottom] =
        this.isPaper ? [0, 0, width, height] : this.room().map((pixels) => pixels * this.ratio);
    const [west, south, east, north] = this.town.extent;
    this.scale = Math.min((right - left) / Math.max(1, east - west), (bottom - top) / Math.max(1, north - south));
    this.middle = [
      (west + east) / 2 - ((left + right) / 2 - width / 2) / this.scale,
      (south + north) / 2 + ((top + bottom) / 2 - height / 2) / this.scale
    ];
    this.isHome = true;
    this.ask();
  }

  setTheme(theme) {
    this.theme = theme;
    this.ground = this.relief.image(theme);
    this.ask();
  }

  setLevel(level) {
    this.level = level;
    this.ask();
  }

  choose(building) {
    this.mark = building;
    this.ask();
  }

  toPixels(x, y) {
    return [
      this.canvas.width / 2 + (x - this.middle[0]) * this.scale,
      this.canvas.height / 2 - (y - this.middle[1]) * this.scale
    ];
  }

  toMetres(px, py) {
    return [
      this.middle[0] + (px - this.canvas.width / 2) / this.scale,
      this.middle[1] - (py - this.canvas.height / 2) / this.scale
    ];
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    const ratio = Math.min(2, window.devicePixelRatio);
    this.setSize(Math.round(width * ratio), Math.round(height * ratio), ratio);
    if (this.isHome)
      this.home();
  }

  // @param ratio canvas pixels per CSS pixel
  setSize(width, height, ratio) {
    this.ratio = ratio;
    const factor = this.canvas.width > 0 ? Math.min(width / this.canvas.width, height / this.canvas.height) : 1;
    [this.canvas.width, this.canvas.height] = [width, height];
    this.scale *= factor;
    this.ask();
  }

  ask() {
    if (this.asked || this.canvas.hidden)
      return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
      document.documentElement.dataset.ready = 'yes';
    });
  }

  draw() {
    const {pen, canvas} = this;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = this.isPaper ? '#fff' : paper[this.theme];
    pen.fillRect(0, 0, canvas.width, canvas.height);
    this.drawGround();
    this.drawBuildings();
    this.drawPoints();
    this.drawScale();
  }

  // @param points x and y in metres
  drawLine(points) {
    this.line = points;
    this.ask();
  }

  drawPoints() {
    const {pen, ratio} = this;
    pen.strokeStyle = pen.fillStyle = text(chosen);
    pen.lineWidth = 2 * ratio;
    pen.beginPath();
    for (const [x, y] of this.line)
      pen.lineTo(...this.toPixels(x, y));
    pen.stroke();
    for (const [x, y] of this.line) {
      const [px, py] = this.toPixels(x, y);
      pen.fillRect(px - 3 * ratio, py - 3 * ratio, 6 * ratio, 6 * ratio);
    }
  }

  // Shows other buildings.
  filter() { this.ask(); }

  goTo(building) {
    const [west, south, east, north] = this.town.boxOf(building);
    this.isHome = false;
    this.middle = [(west + east) / 2, (south + north) / 2];
    this.scale = Math.max(this.scale, Math.min(this.canvas.width, this.canvas.height) / 300);
    this.ask();
  }

  // Returns the middle and the width in metres for a link.
  place() { return {middle: [...this.middle, this.canvas.width / this.scale]}; }

  setPlace({middle: [x, y, width]}) {
    this.isHome = false;
    this.middle = [x, y];
    this.scale = this.canvas.width / Math.max(1, width);
    this.ask();
  }

  drawGround() {
    const {rows, cols, down, across} = this.relief;
    const at = (row, col) => this.toPixels(...this.town.place.inWindow(row, col));
    const [x0, y0] = at(0, 0);
    const [x1, y1] = at(0, across);
    const [x2, y2] = at(down, 0);
    this.pen.save();
    this.pen.setTransform(x1 - x0, y1 - y0, x2 - x0, y2 - y0, x0, y0);
    this.pen.drawImage(this.ground, 0, 0, cols, rows);
    this.pen.restore();
  }

  // Draws the visible part, low levels first.
  drawBuildings() {
    const [west, north] = this.toMetres(0, 0);
    const [east, south] = this.toMetres(this.canvas.width, this.canvas.height);
    const levels = [];
    const roofs = [];
    for (let building = 0; building < this.town.buildings; ++building) {
      const box = this.town.boxOf(building);
      if (!this.town.isShown[building] || box[2] < west || box[0] > east || box[3] < south || box[1] > north)
        continue;
      if (this.town.showsRoof(building, this.level)) {
        roofs.push(building);
        continue;
      }
      const [from, to] = this.town.tiersOf(building);
      for (let tier = from; tier < to; ++tier)
        if (this.town.stack.level[tier] <= this.level)
          (levels[this.town.stack.level[tier]] ??= []).push([tier, building]);
    }
    this.pen.lineJoin = 'round';
    this.pen.lineWidth = Math.min(1.4, Math.max(0.3, 0.35 * this.scale));
    this.pen.strokeStyle = text(edge, 0.8);
    for (const level of levels)
      for (const [tier, building] of level ?? [])
        this.drawTier(tier, building === this.mark ? chosen : this.town.tierColour(building, tier));
    for (const building of roofs)
      this.drawRoof(building, building === this.mark ? chosen : this.town.blockColour(building));
  }

  drawTier(tier, colour) { this.drawRings(this.town.x, this.town.y, this.town.ringsOf(tier), colour); }

  drawRoof(building, colour) {
    const {town} = this;
    const [from, to] = town.facesOf(building);
    for (let face = from; face < to; ++face)
      this.drawRings(town.faceX, town.faceY, town.ringsOfFace(face), town.faceColour(face, colour));
  }

  drawRings(x, y, rings, colour) {
    const {pen} = this;
    pen.beginPath();
    for (const [from, to] of rings) {
      // moveTo() is needed because closePath() leaves the pen at the previous ring.
      pen.moveTo(...this.toPixels(x[from], y[from]));
      for (let i = from + 1; i < to; ++i)
        pen.lineTo(...this.toPixels(x[i], y[i]));
      pen.closePath();
    }
    pen.fillStyle = text(colour);
    pen.fill('evenodd');
    pen.stroke();
  }

  // Draws a scale bar of 1, 2 or 5 times a power of ten in the upper right corner, below a north arrow.
  drawScale() {
    const {pen, canvas} = this;
    const {ratio} = this;
    const most = 140 * ratio / this.scale;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((n) => n * power).find((n) => n <= most);
    const free = this.isPaper ? 12 : this.room()[1];
    const [right, top] = [canvas.width - 16 * ratio, (free + 4) * ratio];
    pen.strokeStyle = pen.fillStyle = ink[this.theme];
    pen.lineWidth = 1.5 * ratio;
    pen.font = `${12 * ratio}px system-ui, sans-serif`;
    pen.textAlign = 'right';
    pen.beginPath();
    pen.moveTo(right - length * this.scale, top + 44 * ratio);
    pen.lineTo(right - length * this.scale, top + 50 * ratio);
    pen.lineTo(right, top + 50 * ratio);
    pen.lineTo(right, top + 44 * ratio);
    pen.stroke();
    pen.fillText(length >= 1000 ? `${length / 1000} km` : `${length} m`, right, top + 66 * ratio);
    pen.beginPath();
    pen.moveTo(right - 8 * ratio, top);
    pen.lineTo(right - 2 * ratio, top + 18 * ratio);
    pen.lineTo(right - 8 * ratio, top + 13 * ratio);
    pen.lineTo(right - 14 * ratio, top + 18 * ratio);
    pen.fill();
    pen.textAlign = 'center';
    pen.fillText('N', right - 8 * ratio, top + 32 * ratio);
  }

  // Pans by fractions of the view.
  move(right, up) {
    this.isHome = false;
    this.middle[0] += right * this.canvas.width / this.scale;
    this.middle[1] += up * this.canvas.width / this.scale;
    this.ask();
  }

  // @param about pixel that stays in place
  zoom(factor, about = [this.canvas.width / 2, this.canvas.height / 2]) {
    this.isHome = false;
    const [x, y] = this.toMetres(...about);
    this.scale /= factor;
    const [to, down] = this.toMetres(...about);
    this.middle[0] += x - to;
    this.middle[1] += y - down;
    this.ask();
  }

  pixelsOf(event) {
    const box = this.canvas.getBoundingClientRect();
    const ratio = this.canvas.width / box.width;
    return [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio];
  }

  watch() {
    const {canvas, fingers} = this;
    let moved = 0;
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY / 500), this.pixelsOf(event));
    }, {passive: false});
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      if (fingers.size === 0)
        moved = 0;
      fingers.set(event.pointerId, this.pixelsOf(event));
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!fingers.has(event.pointerId))
        return;
      const old = [...fingers.values()];
      const before = fingers.get(event.pointerId);
      fingers.set(event.pointerId, this.pixelsOf(event));
      const now = [...fingers.values()];
      moved += Math.hypot(now[0][0] - old[0][0], now[0][1] - old[0][1]);
      if (now.length === 2) {
        const apart = ([a, b]) => Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]));
        moved = Infinity;
        this.zoom(apart(old) / apart(now), now[0].map((part, i) => (part + now[1][i]) / 2));
      }
      const spot = fingers.get(event.pointerId);
      this.isHome = this.isHome && moved < 5;
      this.middle[0] -= (spot[0] - before[0]) / this.scale / now.length;
      this.middle[1] += (spot[1] - before[1]) / this.scale / now.length;
      this.ask();
    });
    const end = (event) => {
      const spot = fingers.get(event.pointerId);
      fingers.delete(event.pointerId);
      if (event.type === 'pointerup' && spot && moved < 5)
        this.onPick(...this.toMetres(...spot));
    };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
  }
}
