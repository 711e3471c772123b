// Finds the camera position from which all points fill a part of the picture.
import * as THREE from 'three';

// Corners of the window on the ground and of the tops of the bounding boxes.
function pointsOf(town, relief) {
  const points = [];
  for (const [x, y] of town.about.frame.corners) {
    const z = relief.near(x, y);
    points.push(new THREE.Vector3(x, Number.isNaN(z) ? relief.lowest() : z, -y));
  }
  for (let building = 0; building < town.buildings; ++building) {
    const [west, south, east, north, top] = town.boxOf(building);
    for (const [x, y] of [[west, south], [west, north], [east, south], [east, north]])
      points.push(new THREE.Vector3(x, top, -y));
  }
  return points;
}

// Returns the distance back and aside at which the camera has all points between two sides of its frustum.
// @param share half of the width at distance 1
function between(places, depths, share) {
  let [more, less] = [-Infinity, -Infinity];
  places.forEach((place, i) => {
    more = Math.max(more, place + share * depths[i]);
    less = Math.max(less, -place + share * depths[i]);
  });
  return {back: (more + less) / (2 * share), aside: (more - less) / 2};
}

// @param back unit vector from the scene to the camera @param shares half of the width and height of that part of the
// picture, at distance 1 @return position of the camera
export function fittingPlace(town, relief, back, shares) {
  const right = new THREE.Vector3(0, 1, 0).cross(back).normalize();
  const up = back.clone().cross(right);
  const points = pointsOf(town, relief);
  const along = (axis) => points.map((point) => point.dot(axis));
  const depths = along(back);
  const across = between(along(right), depths, shares[0]);
  const above = between(along(up), depths, shares[1]);
  return right.multiplyScalar(across.aside)
      .addScaledVector(up, above.aside)
      .addScaledVector(back, Math.max(across.back, above.back));
}
