// Buildings of a page and queries about them. Buildings, tiers and faces of roofs are identified by their list indices.
import {Colours} from './colours.js';
import {Place} from './place.js';

function covers(xs, ys, rings, x, y) {
  let inside = false;
  for (const [from, to] of rings)
    for (let i = from, j = to - 1; i < to; j = i++)
      if (ys[i] > y !== ys[j] > y && x < (xs[j] - xs[i]) * (y - ys[i]) / (ys[j] - ys[i]) + xs[i])
        inside = !inside;
  return inside;
}

export class Town {
  constructor({about, stack, relief}) {
    this.about = about;
    this.stack = stack;
    this.heights = relief;
    this.place = new Place(about.frame);
    this.colours = new Colours(about);
    this.levels = about.levels.length;
    // Roofs are shown at a level above all tiers.
    this.lastLevel = this.levels + (about.roofs.faces > 0 ? 1 : 0);
    this.x = stack.x.map((steps) => this.place.x(steps));
    this.y = stack.y.map((steps) => this.place.y(steps));
    this.faceX = stack.faceX.map((steps) => this.place.x(steps));
    this.faceY = stack.faceY.map((steps) => this.place.y(steps));
    this.faceZ = stack.faceZ.map((steps) => this.place.z(steps));
    this.fields = new Map(about.fields.map((field) => [field.name, field]));
    this.buildings = stack.id.length;
    this.isShown = new Uint8Array(this.buildings).fill(1);
    this.limits = [null, null];
    // Values of the field whose buildings are shown in turns, in the order of the data.
    this.alternatives = [...new Set(this.fields.get(about.alternatives)?.values ?? [])];
    this.alternative = this.alternatives.at(-1) ?? null;
    if (this.alternative !== null)
      this.filter();
    this.boxes = this.makeBoxes();
    this.extent = this.makeExtent();
  }

  value(field, building) { return this.fields.get(field)?.values[building] ?? null; }

  // Shows the buildings between two heights. @param low, high in metres; null for no limit
  showHeights(low, high) {
    this.limits = [low, high];
    this.filter();
  }

  // Shows the buildings of one of the alternatives.
  showAlternative(value) {
    this.alternative = value;
    this.filter();
  }

  filter() {
    const [low, high] = this.limits;
    for (let building = 0; building < this.buildings; ++building) {
      const height = this.value(this.about.blockStyle.colour, building);
      const isWithin = (low === null || height >= low) && (high === null || height <= high);
      this.isShown[building] = isWithin && this.isAlternative(building) ? 1 : 0;
    }
  }

  isAlternative(building) {
    return this.alternative === null || this.value(this.about.alternatives, building) === this.alternative;
  }

  shown() { return this.isShown.reduce((sum, one) => sum + one, 0); }

  // Number of buildings that heights are a choice of.
  all() {
    let sum = 0;
    for (let building = 0; building < this.buildings; ++building)
      sum += this.isAlternative(building) ? 1 : 0;
    return sum;
  }

  // Returns the building with a number, one that is shown if there are several; -1 if there is none.
  numbered(id) {
    const shown = this.stack.id.findIndex((one, building) => one === id && this.isShown[building]);
    return shown >= 0 ? shown : this.stack.id.indexOf(id);
  }

  base(building) { return this.place.z(this.stack.base[building]); }

  roof(building) { return this.place.z(this.stack.roof[building]); }

  top(tier) { return this.place.z(this.stack.top[tier]); }

  // Height of the bottom of a tier.
  foot(building, tier) {
    const parent = this.stack.parent[tier];
    return parent < 0 ? this.base(building) : this.top(parent);
  }

  tiersOf(building) { return [this.stack.tiersFrom[building], this.stack.tiersFrom[building + 1]]; }

  // Vertex ranges of the rings of a tier; the exterior comes first.
  ringsOf(tier) {
    const rings = [];
    for (let ring = this.stack.ringsFrom[tier]; ring < this.stack.ringsFrom[tier + 1]; ++ring)
      rings.push([this.stack.cornersFrom[ring], this.stack.cornersFrom[ring + 1]]);
    return rings;
  }

  facesOf(building) { return [this.stack.facesFrom[building], this.stack.facesFrom[building + 1]]; }

