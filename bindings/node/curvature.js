// Vertex normals and curvatures of a mesh with umbilic.
//
//   node curvature.js MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
//   node curvature.js --time MESH.off     prints how long each call takes, in milliseconds, on one thread

import { readFileSync, writeFileSync } from 'node:fs';
import { Topology } from './umbilic.js';

function readOff(path) {
  // The lines that say something, each as a list of words.
  const lines = readFileSync(path, 'latin1').split('\n').map((line) => line.replace(/#.*/, '').trim()).filter(Boolean)
    .map((line) => line.split(/\s+/));
  const [magic, ...rest] = lines.shift() ?? [];
  if (magic !== 'OFF') throw new Error(`${path}: no OFF file`);
  const [vertexCount, faceCount] = (rest.length > 0 ? rest : lines.shift() ?? []).map(Number);
  if (!(lines.length >= vertexCount + faceCount)) throw new Error(`${path}: the file ends early`);
  const positions = Float64Array.from(lines.slice(0, vertexCount).flatMap((line) => line.slice(0, 3)), Number);
  const faces = lines.slice(vertexCount, vertexCount + faceCount).map((line) => {
    const [corners, ...numbers] = line.map(Number);
    const face = numbers.slice(0, corners);
    if (face.length !== corners || !face.every((index) => index >>> 0 === index)) throw new Error(`${path}: cannot read: ${line.join(' ')}`);
    return face;
  });
  const indices = Uint32Array.from(faces.flat());
  const offsets = new Uint32Array(faceCount + 1);
  faces.forEach((face, f) => { offsets[f + 1] = offsets[f] + face.length; });
  return { positions, indices, offsets, vertexCount };
}

function write(path, arrays) {
  writeFileSync(path, Buffer.concat(arrays.map(({ buffer }) => Buffer.from(buffer))));
}

function time(path) {
  const { positions, indices, offsets, vertexCount } = readOff(path);
  for (let round = 0; round < 20; round++) {
    const start = performance.now();
    const mesh = new Topology(indices, offsets, vertexCount, 1);
    const built = performance.now();
    mesh.vertexNormals(positions, 1);
    const shaded = performance.now();
    mesh.curvatures(positions, 1);
    const done = performance.now();
    console.log([built - start, shaded - built, done - shaded].map((ms) => ms.toFixed(6)).join('\t'));
    mesh.close();
  }
}

function main(path, results) {
  const { positions, indices, offsets, vertexCount } = readOff(path);
  // begin: user code
  const mesh = new Topology(indices, offsets, vertexCount);
  const { normal, status } = mesh.vertexNormals(positions);
  const curvatures = mesh.curvatures(positions);
  mesh.close();
  // end: user code
  const { k1, k2, direction1, direction2, mean, gaussian } = curvatures;
  write(results, [normal, status, k1, k2, direction1, direction2, mean, gaussian, curvatures.status]);
}

const [first, second] = process.argv.slice(2);
try {
  if (second === undefined) throw new Error('usage: curvature.js MESH.off RESULTS | --time MESH.off');
  if (first === '--time') time(second);
  else main(first, second);
} catch (error) {
  console.error(String(error));
  process.exitCode = 1;
}
