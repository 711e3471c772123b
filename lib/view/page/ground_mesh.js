// Mesh of the ground: coarser than its samples but with a texture at full resolution, and with side walls down to a
// level below, like a model on a table.
import * as THREE from 'three';

// Vertices per side.
const most = 160;
const sides = {
  light: 0xb9b7b0,
  dark: 0x24272c
};

// Returns every n-th sample and the last one.
function picked(count) {
  const step = Math.ceil(count / most);
  const all = [];
  for (let i = 0; i < count - 1; i += step)
    all.push(i);
  all.push(count - 1);
  return all;
}

function topOf(relief, rows, cols) {
  const positions = [];
  const spots = [];
  const isKnown = [];
  const indices = [];
  rows.forEach((row, i) => cols.forEach((col, j) => {
    const [x, y] = relief.position(row, col);
    const z = relief.at(row, col);
    const at = i * cols.length + j;
    positions.push(x, Number.isNaN(z) ? 0 : z, -y);
    spots.push((col + 0.5) / relief.cols, 1 - (row + 0.5) / relief.rows);
    isKnown.push(!Number.isNaN(z));
    const corners = [at, at - 1, at - cols.length, at - cols.length - 1];
    if (i > 0 && j > 0 && corners.every((corner) => isKnown[corner]))
      indices.push(corners[3], corners[1], corners[0], corners[3], corners[0], corners[2]);
  }));
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('uv', new THREE.BufferAttribute(new Float32Array(spots), 2));
  geometry.setIndex(indices);
  return geometry;
}

// Border of the window if its ground is known.
function sidesOf(relief, rows, cols, bottom) {
  const around = [
    ...cols.map((col) => [0, col]),
    ...rows.slice(1).map((row) => [row, relief.cols - 1]),
    ...cols.slice(0, -1).reverse().map((col) => [relief.rows - 1, col]),
    ...rows.slice(0, -1).reverse().map((row) => [row, 0]),
  ];
  const positions = [];
  const indices = [];
  around.forEach(([row, col], i) => {
    const [x, y] = relief.position(row, col);
    const z = relief.at(row, col);
    const isKnown = !Number.isNaN(z);
    positions.push(x, isKnown ? z : bottom, -y, x, bottom, -y);
    if (i > 0 && isKnown && !Number.isNaN(relief.at(...around[i - 1])))
      indices.push(2 * i - 2, 2 * i - 1, 2 * i, 2 * i, 2 * i - 1, 2 * i + 1);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
  geometry.setIndex(indices);
  return geometry;
}

export class GroundMesh {
  // @param size of the window in metres @param shadows material of the second drawing
  constructor(relief, size, shadows) {
    this.relief = relief;
    const rows = picked(relief.rows);
    const cols = picked(relief.cols);
    const behind = {polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2, side: THREE.DoubleSide};
    this.top = new THREE.Mesh(topOf(relief, rows, cols), new THREE.MeshBasicMaterial(behind));
    this.sides = new THREE.Mesh(
        sidesOf(relief, rows, cols, relief.lowest() - 0.012 * size), new THREE.MeshBasicMaterial(behind));
    const shadowed = new THREE.Mesh(this.top.geometry, shadows);
    shadowed.receiveShadow = true;
    this.root = new THREE.Group();
    this.root.add(this.top, this.sides, shadowed);
  }

  setTheme(theme) {
    const {material} = this.top;
    material.map?.dispose();
    material.map = new THREE.CanvasTexture(this.relief.image(theme));
    material.map.minFilter = THREE.LinearFilter;  // sides are not powers of two
    material.needsUpdate = true;
    this.sides.material.color.setHex(sides[theme]);
  }
}
