// The buildings in 3D. Draws when something has changed, and at no other time.
import * as THREE from 'three';
import {OrbitControls} from 'three-orbit';

import {Chunks} from './chunks.js';
import {chosen} from './colours.js';
import {addPrism, Prisms} from './extrude.js';
import {buildingOnRay} from './pick.js';

const sky = {
  light: 0xe9eef2,
  dark: 0x14171b
};
// Triangles of stacks: with a graphics card, without one, and the least while something moves on a slow machine.
const mostTriangles = {
  card: 3000000,
  processor: 400000
};
const leastTriangles = 50000;
// Milliseconds: of a frame that is slow, of work on stacks in one go, and between pictures meanwhile.
const slowFrame = 80;
const workTime = 100;
const pictureTime = 1500;
// Corners of the mesh of the ground a side; light is painted on it as finely as the samples are.
const groundCorners = 160;

// Every so many samples, and the last.
function picked(count) {
  const step = Math.ceil(count / groundCorners);
  const all = [];
  for (let i = 0; i < count - 1; i += step)
    all.push(i);
  all.push(count - 1);
  return all;
}

function groundMesh(relief) {
  const rows = picked(relief.rows);
  const cols = picked(relief.cols);
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
  return new THREE.Mesh(
      geometry,
      new THREE.MeshBasicMaterial(
          {side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2}));
}

