// Draws buildings by square chunks of the map: blocks of all chunks at once, stacks or slanted roofs chunk by chunk
// near the camera.
import * as THREE from 'three';

import {edge} from './colours.js';
import {blocks, foundations, roofs, stacks} from './extrude.js';

const buildingsAChunk = 60;

// Faces, roof edges, and faces again for shadows.
export function meshOf(prisms, materials) {
  const positions = new THREE.BufferAttribute(new Float32Array(prisms.positions), 3);
  const faces = new THREE.BufferGeometry();
  faces.setAttribute('position', positions);
  faces.setAttribute('color', new THREE.BufferAttribute(new Uint8Array(prisms.colours), 3, true));
  faces.setIndex(new THREE.BufferAttribute(new Uint32Array(prisms.indices), 1));
  const lines = new THREE.BufferGeometry();
  lines.setAttribute('position', positions);
  lines.setIndex(new THREE.BufferAttribute(new Uint32Array(prisms.lines), 1));
  const group = new THREE.Group();
  const shadowed = new THREE.Mesh(faces, materials.shadows);
  shadowed.receiveShadow = true;
  group.add(new THREE.Mesh(faces, materials.faces), new THREE.LineSegments(lines, materials.lines), shadowed);
  group.children[0].castShadow = true;
  return group;
}

function disposeOf(group) {
  for (const {geometry} of group?.children ?? [])
    geometry.dispose();
}

function squares(town) {
  const [west, south, east, north] = town.extent;
  const side = Math.max(1, Math.sqrt((east - west) * (north - south) * buildingsAChunk / Math.max(1, town.buildings)));
  const found = new Map();
  for (let building = 0; building < town.buildings; ++building) {
    const box = town.boxOf(building);
    const key = `${Math.floor((box[0] + box[2] - 2 * west) / 2 / side)} ${
        Math.floor((box[1] + box[3] - 2 * south) / 2 / side)}`;
    if (!found.has(key))
      found.set(key, []);
    found.get(key).push(building);
  }
  return [...found.values()];
}

class Chunk {
  constructor(town, relief, all, materials) {
    Object.assign(this, {town, relief, all, materials});
    this.root = new THREE.Group();
    this.reset();
    this.middle = new THREE.Box3().setFromObject(this.block).getCenter(new THREE.Vector3());
  }

  // Builds the blocks of the shown buildings, and drops the rest.
  reset() {
    for (const part of [this.block, this.stack, this.roofs, this.foundation]) {
      disposeOf(part);
      if (part)
        this.root.remove(part);
    }
    this.buildings = this.all.filter((building) => this.town.isShown[building]);
    this.block = meshOf(blocks(this.town, this.buildings), this.materials);
    this.stack = null;
    this.roofs = null;
    this.foundation = null;
    this.root.add(this.block);
  }

  makeFoundation() {
    this.foundation = meshOf(foundations(this.town, this.relief, this.buildings), this.materials);
    this.root.add(this.foundation);
  }

  // Returns the detailed mesh of a level; null if it is not built.
  detail(level) { return level > this.town.levels ? this.roofs : this.stack; }

  makeDetail(level) {
    if (level > this.town.levels) {
      this.roofs = meshOf(roofs(this.town, this.buildings), this.materials);
    } else {
      const {prisms, ends} = stacks(this.town, this.buildings);
      this.ends = ends;
      this.stack = meshOf(prisms, this.materials);
    }
    this.root.add(this.detail(level));
  }

  triangles(level) { return (this.detail(level)?.children[0].geometry.index.count ?? 0) / 3; }

  show(isDetailed, level) {
    this.block.visible = !isDetailed;
    for (const part of [this.stack, this.roofs])
      if (part)
        part.visible = isDetailed && part === this.detail(level);
    if (!this.stack || level > this.town.levels)
      return;
    const [faces, lines] = this.ends[level];
    this.stack.children[0].geometry.setDrawRange(0, faces);
    this.stack.children[1].geometry.setDrawRange(0, lines);
  }
}

export class Chunks {
  // @param shadows material of the second drawing
  constructor(town, relief, shadows) {
    this.materials = {
      faces: new THREE.MeshBasicMaterial({
        vertexColors: THREE.VertexColors,
        side: THREE.DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        // Faces that are turned to the sun would shade themselves.
        shadowSide: THREE.BackSide,
      }),
      shadows,
      lines: new THREE.LineBasicMaterial(
          {color: new THREE.Color(...edge.map((part) => part / 255)), opacity: 0.45, transparent: true}),
    };
    this.root = new THREE.Group();
    this.level = town.lastLevel;
    this.all = squares(town).map((buildings) => new Chunk(town, relief, buildings, this.materials));
    for (const chunk of this.all)
      this.root.add(chunk.root);
  }

  // Follows a change of the shown buildings.
  reset() {
    for (const chunk of this.all)
      chunk.reset();
  }

  // Shows stacks or slanted roofs near the camera, up to a number of triangles, and blocks beyond. Builds missing ones
  // and foundations until a deadline. Returns true if some are still missing.
  update(eye, budget, late) {
    this.all.sort((a, b) => a.middle.distanceToSquared(eye) - b.middle.distanceToSquared(eye));
    let missing = false;
    let left = budget;
    for (const chunk of this.all) {
      if (!chunk.foundation && performance.now() < late)
        chunk.makeFoundation();
      if (left > 0 && !chunk.detail(this.level) && performance.now() < late)
        chunk.makeDetail(this.level);
      const isBuilt = chunk.detail(this.level) !== null;
      missing = missing || !chunk.foundation || (left > 0 && !isBuilt);
      chunk.show(isBuilt && left > 0, this.level);
      left -= chunk.triangles(this.level);
    }
    return missing;
  }
}
