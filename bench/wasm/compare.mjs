// node --no-liftoff compare.mjs SCALAR SIMD128 BLOB...: times rays by both WebAssembly modules in turns, and compares
// the bytes of their answers. Above 1 the second module is faster.
import { readFile } from 'node:fs/promises';
import { basename } from 'node:path';
import { argv, exit } from 'node:process';

const rayCount = 4096, bytesOfRay = 24, raysOfTurn = 128, rounds = 40;

/// A module with a blob opened in its memory, and room for rays and hits behind the blob.
async function load(program, blob) {
    const { instance: { exports } } = await WebAssembly.instantiate(await readFile(program), {});
    const aligned = (address) => Math.ceil(address / 64) * 64;
    const blobAt = aligned(exports.__heap_base.value);
    const boundsAt = aligned(blobAt + blob.length);
    const raysAt = boundsAt + 64;
    const hitsAt = aligned(raysAt + rayCount * bytesOfRay);
    const end = hitsAt + rayCount * exports.bytes_of_hit();
    exports.memory.grow(Math.max(0, Math.ceil((end - exports.memory.buffer.byteLength) / 65536)));
    const memory = exports.memory.buffer;
    new Uint8Array(memory).set(blob, blobAt);
    if (!exports.open_blob(blobAt, blob.length)) throw new Error(`${program} refuses the blob`);
    exports.store_bounds(boundsAt);
    return {
        bounds: new Float32Array(memory, boundsAt, 6),
        rays: new Float32Array(memory, raysAt, 6 * rayCount),
        hits: new Uint8Array(memory, hitsAt, rayCount * exports.bytes_of_hit()),
        cast: (query, first, count) =>
            exports[query](raysAt + first * bytesOfRay, count, hitsAt + first * exports.bytes_of_hit()),
    };
}

/// Numbers in [0, 1), the same on every machine (mulberry32).
function randomNumbers(seed) {
    let state = seed;
    return () => {
        state = (state + 0x6D2B79F5) | 0;
        let z = Math.imul(state ^ (state >>> 15), state | 1);
        z ^= z + Math.imul(z ^ (z >>> 7), z | 61);
        return ((z ^ (z >>> 14)) >>> 0) / 4294967296;
    };
}

/// As bench/rays.cpp has them: from a sphere around the asset towards random points in its box.
function incoherentRays(bounds, random) {
    const radius = 0.6 * Math.hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
    const rays = [];
    while (rays.length < 6 * rayCount) {
        const s = [0, 1, 2].map(() => 2 * random() - 1);
        const length = Math.hypot(...s);
        if (length > 1 || length < 0.03) continue;
        const from = s.map((x, k) => (bounds[k] + bounds[3 + k]) / 2 + x * radius / length);
        const to = [0, 1, 2].map((k) => bounds[k] + random() * (bounds[3 + k] - bounds[k]));
        rays.push(...from, ...to.map((x, k) => x - from[k]));
    }
    return rays;
}

/// Rows of a picture from the front.
function coherentRays(bounds) {
    const radius = 0.5 * Math.hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
    const center = [0, 1, 2].map((k) => (bounds[k] + bounds[3 + k]) / 2);
    const side = Math.sqrt(rayCount), rays = [];
    for (let row = 0; row < side; ++row)
        for (let column = 0; column < side; ++column) {
            const across = (i) => radius * (2 * i + 1 - side) / side;
            rays.push(center[0], center[1], center[2] + 2.4 * radius, across(column), across(row), -2.4 * radius);
        }
    return rays;
}

/// Casts a turn's rays once and returns how long that took, in nanoseconds.
function time(module, query, first) {
    const start = process.hrtime.bigint();
    module.cast(query, first, raysOfTurn);
    return Number(process.hrtime.bigint() - start);
}

/// The shortest time of each turn, summed up: other work on the processor lengthens single turns.
function compare(modules, query, rays) {
    for (const module of modules) {
        module.rays.set(rays);
        for (let i = 0; i < 5; ++i) module.cast(query, 0, rayCount);
    }
    if (Buffer.compare(modules[0].hits, modules[1].hits) !== 0) {
        console.error('the answers differ');
        exit(1);
    }
    const sums = [0, 0];
    for (let first = 0; first < rayCount; first += raysOfTurn) {
        const shortest = [Infinity, Infinity];
        for (let round = 0; round < rounds; ++round)
            for (const which of [round % 2, 1 - round % 2])
                shortest[which] = Math.min(shortest[which], time(modules[which], query, first));
        shortest.forEach((nanoseconds, which) => { sums[which] += nanoseconds / rayCount; });
    }
    return { hit: modules[0].cast(query, 0, rayCount) / rayCount, scalar: sums[0], simd128: sums[1], ratio: sums[0] / sums[1] };
}

const [, , scalar, simd128, ...blobs] = argv;
console.log(`node ${process.version}, V8 ${process.versions.v8}`);
console.log(`${'blob'.padEnd(24)} ${'rays'.padEnd(20)} hit %  scalar ns  SIMD128 ns  ratio`);
for (const file of blobs) {
    const blob = await readFile(file);
    const modules = [await load(scalar, blob), await load(simd128, blob)];
    const sets = [
        ['closest, incoherent', 'closest_hits', incoherentRays(modules[0].bounds, randomNumbers(1))],
        ['closest, coherent', 'closest_hits', coherentRays(modules[0].bounds)],
        ['any, incoherent', 'any_hits', incoherentRays(modules[0].bounds, randomNumbers(2))],
    ];
    for (const [name, query, rays] of sets) {
        const row = compare(modules, query, rays);
        console.log(`${basename(file).padEnd(24)} ${name.padEnd(20)} ${(100 * row.hit).toFixed(0).padStart(5)} ` +
                    `${row.scalar.toFixed(0).padStart(10)} ${row.simd128.toFixed(0).padStart(11)} ${row.ratio.toFixed(2).padStart(6)}`);
    }
}
