// umbilic for Node: vertex normals and curvatures of polygon meshes, on typed arrays. See include/umbilic.h for what everything means.
//
//   import { Topology } from './umbilic.js';
//   const mesh = new Topology(indices, null, vertexCount);   // Uint32Array, triangles
//   const { k1, direction1 } = mesh.curvatures(positions);   // Float64Array, x y z of each vertex
//
// Typed arrays are neither copied nor kept. What fails throws an UmbilicError. A topology is freed by close(), or when it is collected;
// it belongs to the thread (worker) that made it.

import koffi from 'koffi';

const library = koffi.load('libumbilic.so.0');

koffi.opaque('umb_topology');
koffi.struct('umb_error', {
  struct_size: 'uint32_t',
  status: 'int32_t',
  element: 'uint64_t',
  message: koffi.array('char', 240, 'String'),
});
koffi.struct('umb_faces', {
  indices: 'const void *',
  index_count: 'size_t',
  offsets: 'const void *',
  face_count: 'size_t',
  index: 'uint32_t',
  arity: 'uint32_t',
});
koffi.struct('umb_topology_options', { struct_size: 'uint32_t', threads: 'uint32_t', simd: 'uint32_t', reserved: 'uint32_t' });
koffi.struct('umb_points', {
  data: 'const void *',
  count: 'size_t',
  stride: 'size_t',
  scalar: 'uint32_t',
  reserved: 'uint32_t',
});
koffi.struct('umb_output', { data: 'void *', stride: 'size_t', scalar: 'uint32_t', reserved: 'uint32_t' });
koffi.struct('umb_status_output', { data: 'void *', stride: 'size_t' });
koffi.struct('umb_run', {
  threads: 'uint32_t',
  simd: 'uint32_t',
  vertices: 'const void *',
  vertex_count: 'size_t',
  progress: 'void *',
  user: 'void *',
});
koffi.struct('umb_normal_options', {
  struct_size: 'uint32_t',
  weight: 'uint32_t',
  run: 'umb_run',
  degree: 'uint32_t',
  rings: 'uint32_t',
  model: 'const void *',
});
koffi.struct('umb_normal_outputs', {
  struct_size: 'uint32_t',
  reserved: 'uint32_t',
  normal: 'umb_output',
  sum: 'umb_output',
  status: 'umb_status_output',
});
koffi.struct('umb_curvature_options', {
  struct_size: 'uint32_t',
  method: 'uint32_t',
  section: 'uint32_t',
  weight: 'uint32_t',
  radius: 'double',
  degree: 'uint32_t',
  rings: 'uint32_t',
  normal_degree: 'uint32_t',
  normal_rings: 'uint32_t',
  model: 'const void *',
  normals: 'umb_points',
  run: 'umb_run',
});
koffi.struct('umb_curvature_outputs', {
  struct_size: 'uint32_t',
  reserved: 'uint32_t',
  k1: 'umb_output',
  k2: 'umb_output',
  direction1: 'umb_output',
  direction2: 'umb_output',
  mean: 'umb_output',
  gaussian: 'umb_output',
  mean_normal: 'umb_output',
  area: 'umb_output',
  integrated_mean: 'umb_output',
  integrated_gaussian: 'umb_output',
  shape_index: 'umb_output',
  curvedness: 'umb_output',
  residual: 'umb_output',
  condition: 'umb_output',
  degrees_of_freedom: 'umb_output',
  normal: 'umb_output',
  status: 'umb_status_output',
});

const functions = {
  abiVersion: library.func('uint32_t umb_abi_version()'),
  create: library.func(`int32_t umb_topology_create(const umb_faces *faces, size_t vertex_count,
    const umb_topology_options *options, _Out_ umb_topology **topology, _Inout_ umb_error *error)`),
  destroy: library.func('void umb_topology_destroy(umb_topology *topology)'),
  vertexCount: library.func('size_t umb_topology_vertex_count(const umb_topology *topology)'),
  vertexNormals: library.func(`int32_t umb_vertex_normals(const umb_topology *topology, const umb_points *points,
    const umb_normal_options *options, const umb_normal_outputs *outputs, _Inout_ umb_error *error)`),
  curvatures: library.func(`int32_t umb_curvatures(const umb_topology *topology, const umb_points *points,
    const umb_curvature_options *options, const umb_curvature_outputs *outputs, _Inout_ umb_error *error)`),
};

if (functions.abiVersion() !== 0) throw new Error('libumbilic has another binary interface than umbilic.js');

