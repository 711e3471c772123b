// 3D scene of the buildings. Renders only after a change.
import * as THREE from 'three';
import {OrbitControls} from 'three-orbit';

import {Chunks, meshOf} from './chunks.js';
import {chosen} from './colours.js';
import {addBuilding, Prisms} from './extrude.js';
import {fittingPlace} from './fit.js';
import {GroundMesh} from './ground_mesh.js';
import {isProcessor} from './painter.js';
import {hitOnRay} from './pick.js';
import {shadowMaterial, Sun} from './shadows.js';

const sky = {
  light: 0xe9eef2,
  dark: 0x14171b
};
// Triangle limits of stacks: with a graphics card, without one, and the minimum during motion on a slow machine.
const mostTriangles = {
  card: 3000000,
  processor: 400000
};
const leastTriangles = 50000;
// Milliseconds: duration of a slow frame, of one batch of work on stacks, and between pictures during that work.
const slowFrame = 80;
const workTime = 100;
const pictureTime = 1500;
// Direction from the scene to the camera when everything is shown: from the south and slightly west; steeper if the
// view is higher than wide.
const homewards = {
  wide: new THREE.Vector3(-0.22, 0.68, 0.7).normalize(),
  high: new THREE.Vector3(-0.14, 1.1, 0.5).normalize()
};
const upright = Math.PI / 180 * 40;  // field of view
// Rendered pixels per screen pixel and side when at rest, and milliseconds until the scene counts as at rest.
const fine = 2;
const restTime = 200;
// Fraction of the free part of the picture that the scene fills.
const margin = 0.95;

export class Scene {
  // @param context of the canvas @param room returns the free part of the window: left, top, right, bottom
  // @param onPick receives the pixel of a click @param onTurn receives the angle of north, clockwise from
  // above
  constructor(town, relief, canvas, context, room, {onPick, onTurn}) {
    Object.assign(this, {town, relief, canvas, room, onPick, onTurn});
    const machine = isProcessor(context) ? 'processor' : 'card';
    const [west, south, east, north] = town.extent;
    this.size = Math.max(30, Math.hypot(east - west, north - south));
    this.most = mostTriangles[machine];
    this.coarse = machine === 'card' ? fine : 1;
    this.renderer = new THREE.WebGLRenderer({canvas, context});
    this.scene = new THREE.Scene();
    const shadows = shadowMaterial();
    this.ground = new GroundMesh(relief, this.size, shadows);
    this.chunks = new Chunks(town, relief, shadows);
    this.scene.add(this.ground.root, this.chunks.root);
    this.sun = new Sun(this.scene, this.renderer, this.size, machine, shadows);
    this.direction = null;
    this.mark = null;
    this.line = null;
    this.camera = new THREE.PerspectiveCamera(upright / Math.PI * 180, 1, this.size / 400, this.size * 8);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = false;
    this.controls.maxPolarAngle = 0.49 * Math.PI;
    this.controls.minDistance = this.size / 200;
    this.controls.maxDistance = this.size * 4;
    this.controls.addEventListener('change', () => {
      this.isHome = false;
      this.ask();
    });
    this.controls.addEventListener('start', () => this.moving = true);
    this.controls.addEventListener('end', () => this.stopMoving());
    this.budget = this.most;
    this.asked = false;
    this.watchClicks();
  }

  // Pixels of the part of the picture that is free of panels.
  middle() {
    const [left, top, right, bottom] = this.room();
    return [(left + right) / 2, (top + bottom) / 2];
  }

