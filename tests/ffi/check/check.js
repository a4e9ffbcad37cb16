// What tests/ffi/test.py asks of bindings/node: node --expose-gc check.js layout | MISTAKE, in a folder with umbilic.js.

import assert from 'node:assert/strict';
import koffi from 'koffi';
import { Topology } from './umbilic.js';

// A tetrahedron.
const indices = () => Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2);
const positions = () => Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
const tetrahedron = () => new Topology(indices(), null, 4);
const notANumber = () => positions().fill(NaN, 7, 8);
const closed = () => {
  const mesh = tetrahedron();
  mesh.close();
  return mesh;
};

const STRUCTS = ['umb_error', 'umb_faces', 'umb_topology_options', 'umb_points', 'umb_output', 'umb_status_output', 'umb_run',
  'umb_normal_options', 'umb_normal_outputs', 'umb_curvature_options', 'umb_curvature_outputs'];

const actions = {
  layout() {
    for (const struct of STRUCTS) {
      console.log(struct, koffi.sizeof(struct));
      for (const field of Object.keys(koffi.type(struct).members)) console.log(`${struct}.${field}`, koffi.offsetof(struct, field));
    }
  },
  index: () => new Topology(indices().fill(4, 4, 5), null, 4),
  offsets: () => new Topology(indices(), Uint32Array.of(0, 3, 2, 9, 12), 4),
  'no-offsets': () => new Topology(indices(), Uint32Array.of(), 4),
  'indices-size': () => new Topology(indices().subarray(0, 11), null, 4),
  count: () => new Topology(indices(), null, -1),
  'positions-size': () => tetrahedron().vertexNormals(positions().subarray(0, 9)),
  ragged: () => tetrahedron().curvatures(Float64Array.of(...positions(), 0)),
  type: () => tetrahedron().curvatures(Float32Array.from(positions())),
  missing: () => tetrahedron().curvatures(),
  'threads-of-topology': () => new Topology(indices(), null, 4, 'x'),
  'threads-of-normals': () => tetrahedron().vertexNormals(positions(), 'x'),
  'threads-of-curvatures': () => tetrahedron().curvatures(positions(), null),
  'nan-normals': () => tetrahedron().vertexNormals(notANumber()),
  'nan-curvatures': () => tetrahedron().curvatures(notANumber()),
  'closed-normals': () => closed().vertexNormals(positions()),
  'closed-curvatures': () => closed().curvatures(positions()),
  twice: () => closed().close(),
  empty() {
    const mesh = new Topology(new Uint32Array(0), null, 0);
    assert.equal(mesh.vertexNormals(new Float64Array(0)).normal.length, 0);
    assert.equal(mesh.curvatures(new Float64Array(0)).k1.length, 0);
    mesh.close();
  },
  threads() {
    const one = new Topology(indices(), null, 4, 1);
    const three = new Topology(indices(), null, 4, 3);
    assert.deepEqual(one.vertexNormals(positions(), 1), three.vertexNormals(positions(), 3));
    assert.deepEqual(one.curvatures(positions(), 1), three.curvatures(positions(), 3));
    one.close();
    three.close();
  },
  async forgotten() {
    for (let i = 0; i < 10; i++) tetrahedron();
    // Finalisation runs as a task of its own, after a collection.
    for (let i = 0; i < 10; i++) {
      await new Promise((resume) => setTimeout(resume, 10));
      globalThis.gc();
    }
  },
};

try {
  await actions[process.argv[2]]();
} catch (error) {
  console.error(String(error));
  process.exitCode = 1;
}