export class Scene {
  // @param machine who draws: "card" or "processor" @param onPick gets a building, or -1 where there is none
  constructor(town, relief, canvas, machine, onPick) {
    Object.assign(this, {town, relief, canvas, onPick});
    this.most = mostTriangles[machine];
    this.pixelRatio = machine === 'card' ? Math.min(2, window.devicePixelRatio) : 1;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: machine === 'card', preserveDrawingBuffer: true});
    this.scene = new THREE.Scene();
    this.ground = groundMesh(relief);
    this.chunks = new Chunks(town, relief);
    this.scene.add(this.ground, this.chunks.root);
    this.mark = null;
    this.camera = new THREE.PerspectiveCamera(40, 1, 1, 10);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = false;
    this.controls.maxPolarAngle = 0.49 * Math.PI;
    this.controls.addEventListener('change', () => this.ask());
    this.controls.addEventListener('start', () => this.moving = true);
    this.controls.addEventListener('end', () => this.stopMoving());
    this.budget = this.most;
    this.asked = false;
    this.watchClicks();
    this.home();
  }

  home() {
    const [west, south, east, north] = this.town.extent;
    const size = Math.max(30, Math.hypot(east - west, north - south));
    const middle = new THREE.Vector3((west + east) / 2, 0, -(south + north) / 2);
    const raised = 0.05 * size;  // above the panels at the lower border
    const ground = this.relief.near(middle.x, -middle.z);
    middle.y = Number.isNaN(ground) ? 0 : ground;
    const far = size * 1.08 / Math.min(1, this.camera.aspect);
    middle.z += raised;
    this.controls.target.copy(middle);
    this.camera.position.set(middle.x - 0.22 * far, middle.y + 0.68 * far, middle.z + 0.7 * far);
    this.camera.near = size / 400;
    this.camera.far = size * 8;
    this.controls.minDistance = size / 200;
    this.controls.maxDistance = size * 4;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.ask();
  }

  setTheme(theme) {
    this.renderer.setClearColor(sky[theme]);
    this.ground.material.map?.dispose();
    this.ground.material.map = new THREE.CanvasTexture(this.relief.image(theme));
    this.ground.material.map.minFilter = THREE.LinearFilter;  // its sides are no powers of two
    this.ground.material.needsUpdate = true;
    this.ask();
  }

  setLevel(level) {
    this.chunks.level = level;
    this.ask();
  }

  choose(building) {
    if (this.mark)
      this.scene.remove(this.mark);
    this.mark = null;
    if (building >= 0) {
      const prisms = new Prisms();
      const [from, to] = this.town.tiersOf(building);
      for (let tier = from; tier < to; ++tier)
        if (this.town.stack.level[tier] <= this.chunks.level)
          addPrism(prisms, this.town, tier, this.town.foot(building, tier), this.town.top(tier), chosen);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(prisms.positions), 3));
      geometry.setAttribute('color', new THREE.BufferAttribute(new Uint8Array(prisms.colours), 3, true));
      geometry.setIndex(prisms.indices);
      this.mark = new THREE.Mesh(
          geometry, new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide}));
      this.scene.add(this.mark);
    }
    this.ask();
  }

  // @param x, y in pixels of the canvas
  pick(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera({x: 2 * x / box.width - 1, y: 1 - 2 * y / box.height}, this.camera);
    const {origin, direction} = ray.ray;
    return buildingOnRay(
        this.town, [origin.x, -origin.z, origin.y], [direction.x, -direction.z, direction.y], this.chunks.level);
  }

  // A click is a press that has not become a drag.
  watchClicks() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      down = event.isPrimary && event.button === 0 ? [event.clientX, event.clientY] : null;
    });
    this.canvas.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 5)
        return;
      const box = this.canvas.getBoundingClientRect();
      this.onPick(this.pick(event.clientX - box.left, event.clientY - box.top));
    });
  }

  // Shares of a full turn.
  turn(around, up) {
    const spot = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    spot.theta -= 2 * Math.PI * around;
    spot.phi = Math.min(this.controls.maxPolarAngle, Math.max(0.01, spot.phi - 2 * Math.PI * up));
    this.camera.position.setFromSpherical(spot).add(this.controls.target);
    this.controls.update();
    this.ask();
  }

  // Shares of the distance to what is looked at.
  move(right, up) {
    const away = this.camera.position.clone().sub(this.controls.target);
    const forward = new THREE.Vector3(-away.x, 0, -away.z).normalize();
    const step = new THREE.Vector3(-forward.z, 0, forward.x)
                     .multiplyScalar(right)
                     .addScaledVector(forward, up)
                     .multiplyScalar(away.length());
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
    this.ask();
  }

  zoom(factor) {
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.ask();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.ask();
  }

  stopMoving() {
    this.moving = false;
    this.budget = this.most;
    this.ask();
  }

  ask() {
    if (this.asked || this.canvas.hidden)
      return;
    this.asked = true;
    requestAnimationFrame((time) => this.draw(time));
  }

  // A line is as wide as a pixel: from far away many of them would hide the colours.
  thinLines() {
    const away = this.camera.position.distanceTo(this.controls.target);
    const pixelsAMetre = this.canvas.clientHeight / (2 * Math.tan(this.camera.fov * Math.PI / 360) * away);
    this.chunks.materials.lines.opacity = 0.5 * Math.min(1, pixelsAMetre);
  }

  // When it is drawn, not when it was asked for: a pixel is read from it.
  markFirst() {
    const context = this.renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
    performance.mark('first-picture');
  }

  // The first picture is of blocks. Where frames take long while something moves, far stacks are blocks until it has
  // stopped; while stacks are made, there is a picture now and then.
  draw(time) {
    this.asked = false;
    if (this.moving && this.before && time - this.before > slowFrame)
      this.budget = Math.max(leastTriangles, this.budget / 2);
    this.before = time;
    const first = this.pictured === undefined;
    const late = first || this.moving ? 0 : performance.now() + workTime;
    const missing = this.chunks.update(this.camera.position, this.budget, late);
    if (first || this.moving || !missing || performance.now() - this.pictured > pictureTime) {
      this.thinLines();
      this.renderer.render(this.scene, this.camera);
      this.pictured = performance.now();
    }
    if (first)
      this.markFirst();
    if (first || (missing && !this.moving))
      this.ask();
    else
      document.documentElement.dataset.ready = 'yes';
  }
}