  // Fits everything next to the panels.
  home() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    const [left, top, right, bottom] = this.room();
    const aPixel = 2 * Math.tan(upright / 2) / Math.max(1, height);
    const homeward = right - left < bottom - top ? homewards.high : homewards.wide;
    const shares = [right - left, bottom - top].map((pixels) => Math.max(1, margin * pixels) * aPixel / 2);
    const place = fittingPlace(this.town, this.relief, homeward, shares);
    const [west, south, east, north] = this.town.extent;
    const ground = this.relief.near((west + east) / 2, (south + north) / 2);
    const down = (place.y - (Number.isNaN(ground) ? this.relief.lowest() : ground)) / homeward.y;
    const [x, y] = this.middle();
    this.camera.setViewOffset(width, height, width / 2 - x, height / 2 - y, width, height);
    this.camera.position.copy(place);
    this.controls.target.copy(place).addScaledVector(homeward, -down);
    this.controls.update();
    this.isHome = true;
    this.ask();
  }

  setTheme(theme) {
    this.renderer.setClearColor(sky[theme]);
    this.ground.setTheme(theme);
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
      addBuilding(prisms, this.town, building, this.chunks.level, chosen);
      this.mark = meshOf(prisms, this.chunks.materials);
      this.mark.renderOrder = 1;
      this.scene.add(this.mark);
    }
    this.ask();
  }

  // @param x, y in canvas pixels
  rayAt(x, y) {
    const box = this.canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera({x: 2 * x / box.width - 1, y: 1 - 2 * y / box.height}, this.camera);
    return ray;
  }

  hit({ray: {origin, direction}}) {
    return hitOnRay(
        this.town, [origin.x, -origin.z, origin.y], [direction.x, -direction.z, direction.y], this.chunks.level);
  }

  // @param x, y in canvas pixels
  pick(x, y) { return this.hit(this.rayAt(x, y)).building; }

  // Returns the position that is seen at a pixel: x, y and z in metres; null if there is none.
  positionAt(x, y) {
    const ray = this.rayAt(x, y);
    const [ground] = ray.intersectObject(this.ground.top);
    const along = Math.min(this.hit(ray).along, ground?.distance ?? Infinity);
    if (along === Infinity)
      return null;
    const place = ray.ray.at(along, new THREE.Vector3());
    return [place.x, -place.z, place.y];
  }

  // Draws a line with its points above everything. @param points x, y and z in metres; z may be missing
  drawLine(points) {
    if (this.line) {
      this.scene.remove(this.line);
      this.line.children[0].geometry.dispose();
    }
    const height = ([x, y, z]) => Number.isFinite(z) ? z : this.relief.near(x, y) || 0;
    const places = points.map((point) => new THREE.Vector3(point[0], height(point), -point[1]));
    const geometry = new THREE.BufferGeometry().setFromPoints(places);
    const look = {color: new THREE.Color(...chosen.map((part) => part / 255)), depthTest: false};
    this.line = new THREE.Group();
    this.line.add(
        new THREE.Line(geometry, new THREE.LineBasicMaterial(look)),
        new THREE.Points(geometry, new THREE.PointsMaterial({...look, size: 9, sizeAttenuation: false})));
    for (const part of this.line.children)
      part.renderOrder = 2;
    if (places.length > 0)
      this.scene.add(this.line);
    this.ask();
  }

  // @param direction to the sun, or null
  setSun(direction) {
    this.direction = direction;
    this.ask();
  }

  // Shows other buildings.
  filter() {
    this.chunks.reset();
    this.ask();
  }

  // Moves to a building, as seen before.
  goTo(building) {
    const [west, south, east, north, top] = this.town.boxOf(building);
    const away = this.camera.position.clone().sub(this.controls.target);
    away.setLength(Math.max(120, 4 * Math.hypot(east - west, north - south)));
    this.controls.target.set((west + east) / 2, top, -(south + north) / 2);
    this.camera.position.copy(this.controls.target).add(away);
    this.isHome = false;
    this.controls.update();
    this.ask();
  }

  // Returns the camera and its target for a link.
  place() { return {eye: this.camera.position.toArray(), to: this.controls.target.toArray()}; }

  setPlace({eye, to}) {
    this.camera.position.fromArray(eye);
    this.controls.target.fromArray(to);
    this.isHome = false;
    this.controls.update();
    this.ask();
  }

  // A click is a press that did not become a drag.
  watchClicks() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      down = event.isPrimary && event.button === 0 ? [event.clientX, event.clientY] : null;
    });
    this.canvas.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 5)
        return;
      const box = this.canvas.getBoundingClientRect();
      this.onPick(...[event.clientX - box.left, event.clientY - box.top]);
    });
  }

  // Rotates by fractions of a full turn.
  turn(around, up) {
    const spot = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    spot.theta -= 2 * Math.PI * around;
    spot.phi = Math.min(this.controls.maxPolarAngle, Math.max(0.01, spot.phi - 2 * Math.PI * up));
    this.camera.position.setFromSpherical(spot).add(this.controls.target);
    this.controls.update();
    this.ask();
  }

  turnNorth() { this.turn(this.controls.getAzimuthalAngle() / (2 * Math.PI), 0); }

  // Pans by fractions of the distance to the target.
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

  // Shows everything again unless the user has moved the camera.
  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    const [x, y] = this.middle();
    this.camera.setViewOffset(width, height, width / 2 - x, height / 2 - y, width, height);
    if (this.isHome)
      this.home();
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
    clearTimeout(this.resting);
    this.asked = true;
    requestAnimationFrame((time) => this.draw(time));
  }

  // Lines are one pixel wide and would hide the colours from far away.
  thinLines() {
    const away = this.camera.position.distanceTo(this.controls.target);
    const pixelsAMetre = this.canvas.clientHeight / (2 * Math.tan(upright / 2) * away);
    this.chunks.materials.lines.opacity = 0.5 * Math.min(1, pixelsAMetre);
  }

  // Marks the time at which the picture is drawn instead of requested, because reading a pixel waits for it.
  markFirst() {
    const context = this.renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
    performance.mark('first-picture');
  }

  // @param ratio rendered pixels per screen pixel
  picture(ratio) {
    if (this.renderer.getPixelRatio() !== ratio)
      this.renderer.setPixelRatio(ratio);
    this.thinLines();
    const [west, south, east, north] = this.town.extent;
    this.sun.shine(
        this.direction, new THREE.Vector3((west + east) / 2, this.relief.lowest(), -(south + north) / 2), this.moving);
    this.renderer.render(this.scene, this.camera);
    this.onTurn(this.controls.getAzimuthalAngle());
    this.pictured = performance.now();
  }

  // Renders the last picture after a rest.
  rest() {
    const finish = () => {
      this.picture(fine);
      document.documentElement.dataset.ready = 'yes';
    };
    if (this.coarse === fine)
      finish();
    else
      this.resting = setTimeout(finish, restTime);
  }

  // The first picture shows blocks without lines. If frames are slow during motion, far stacks are shown as blocks
  // until it ends; while stacks are built, pictures appear at intervals.
  draw(time) {
    this.asked = false;
    clearTimeout(this.resting);
    if (this.moving && this.before && time - this.before > slowFrame)
      this.budget = Math.max(leastTriangles, this.budget / 2);
    this.before = time;
    const first = this.pictured === undefined;
    const late = first || this.moving ? 0 : performance.now() + workTime;
    const missing = this.chunks.update(this.camera.position, this.budget, late);
    this.chunks.materials.lines.visible = !first;
    if (first || this.moving || !missing || performance.now() - this.pictured > pictureTime)
      this.picture(this.coarse);
    if (first)
      this.markFirst();
    if (first || (missing && !this.moving))
      this.ask();
    else if (!this.moving)
      this.rest();
  }
}
