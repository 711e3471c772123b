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

// Adds a wall below an edge. @param a, b x, y and z; the interior is on the left from a to b
function addWall(prisms, a, b, foot, colour) {
  const shade = wallShade(b[0] - a[0], b[1] - a[1]);
  const first = prisms.corners;
  prisms.add(a[0], a[1], foot, colour, shade);
  prisms.add(b[0], b[1], foot, colour, shade);
  prisms.add(...b, colour, shade);
  prisms.add(...a, colour, shade);
  prisms.indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
}

// Adds walls around a ring whose interior is on its left.
export function addWalls(prisms, town, [from, to], foot, top, colour) {
  for (let i = from; i < to; ++i) {
    const j = i + 1 < to ? i + 1 : from;
    addWall(prisms, [town.x[i], town.y[i], top], [town.x[j], town.y[j], top], foot, colour);
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

// Adds a roof of slanted faces with the walls below it. Two faces that meet in an edge at equal heights have no wall
// between them.
function addFaces(prisms, town, building, colour) {
  const key = (i, j) => [i, j].map((at) => `${town.faceX[at]} ${town.faceY[at]} ${town.faceZ[at]}`).join(' ');
  const [from, to] = town.facesOf(building);
  const edges = new Map();
  for (let face = from; face < to; ++face) {
    const rings = town.ringsOfFace(face);
    const shaded = town.faceColour(face, colour);
    const first = prisms.corners;
    const points = rings.map(([begin, end]) => {
      const ring = [];
      const start = prisms.corners;
      for (let i = begin; i < end; ++i) {
        const next = i + 1 < end ? i + 1 : begin;
        ring.push(new Vector2(town.faceX[i], town.faceY[i]));
        prisms.add(town.faceX[i], town.faceY[i], town.faceZ[i], shaded);
        prisms.lines.push(start + i - begin, start + next - begin);
        edges.set(key(i, next), [i, next]);
      }
      return ring;
    });
    for (const [a, b, c] of ShapeUtils.triangulateShape(points[0], points.slice(1)))
      prisms.indices.push(first + a, first + b, first + c);
  }
  const foot = town.base(building);
  for (const [i, j] of edges.values())
    if (!edges.has(key(j, i)))
      addWall(
          prisms, [town.faceX[i], town.faceY[i], town.faceZ[i]], [town.faceX[j], town.faceY[j], town.faceZ[j]], foot,
          colour);
}

// Adds a building as it is shown at a level. @param colour without it, the building's own
export function addBuilding(prisms, town, building, level, colour = null) {
  if (town.showsRoof(building, level)) {
    addFaces(prisms, town, building, colour ?? town.blockColour(building));
    return;
  }
  const [from, to] = town.tiersOf(building);
  for (let tier = from; tier < to; ++tier)
    if (town.stack.level[tier] <= level)
      addPrism(
          prisms, town, tier, town.foot(building, tier), town.top(tier), colour ?? town.tierColour(building, tier));
}

// Adds slanted roofs, and stacks where there are none.
export function roofs(town, buildings) {
  const prisms = new Prisms();
  for (const building of buildings)
    addBuilding(prisms, town, building, town.lastLevel);
  return prisms;
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
