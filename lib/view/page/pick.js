// Picks the building in a direction by intersecting its prisms, independent of the drawn meshes.

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

// Returns the ray parameter of the roof or the nearest wall of a tier; Infinity if the ray misses both.
function tierBegins(town, building, tier, origin, direction) {
  const [foot, top] = [town.foot(building, tier), town.top(tier)];
  let best = Infinity;
  const roof = (top - origin[2]) / direction[2];
  if (roof > 0 && town.holds(tier, origin[0] + roof * direction[0], origin[1] + roof * direction[1]))
    best = roof;
  for (const [from, to] of town.ringsOf(tier))
    for (let i = from, j = to - 1; i < to; j = i++) {
      const [ex, ey] = [town.x[j] - town.x[i], town.y[j] - town.y[i]];
      const [ox, oy] = [town.x[i] - origin[0], town.y[i] - origin[1]];
      const det = direction[0] * ey - direction[1] * ex;
      const along = (ox * ey - oy * ex) / det;
      const share = (ox * direction[1] - oy * direction[0]) / det;
      const z = origin[2] + along * direction[2];
      if (along > 0 && along < best && share >= 0 && share <= 1 && z >= foot && z <= top)
        best = along;
    }
  return best;
}

// Returns the first shown building on a ray, using tiers up to a level, and the ray parameter; -1 and Infinity if there
// is none.
export function hitOnRay(town, origin, direction, level) {
  let best = Infinity;
  let found = -1;
  for (let building = 0; building < town.buildings; ++building) {
    if (!town.isShown[building] || !(boxBegins(town.boxOf(building), town.base(building), origin, direction) < best))
      continue;
    const [from, to] = town.tiersOf(building);
    for (let tier = from; tier < to; ++tier) {
      const begins = town.stack.level[tier] <= level ? tierBegins(town, building, tier, origin, direction) : Infinity;
      if (begins < best)
        [best, found] = [begins, building];
    }
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
