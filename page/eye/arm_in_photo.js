/* The arm in the reader's own photograph: seen by the photo's camera, in the light of the sheet's paper, its shadow on
   the table. The table goes on for ever: of what lies below it nothing is seen. */
import { plus, times } from "../vectors.js";

const NEAR = 0.02, FAR = 6; // m, of what is drawn
const LAMP = [-0.2, 1, 0.3]; // towards it
const SHADE = 0.35, SOFT = 0.006; // of light that the shadow takes, and its edge, in widths of the photo

/* A camera of three.js that sees what a pinhole camera sees (camera.js), in a picture of a size. */
const pinhole = ({ focal, centre: [u, v], rotation: [right, down, forwards], position }, [width, height]) => {
  const { Camera, Vector3 } = self.MeshCat.THREE, camera = new Camera(), scale = NEAR / focal;
  const axes = [right, times(-1, down), times(-1, forwards)].map((axis) => new Vector3(...axis));
  camera.projectionMatrix.makePerspective(-u * scale, (width - u) * scale, v * scale, (v - height) * scale, NEAR, FAR);
  camera.matrixAutoUpdate = false;
  camera.matrix.makeBasis(...axes).setPosition(...position);
  camera.updateMatrixWorld(true);
  return camera;
};

/* The matrix that moves all along the light onto a table of a height (Blinn 1988). */
const ontoTable = (height) => {
  const [x, , z] = times(1 / LAMP[1], LAMP);
  return new self.MeshCat.THREE.Matrix4().set(1, -x, 0, x * height, 0, 0, 0, height, 0, -z, 1, z * height, 0, 0, 0, 1);
};

export class ArmInPhoto {
  /* The arm of a scene's view (demo/scene.js), in photos of a size that are drawn on a context. */
  constructor(view, size, context) {
    Object.assign(this, { view, size, context });
  }

  start() {
    const { THREE } = self.MeshCat, { width, height } = this.context.canvas;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
    this.renderer.setSize(width, height, false);
    this.lights = [new THREE.AmbientLight(0xffffff, 0.6), new THREE.DirectionalLight(0xffffff, 0.5)];
    this.lights[1].position.set(...LAMP);
    this.scene = new THREE.Scene().add(...this.lights);
    this.black = new THREE.MeshBasicMaterial({ color: 0, side: THREE.DoubleSide });
  }

  /* Draw the arm of this moment, `beyond` from where a camera sees it, above a table of a height, in a light (3,). */
  draw(camera, beyond, table, light) {
    const { body } = this.view, { context, size } = this;
    if (!body) return; // no WebGL
    if (!this.renderer) this.start();
    const { Plane, Vector3 } = self.MeshCat.THREE, { trunk } = body, home = trunk.parent, height = table + beyond[1];
    const eye = pinhole({ ...camera, position: plus(camera.position, beyond) }, size), ghosts = [];
    trunk.traverse((part) => part.visible && part.material?.transparent && ghosts.push(part));
    for (const ghost of ghosts) ghost.visible = false;
    for (const { color } of this.lights) color.setRGB(...light);
    this.renderer.clippingPlanes = [new Plane(new Vector3(0, 1, 0), -height)];
    this.scene.add(trunk);
    const { projectionMatrix, matrixWorld, matrixWorldInverse } = eye, seen = projectionMatrix.clone();
    projectionMatrix.multiply(matrixWorldInverse).multiply(ontoTable(height)).multiply(matrixWorld);
    Object.assign(context, { globalAlpha: SHADE, filter: `blur(${SOFT * context.canvas.width}px)` });
    this.paint(eye, this.black);
    projectionMatrix.copy(seen);
    Object.assign(context, { globalAlpha: 1, filter: "none" });
    this.paint(eye, null);
    home.add(trunk);
    for (const ghost of ghosts) ghost.visible = true;
  }

  paint(eye, overrideMaterial) {
    const { renderer, scene, context } = this;
    Object.assign(scene, { overrideMaterial });
    renderer.render(scene, eye);
    context.drawImage(renderer.domElement, 0, 0);
  }

  end() {
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }
}
