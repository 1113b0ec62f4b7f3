// What the package answers to the questions, as words under the names of the files of C++. For Node and browsers.
import { wordsOf, wordsOfLists } from './words.mjs';

/// Returns the elements of every third query from `first` on.
function third(array, components, first) {
    const rows = [];
    for (let i = first; i < array.length / components; i += 3) rows.push(...array.subarray(components * i, components * (i + 1)));
    return Float32Array.from(rows);
}

/// Interleaves the words of three batches, one for each side to cull.
function answerRays(blob, { origins, directions, limits }, words) {
    const parts = ['none', 'back', 'front'].map((culling, k) => {
        const rays = [third(origins, 3, k), third(directions, 3, k)];
        const options = { tMin: 0.05, tMax: third(limits, 1, k), culling };
        const hits = blob.raycast(...rays, options), any = blob.occluded(...rays, options);
        const first = blob.closestHits(...rays, 3, options);
        const all = blob.allHits(...rays, options), crossings = blob.crossings(...rays, options);
        const count = rays[0].length / 3;
        const each = (words) => Array.from({ length: count }, (_, i) => words.slice(words.length / count * i, words.length / count * (i + 1)));
        return {
            raycast: each(wordsOf('hit', hits)), occluded: each([...any.status]),
            original_hits: each(wordsOf('original', blob.originalHits(hits))),
            closest_hits: rowsOf(first, { begin: (to, i) => to.push(first.end(i) - first.begin(i), first.status[i]) }),
            all_hits: rowsOf(all, { end: (to, i) => to.push(all.status[i]) }),
            crossings: rowsOf(crossings, { end: (to, i) => to.push(crossings.status[i]) }),
        };
    });
    for (const name of Object.keys(parts[0]))
        words[name] = Array.from({ length: limits.length }, (_, i) => parts[i % 3][name][Math.floor(i / 3)]).flat();
}

/// Returns the words of each list.
function rowsOf(lists, { begin = () => {}, end = () => {} }) {
    const starts = [];
    const words = wordsOfLists('hit', lists, {
        begin: (to, i) => { starts.push(to.length); begin(to, i); },
        end,
    });
    return starts.map((start, i) => words.slice(start, starts[i + 1]));
}

function answerPoints(blob, { origins }, words) {
    words.closest_point = wordsOf('nearest', blob.closestPoint(origins, 2.5));
    words.signed_distance = wordsOf('nearest', blob.signedDistance(origins, 2.5));
    words.contains = [...blob.contains(origins).status];
    const several = blob.closestTriangles(origins, 3, 2.5);
    words.closest_triangles = wordsOfLists('nearest', several, {
        begin: (to, i) => to.push(several.end(i) - several.begin(i), several.status[i]),
    });
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
        const touches = blob.overlaps(shapes[name]), lists = blob.overlappingTriangles(shapes[name]);
        words[name] = wordsOfLists('triangle', lists, {
            begin: (to, i) => to.push(touches.status[i]),
            end: (to, i) => to.push(lists.status[i]),
        });
    }
    for (const name of BODIES) {
        const contacts = blob.contacts(shapes[name], 5, limits);
        words[`contacts_${name}`] = wordsOfLists('contact', contacts, {
            begin: (to, i) => to.push(contacts.end(i) - contacts.begin(i), contacts.status[i]),
        });
    }
    for (const name of MOVING) words[`sweep_${name}`] = wordsOf('sweep', blob.sweep(shapes[name], directions, { culling: 'back', ignoreLeaving: true, skin: 0.01 }));
}

/// Answers about the triangles that have a flag.
export function filteredAnswers(blob, questions) {
    const { origins, directions, limits } = questions, shapes = shapesOf(questions);
    const only = Uint8Array.from({ length: blob.triangleCount }, (_, i) => Number(i % 3 !== 1));
    const rays = [origins, directions], options = { tMin: 0.05, tMax: limits, culling: 'front', only };
    const first = blob.closestHits(...rays, 3, options);
    const words = {
        filtered_raycast: wordsOf('hit', blob.raycast(...rays, options)), filtered_occluded: [...blob.occluded(...rays, options).status],
        filtered_closest_hits: wordsOfLists('hit', first, { begin: (to, i) => to.push(first.end(i) - first.begin(i), first.status[i]) }),
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
