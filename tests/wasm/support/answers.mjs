// What the package answers to the questions, as words under the names of the files of C++. For Node and browsers.
import { codesOf, countedWords, endedWords, wordsOf, wordsOfLists } from './words.mjs';

function answerRays(blob, { origins, directions, limits }, words) {
    for (const culling of ['none', 'back', 'front']) {
        const rays = [origins, directions], options = { tMin: 0.05, tMax: limits, culling }, hits = blob.raycast(...rays, options);
        const answers = {
            raycast: wordsOf('hit', hits), occluded: codesOf(blob.occluded(...rays, options)),
            original_hits: wordsOf('original', blob.originalHits(hits)), closest_hits: countedWords('hit', blob.closestHits(...rays, 3, options)),
            all_hits: endedWords('hit', blob.allHits(...rays, options)), crossings: endedWords('hit', blob.crossings(...rays, options)),
        };
        for (const [name, all] of Object.entries(answers)) words[`${name}_${culling}`] = all;
    }
}

function answerPoints(blob, { origins }, words) {
    words.closest_point = wordsOf('nearest', blob.closestPoint(origins, 2.5));
    words.signed_distance = wordsOf('nearest', blob.signedDistance(origins, 2.5));
    words.contains = codesOf(blob.contains(origins));
    words.closest_triangles = countedWords('nearest', blob.closestTriangles(origins, 3, 2.5));
    words.winding_number = wordsOf('winding', blob.windingNumber(origins, 7));
}

/// The shapes that queries take, by their names in C++.
export const VOLUMES = ['sphere', 'capsule', 'box', 'oriented_box', 'cone', 'triangle'];
const BODIES = ['sphere', 'capsule', 'oriented_box', 'convex_hull'];
export const MOVING = ['sphere', 'capsule', 'box', 'oriented_box', 'convex_hull'];

/// Returns the shapes of C++ by their names there.
export function shapesOf({ origins, directions, radii, vertices, vertexOffsets, planes, planeOffsets }) {
    const next = Float32Array.from([...directions.subarray(3), ...directions.subarray(0, 3)]);
    const halfAxes = new Float32Array(3 * origins.length);
    for (let i = 0; i < radii.length; ++i) {
        halfAxes.set(directions.subarray(3 * i, 3 * i + 3), 9 * i);
        halfAxes.set(next.subarray(3 * i, 3 * i + 3), 9 * i + 3);
        halfAxes[9 * i + 8] = radii[i];
    }
    return {
        sphere: { kind: 'sphere', center: origins, radius: radii },
        capsule: { kind: 'capsule', from: origins, to: directions, radius: radii },
        box: { kind: 'box', min: origins, max: directions },
        oriented_box: { kind: 'orientedBox', center: origins, halfAxes },
        cone: { kind: 'cone', apex: origins, axis: directions, radius: radii },
        triangle: { kind: 'triangle', a: origins, b: directions, c: next },
        convex_hull: { kind: 'convexHull', vertices, offsets: vertexOffsets },
        convex_volume: { kind: 'convexVolume', planes, offsets: planeOffsets },
    };
}

function answerShapes(blob, questions, words) {
    const { origins, directions, limits } = questions;
    words.closest_to_segments = wordsOf('nearest', blob.closestPoint({ kind: 'segment', from: origins, to: directions }, 1.5));
    words.closest_to_boxes = wordsOf('nearest', blob.closestPoint({ kind: 'box', min: origins, max: directions }, 1.5));
    const shapes = shapesOf(questions);
    for (const name of [...VOLUMES, 'convex_volume']) {
        const codes = codesOf(blob.overlaps(shapes[name])), lists = blob.overlappingTriangles(shapes[name]);
        words[name] = wordsOfLists('triangle', lists, {
            begin: (to, i) => to.push(codes[i]),
            end: (to, i) => to.push(lists.status[i]),
        });
    }
    words.planes = countedWords('plane', blob.planes(shapes.capsule, 5, limits));
    for (const name of BODIES) words[`contacts_${name}`] = countedWords('contact', blob.contacts(shapes[name], 5, limits));
    for (const name of MOVING) words[`sweep_${name}`] = wordsOf('sweep', blob.sweep(shapes[name], directions, { culling: 'back', ignoreLeaving: true, skin: 0.01 }));
}

/// Answers about the triangles that have a flag.
export function filteredAnswers(blob, questions) {
    const { origins, directions, limits } = questions, shapes = shapesOf(questions);
    const only = Uint8Array.from({ length: blob.triangleCount }, (_, i) => Number(i % 3 !== 1));
    const rays = [origins, directions], options = { tMin: 0.05, tMax: limits, culling: 'front', only };
    const words = {
        filtered_raycast: wordsOf('hit', blob.raycast(...rays, options)), filtered_occluded: codesOf(blob.occluded(...rays, options)),
        filtered_closest_hits: countedWords('hit', blob.closestHits(...rays, 3, options)),
    };
    for (const name of MOVING) words[`filtered_sweep_${name}`] = wordsOf('sweep', blob.sweep(shapes[name], directions, { skin: 0.01, only }));
    return words;
}

export function answers(blob, questions) {
    const words = {};
    answerRays(blob, questions, words);
    answerPoints(blob, questions, words);
    answerShapes(blob, questions, words);
    return words;
}

/// Returns a hash of answers: FNV-1a over words, each of which counts as one.
export function fingerprint(words) {
    let hash = 0xCBF29CE484222325n;
    for (const name of Object.keys(words).sort())
        for (const word of words[name]) hash = BigInt.asUintN(64, (hash ^ BigInt(word)) * 0x100000001B3n);
    return hash.toString(16).padStart(16, '0');
}
