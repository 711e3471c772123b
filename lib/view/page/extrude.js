// Extrudes polygons to prisms: triangulated roofs and vertical walls. Light from the north-west is baked into the
// vertex colours, so neither normals nor lights are needed and roofs keep the colours of the legend.
import {ShapeUtils, Vector2} from 'three';

// Growing arrays for the buffers of a mesh. Scenes have y up and z to the south.
export class Prisms {
  constructor() {
    this.positions = [];
    this.colours = [];
    this.indices = [];
    this.lines = [];
  }

  get corners() { return this.positions.length / 3; }

  add(x, y, z, colour, share = 1) {
    this.positions.push(x, z, -y);
    this.colours.push(colour[0] * share, colour[1] * share, colour[2] * share);
  }
}

function wallShade(dx, dy) {
  const length = Math.hypot(dx, dy) || 1;
  return 0.74 - 0.16 * (dy + dx) / length / Math.SQRT2;
}

// Adds walls around a ring whose interior is on its left.
export function addWalls(prisms, town, [from, to], foot, top, colour) {
  for (let i = from; i < to; ++i) {
    const j = i + 1 < to ? i + 1 : from;
    const shade = wallShade(town.x[j] - town.x[i], town.y[j] - town.y[i]);
    const first = prisms.corners;
    prisms.add(town.x[i], town.y[i], foot, colour, shade);
    prisms.add(town.x[j], town.y[j], foot, colour, shade);
    prisms.add(town.x[j], town.y[j], top, colour, shade);
    prisms.add(town.x[i], town.y[i], top, colour, shade);
    prisms.indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
}

function addRoof(prisms, town, rings, top, colour) {
  const points = rings.map(([from, to]) => {
    const ring = [];
    for (let i = from; i < to; ++i)
      ring.push(new Vector2(town.x[i], town.y[i]));
    return ring;
  });
  const first = prisms.corners;
  let begin = first;
  for (const ring of points) {
    ring.forEach((point, i) => {
      prisms.add(point.x, point.y, top, colour);
      prisms.lines.push(begin + i, begin + (i + 1) % ring.length);
    });
    begin += ring.length;
  }
  for (const [a, b, c] of ShapeUtils.triangulateShape(points[0], points.slice(1)))
    prisms.indices.push(first + a, first + b, first + c);
}

export function addPrism(prisms, town, tier, foot, top, colour) {
  const rings = town.ringsOf(tier);
  for (const ring of rings)
    addWalls(prisms, town, ring, foot, top, colour);
  addRoof(prisms, town, rings, top, colour);
}

// Adds each building as one block with a flat roof.
export function blocks(town, buildings) {
  const prisms = new Prisms();
  for (const building of buildings) {
    const [from, to] = town.tiersOf(building);
    for (let tier = from; tier < to; ++tier)
      if (town.stack.parent[tier] < 0)
        addPrism(prisms, town, tier, town.base(building), town.roof(building), town.blockColour(building));
  }
  return prisms;
}

// Adds the stacks, low levels first; `ends` has the end of each level in the indices and lines.
export function stacks(town, buildings) {
  const tiers = [];
  for (const building of buildings) {
    const [from, to] = town.tiersOf(building);
    for (let tier = from; tier < to; ++tier)
      tiers.push([tier, building]);
  }
  tiers.sort(([a], [b]) => town.stack.level[a] - town.stack.level[b] || a - b);
  const prisms = new Prisms();
  const ends = new Array(town.levels + 1).fill(null);
  ends[0] = [0, 0];
  for (const [tier, building] of tiers) {
    addPrism(prisms, town, tier, town.foot(building, tier), town.top(tier), town.tierColour(building, tier));
    ends[town.stack.level[tier]] = [prisms.indices.length, prisms.lines.length];
  }
  for (let level = 1; level < ends.length; ++level)
    ends[level] ??= ends[level - 1];
  return {prisms, ends};
}

// Adds foundations of buildings on a slope, down to the ground.
export function foundations(town, relief, buildings) {
  const prisms = new Prisms();
  for (const building of buildings) {
    const [from, to] = town.tiersOf(building);
    for (let tier = from; tier < to; ++tier) {
      if (town.stack.parent[tier] >= 0)
        continue;
      const rings = town.ringsOf(tier);
      const base = town.base(building);
      let lowest = base;
      for (const [first, end] of rings)
        for (let i = first; i < end; ++i) {
          const ground = relief.near(town.x[i], town.y[i]);
          if (ground < lowest)
            lowest = ground;
        }
      if (lowest < base)
        for (const ring of rings)
          addWalls(prisms, town, ring, lowest, base, [150, 146, 140]);
    }
  }
  return prisms;
}