  // True if a building is shown with the faces of its roof at a level, otherwise with its tiers.
  showsRoof(building, level) {
    const [from, to] = this.facesOf(building);
    return level > this.levels && from < to;
  }

  // Vertex ranges of the rings of a face; the exterior comes first.
  ringsOfFace(face) {
    const rings = [];
    for (let ring = this.stack.faceRingsFrom[face]; ring < this.stack.faceRingsFrom[face + 1]; ++ring)
      rings.push([this.stack.faceCornersFrom[ring], this.stack.faceCornersFrom[ring + 1]]);
    return rings;
  }

  // Returns the normal of a face, of length 1 (Newell's method).
  normalOf(face) {
    const [[from, to]] = this.ringsOfFace(face);
    const normal = [0, 0, 0];
    for (let i = from, j = to - 1; i < to; j = i++) {
      normal[0] += (this.faceY[j] - this.faceY[i]) * (this.faceZ[j] + this.faceZ[i]);
      normal[1] += (this.faceZ[j] - this.faceZ[i]) * (this.faceX[j] + this.faceX[i]);
      normal[2] += (this.faceX[j] - this.faceX[i]) * (this.faceY[j] + this.faceY[i]);
    }
    const length = Math.hypot(...normal) || 1;
    return normal.map((part) => part / length);
  }

  // Colour of the building, lighter or darker as the face is turned to the north-west. A level face has the colour.
  faceColour(face, colour) {
    const [x, y, z] = this.normalOf(face);
    const light = 0.55 * ((y - x) / 2 + (z - 1) * Math.SQRT1_2);
    return colour.map((part) => Math.round(part + light * (light > 0 ? 255 - part : part)));
  }

  // Colour of the class of a building; null if colours are those of heights.
  classColour(building) {
    const {classified, classes} = this.about.blockStyle;
    const value = classified ? this.value(classified, building) : null;
    return classes.find((one) => one.value === value)?.colour ?? null;
  }

  blockColour(building) {
    const {colour, certainty, certain} = this.about.blockStyle;
    const ofClass = this.classColour(building);
    if (ofClass)
      return ofClass;
    return this.colours.of(this.value(colour, building), this.value(certainty, building), certain);
  }

  tierColour(building, tier) {
    const {certainty, certain} = this.about.tierStyle;
    const ofClass = this.classColour(building);
    if (ofClass)
      return ofClass;
    const height = (this.stack.top[tier] - this.stack.base[building]) / 1000;
    return this.colours.of(height, this.value(certainty, building), certain);
  }

  // Highest vertex of the roof's faces; -Infinity without any.
  highest(building) {
    const [from, to] = this.facesOf(building).map((face) => this.stack.faceCornersFrom[this.stack.faceRingsFrom[face]]);
    return this.faceZ.subarray(from, to).reduce((most, z) => Math.max(most, z), -Infinity);
  }

  // Bounding box of footprints and heights: west, south, east, north, top.
  makeBoxes() {
    const boxes = new Float32Array(5 * this.buildings);
    for (let building = 0; building < this.buildings; ++building) {
      const box = [Infinity, Infinity, -Infinity, -Infinity, this.roof(building)];
      const [from, to] = this.tiersOf(building);
      for (let tier = from; tier < to; ++tier) {
        box[4] = Math.max(box[4], this.top(tier), this.highest(building));
        if (this.stack.parent[tier] >= 0)
          continue;
        const [first, end] = this.ringsOf(tier)[0];
        for (let i = first; i < end; ++i) {
          box[0] = Math.min(box[0], this.x[i]);
          box[1] = Math.min(box[1], this.y[i]);
          box[2] = Math.max(box[2], this.x[i]);
          box[3] = Math.max(box[3], this.y[i]);
        }
      }
      boxes.set(box, 5 * building);
    }
    return boxes;
  }

  // West, south, east and north of the window.
  makeExtent() {
    const xs = this.about.frame.corners.map(([x]) => x);
    const ys = this.about.frame.corners.map(([, y]) => y);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }

  boxOf(building) { return this.boxes.subarray(5 * building, 5 * building + 5); }

  // Returns true if a tier covers a position.
  holds(tier, x, y) { return covers(this.x, this.y, this.ringsOf(tier), x, y); }

  // Returns true if a face of a roof covers a position.
  faceHolds(face, x, y) { return covers(this.faceX, this.faceY, this.ringsOfFace(face), x, y); }
}
