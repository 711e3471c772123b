// Shadows of the buildings. Surfaces are drawn a second time, darker where the sun does not reach them.
import * as THREE from 'three';

// Pixels per side of the shadow map: with a graphics card and without one.
const mapSize = {
  card: 4096,
  processor: 2048
};

// Material of the second drawing; hidden without sun.
export function shadowMaterial() {
  const material = new THREE.ShadowMaterial({
    opacity: 0.45,
    depthWrite: false,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 0,
    polygonOffsetUnits: 0,
  });
  material.visible = false;
  return material;
}

export class Sun {
  // @param size of the scene in metres @param machine "card" or "processor"
  constructor(scene, renderer, size, machine, material) {
    Object.assign(this, {renderer, size, material});
    renderer.shadowMap.autoUpdate = false;
    this.light = new THREE.DirectionalLight(0xffffff, 0);
    const {camera} = this.light.shadow;
    camera.left = camera.bottom = -0.6 * size;
    camera.right = camera.top = 0.6 * size;
    camera.near = 0;
    camera.far = 4 * size;
    this.light.shadow.mapSize.set(mapSize[machine], mapSize[machine]);
    // Only back faces cast shadows, so a positive bias puts faces that are turned away from the sun into their own.
    this.light.shadow.bias = 0.5 / camera.far;
    scene.add(this.light, this.light.target);
  }

  // @param direction to the sun, see sunDirection(); null for none @param middle of the scene @param isMoving true to
  // keep the shadows of the last picture
  shine(direction, middle, isMoving) {
    const isUp = direction !== null && direction[2] > 0;
    this.material.visible = isUp;
    this.light.castShadow = isUp;
    this.renderer.shadowMap.enabled = isUp;
    if (!isUp)
      return;
    const [east, north, up] = direction;
    this.light.target.position.copy(middle);
    this.light.position.set(east, up, -north).multiplyScalar(2 * this.size).add(middle);
    this.light.target.updateMatrixWorld();
    this.light.updateMatrixWorld();
    this.renderer.shadowMap.needsUpdate = !isMoving;
  }
}
