// Buildings of a page and queries about them. Buildings and tiers are identified by their list indices.
import {Colours} from './colours.js';
import {Place} from './place.js';

export class Town {
  constructor({about, stack, relief}) {
    this.about = about;
    this.stack = stack;
    this.heights = relief;
    this.place = new Place(about.frame);
    this.colours = new Colours(about);
    this.levels = about.levels.length;
    this.x = stack.x.map((steps) => this.place.x(steps));
    this.y = stack.y.map((steps) => this.place.y(steps));
    this.fields = new Map(about.fields.map((field) => [field.name, field]));
    this.buildings = stack.id.length;
    this.isShown = new Uint8Array(this.buildings).fill(1);
    this.boxes = this.makeBoxes();
    this.extent = this.makeExtent();
  }

  value(field, building) { return this.fields.get(field)?.values[building] ?? null; }

  // Shows the buildings between two heights. @param low, high in metres; null for no limit
  showHeights(low, high) {
    for (let building = 0; building < this.buildings; ++building) {
      const height = this.value(this.about.blockStyle.colour, building);
      this.isShown[building] = (low === null || height >= low) && (high === null || height <= high) ? 1 : 0;
    }
  }

  shown() { return this.isShown.reduce((sum, one) => sum + one, 0); }

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

  blockColour(building) {
    const {colour, certainty, certain} = this.about.blockStyle;
    return this.colours.of(this.value(colour, building), this.value(certainty, building), certain);
  }

  tierColour(building, tier) {
    const {certainty, certain} = this.about.tierStyle;
    const height = (this.stack.top[tier] - this.stack.base[building]) / 1000;
    return this.colours.of(height, this.value(certainty, building), certain);
  }

  // Bounding box of footprints and heights: west, south, east, north, top.
  makeBoxes() {
    const boxes = new Float32Array(5 * this.buildings);
    for (let building = 0; building < this.buildings; ++building) {
      const box = [Infinity, Infinity, -Infinity, -Infinity, this.roof(building)];
      const [from, to] = this.tiersOf(building);
      for (let tier = from; tier < to; ++tier) {
        box[4] = Math.max(box[4], this.top(tier));
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
  holds(tier, x, y) {
    let inside = false;
    for (const [from, to] of this.ringsOf(tier))
      for (let i = from, j = to - 1; i < to; j = i++)
        if (this.y[i] > y !== this.y[j] > y &&
            x < (this.x[j] - this.x[i]) * (y - this.y[i]) / (this.y[j] - this.y[i]) + this.x[i])
          inside = !inside;
    return inside;
  }
}
