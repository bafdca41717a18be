/* Muscles in a viewer's scene, each a belly and its tendons along its path. */
import { clip } from "../vectors.js";
import { mix, RINGS } from "./anatomy.js";

const REST = [0.93, 0.74, 0.70], FULL = [0.78, 0.02, 0.06], SINEW = [0.93, 0.90, 0.84];

/* How red a muscle is: the eye tells weak activations apart when it sees their root. */
export const redness = (activation) => mix(REST, FULL, Math.sqrt(clip(activation, 0, 1)));

export class Muscles {
  /* So many muscles `within` an object of the scene, each with so many sides. */
  constructor(viewer, count, within, sides) {
    Object.assign(this, { viewer, sides });
    this.meshes = Array.from({ length: count }, () => this.addMuscle());
    within.add(...this.meshes);
  }

  /* Lay each around its belly (anatomy.js), as red as it is active. */
  pose(bellies, activation) {
    bellies.forEach((belly, k) => this.shape(this.meshes[k], belly, redness(activation[k])));
  }

  /* Which muscle is seen at a place of the picture, (-1, -1) to (1, 1) from lower left; or null. */
  muscleAt([x, y]) {
    const ray = new self.MeshCat.THREE.Raycaster();
    ray.setFromCamera({ x, y }, this.viewer.camera);
    const [hit] = ray.intersectObjects(this.meshes);
    return hit ? this.meshes.indexOf(hit.object) : null;
  }

  /* Make one muscle stand out, by its number, or none. */
  point(k) {
    this.meshes.forEach(({ material }, i) => material.emissive.setHex(String(i) === `${k}` ? 0x2e2a12 : 0));
    this.viewer.set_dirty();
  }

  addMuscle() {
    const { THREE } = self.MeshCat;
    const { sides } = this;
    const shape = new THREE.BufferGeometry();
    for (const part of ["position", "normal", "color"])
      shape.setAttribute(part, new THREE.BufferAttribute(new Float32Array(3 * RINGS * sides), 3));
    const faces = [];
    for (let i = 0; i < RINGS - 1; i++)
      for (let j = 0; j < sides; j++) {
        const [a, b] = [i * sides + j, i * sides + ((j + 1) % sides)];
        faces.push(a, b, a + sides, b, b + sides, a + sides);
      }
    shape.setIndex(faces);
    const mesh = new THREE.Mesh(shape, new THREE.MeshLambertMaterial({ vertexColors: true }));
    mesh.frustumCulled = false;
    shape.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2); // it moves
    return mesh;
  }

  /* Lay a muscle's surface around its rings. */
  shape({ geometry }, { centres, radii, flesh }, red) {
    const { THREE } = self.MeshCat;
    const { sides } = this;
    const { position, normal, color } = geometry.attributes;
    const vectors = centres.map((c) => new THREE.Vector3(...c));
    const along = new THREE.Vector3(), side = new THREE.Vector3(0, 0, 1), up = new THREE.Vector3();
    vectors.forEach((centre, i) => {
      const [from, to] = [Math.max(i - 1, 0), Math.min(i + 1, vectors.length - 1)];
      const step = along.subVectors(vectors[to], vectors[from]).length();
      along.normalize();
      side.addScaledVector(along, -side.dot(along)).normalize();
      up.crossVectors(along, side);
      const slope = (radii[to] - radii[from]) / step;
      const paint = mix(SINEW, red, flesh[i]);
      for (let j = 0; j < sides; j++) {
        const [c, s] = [Math.cos((2 * Math.PI * j) / sides), Math.sin((2 * Math.PI * j) / sides)];
        const out = ["x", "y", "z"].map((d) => c * side[d] + s * up[d]);
        const v = i * sides + j;
        position.setXYZ(v, ...out.map((o, d) => centres[i][d] + radii[i] * o));
        normal.setXYZ(v, out[0] - slope * along.x, out[1] - slope * along.y, out[2] - slope * along.z);
        color.setXYZ(v, ...paint);
      }
    });
    for (const part of [position, normal, color]) part.needsUpdate = true;
  }
}
