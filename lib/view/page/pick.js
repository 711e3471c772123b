// Picks the building in a direction by intersecting its prisms or the faces of its roof, independent of the drawn
// meshes.

// Returns the ray parameter at which a box begins; Infinity if the ray misses it.
function boxBegins([west, south, east, north, top], bottom, origin, direction) {
  let near = 0;
  let far = Infinity;
  const sides = [[west, east], [south, north], [bottom, top]];
  for (let axis = 0; axis < 3; ++axis) {
    const a = (sides[axis][0] - origin[axis]) / direction[axis];
    const b = (sides[axis][1] - origin[axis]) / direction[axis];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far ? near : Infinity;
}

// Returns the ray parameter of the nearest wall below rings; Infinity if the ray misses all.
// @param corner returns x, y and z of a vertex
function wallsBegin(rings, corner, foot, origin, direction) {
  let best = Infinity;
  for (const [from, to] of rings)
    for (let i = from, j = to - 1; i < to; j = i++) {
      const [a, b] = [corner(i), corner(j)];
      const [ex, ey] = [b[0] - a[0], b[1] - a[1]];
      const [ox, oy] = [a[0] - origin[0], a[1] - origin[1]];
      const det = direction[0] * ey - direction[1] * ex;
      const along = (ox * ey - oy * ex) / det;
      const share = (ox * direction[1] - oy * direction[0]) / det;
      const z = origin[2] + along * direction[2];
      if (along > 0 && along < best && share >= 0 && share <= 1 && z >= foot && z <= a[2] + share * (b[2] - a[2]))
        best = along;
    }
  return best;
}

// Returns the ray parameter of the roof or the nearest wall of a tier; Infinity if the ray misses both.
function tierBegins(town, building, tier, origin, direction) {
  const top = town.top(tier);
  const corner = (i) => [town.x[i], town.y[i], top];
  const walls = wallsBegin(town.ringsOf(tier), corner, town.foot(building, tier), origin, direction);
  const roof = (top - origin[2]) / direction[2];
  const isHit = roof > 0 && town.holds(tier, origin[0] + roof * direction[0], origin[1] + roof * direction[1]);
  return isHit ? Math.min(roof, walls) : walls;
}

// Returns the ray parameter of a face of a roof or of a wall below it; Infinity if the ray misses both.
function faceBegins(town, building, face, origin, direction) {
  const corner = (i) => [town.faceX[i], town.faceY[i], town.faceZ[i]];
  const rings = town.ringsOfFace(face);
  const walls = wallsBegin(rings, corner, town.base(building), origin, direction);
  const normal = town.normalOf(face);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const roof = dot(normal, corner(rings[0][0]).map((part, axis) => part - origin[axis])) / dot(normal, direction);
  const isHit = roof > 0 && town.faceHolds(face, origin[0] + roof * direction[0], origin[1] + roof * direction[1]);
  return isHit ? Math.min(roof, walls) : walls;
}

// Returns the ray parameters of the parts of a building that are shown at a level.
function partsBegin(town, building, origin, direction, level) {
  const isRoof = town.showsRoof(building, level);
  const [from, to] = isRoof ? town.facesOf(building) : town.tiersOf(building);
  const begins = [];
  for (let part = from; part < to; ++part)
    if (isRoof)
      begins.push(faceBegins(town, building, part, origin, direction));
    else if (town.stack.level[part] <= level)
      begins.push(tierBegins(town, building, part, origin, direction));
  return begins;
}

// Returns the first shown building that a ray hits at a level, and the ray parameter; -1 and Infinity if
// there is none.
export function hitOnRay(town, origin, direction, level) {
  let best = Infinity;
  let found = -1;
  for (let building = 0; building < town.buildings; ++building) {
    if (!town.isShown[building] || !(boxBegins(town.boxOf(building), town.base(building), origin, direction) < best))
      continue;
    for (const begins of partsBegin(town, building, origin, direction, level))
      if (begins < best)
        [best, found] = [begins, building];
  }
  return {building: found, along: best};
}

// Returns the shown building that covers a position on the map; -1 if there is none.
export function buildingAt(town, x, y) {
  for (let building = 0; building < town.buildings; ++building) {
    const [west, south, east, north] = town.boxOf(building);
    if (!town.isShown[building] || x < west || x > east || y < south || y > north)
      continue;
    const [from, to] = town.tiersOf(building);
    for (let tier = from; tier < to; ++tier)
      if (town.holds(tier, x, y))
        return building;
  }
  return -1;
}