const F64 = 1; // UMB_SCALAR_F64
const SIZE = 7; // UMB_ERROR_SIZE
const NO_ELEMENT = 0xffffffffffffffffn;

/** What the library refused: its status, and the offending element, or null. */
export class UmbilicError extends Error {
  constructor(status, message, element = null) {
    super(`${message} (status ${status}${element === null ? '' : `, element ${element}`})`);
    this.name = 'UmbilicError';
    this.status = status;
    this.element = element;
  }
}

// A struct with its size set; koffi makes zeros of fields that are left out.
function sized(type, fields = {}) {
  return { struct_size: koffi.sizeof(type), ...fields };
}

// Calls a function that takes an umb_error as its last argument.
function call(method, ...args) {
  const error = sized('umb_error');
  const status = method(...args, error);
  if (status !== 0) {
    throw new UmbilicError(status, error.message, BigInt(error.element) === NO_ELEMENT ? null : Number(error.element));
  }
}

function required(array, type, what) {
  if (!(array instanceof type)) throw new TypeError(`${what} must be a ${type.name}`);
  return array;
}

// koffi ends the process where a field of a struct should be a number and is none.
function natural(number, what) {
  if (!Number.isSafeInteger(number) || number < 0) throw new RangeError(`${what} must be an integer from 0`);
  return number;
}

function pointsOf(positions) {
  required(positions, Float64Array, 'positions');
  if (positions.length % 3 !== 0) throw new UmbilicError(SIZE, 'positions are no multiple of 3 numbers');
  return { data: positions, count: positions.length / 3, scalar: F64 };
}

// Where arrays are to be filled: typed arrays by the name of their field.
function outputsOf(type, arrays) {
  const fields = Object.entries(arrays).map(([name, data]) => [name, data instanceof Float64Array ? { data, scalar: F64 } : { data }]);
  return sized(type, Object.fromEntries(fields));
}

const forgotten = new FinalizationRegistry(functions.destroy);

/** The one-rings of a mesh, built once from its faces and used while positions move. */
export class Topology {
  #handle = null;

  /**
   * @param {Uint32Array} indices the vertices of all faces, one face after the other, from 0
   * @param {?Uint32Array} offsets where each face starts, and the end of the last; null for triangles
   * @param {number} vertexCount
   * @param {number} threads 0 for as many as pay
   */
  constructor(indices, offsets, vertexCount, threads = 0) {
    const faces = { indices: required(indices, Uint32Array, 'indices'), index_count: indices.length };
    if (offsets !== null) {
      faces.offsets = required(offsets, Uint32Array, 'offsets');
      faces.face_count = offsets.length - 1;
    }
    const handle = [null];
    const options = sized('umb_topology_options', { threads: natural(threads, 'threads') });
    call(functions.create, faces, natural(vertexCount, 'vertexCount'), options, handle);
    this.#handle = handle[0];
    forgotten.register(this, this.#handle, this);
  }

  /** Frees the topology now; calls that follow throw. */
  close() {
    forgotten.unregister(this);
    functions.destroy(this.#handle);
    this.#handle = null;
  }

  get vertexCount() {
    return Number(functions.vertexCount(this.#handle));
  }

  /** Unit normals (N_CM), with x y z of each vertex, and its UMB_VERTEX_ bits. */
  vertexNormals(positions, threads = 0) {
    const vertices = this.vertexCount;
    const normals = { normal: new Float64Array(3 * vertices), status: new Uint8Array(vertices) };
    const options = sized('umb_normal_options', { run: { threads: natural(threads, 'threads') } });
    call(functions.vertexNormals, this.#handle, pointsOf(positions), options, outputsOf('umb_normal_outputs', normals));
    return normals;
  }

  /** Curvatures by adaptive jets; directions have x y z of each vertex, `status` its UMB_VERTEX_ bits. */
  curvatures(positions, threads = 0) {
    const vertices = this.vertexCount;
    const curvatures = {
      k1: new Float64Array(vertices),
      k2: new Float64Array(vertices),
      direction1: new Float64Array(3 * vertices),
      direction2: new Float64Array(3 * vertices),
      mean: new Float64Array(vertices),
      gaussian: new Float64Array(vertices),
      status: new Uint8Array(vertices),
    };
    const options = sized('umb_curvature_options', { run: { threads: natural(threads, 'threads') } });
    call(functions.curvatures, this.#handle, pointsOf(positions), options, outputsOf('umb_curvature_outputs', curvatures));
    return curvatures;
  }
}

// `using mesh = new Topology(…)`, where the language has it.
if (Symbol.dispose) Topology.prototype[Symbol.dispose] = Topology.prototype.close;
