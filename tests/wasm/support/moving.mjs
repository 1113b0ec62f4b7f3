// A moving scene as C++ makes it, and what the package answers about it, as words under the names of the files of C++.
import { placesOf } from './pairs.mjs';
import { bothAnswers } from './scene.mjs';
import { bits, wordsOf } from './words.mjs';

const CAPACITY = 40;

/// Returns the places of `count` questions from the first on.
function placesFrom(questions, first, count) {
    const { rotation, translation, scale } = placesOf(questions), end = first + count;
    return { rotation: rotation.subarray(4 * first, 4 * end), translation: translation.subarray(3 * first, 3 * end), scale: scale.subarray(first, end) };
}

const rowsOf = (columns, names) => Array.from(columns[names[0]], (_, i) => names.map((name) => columns[name][i]));
const handlesOf = (rows) => ({ slot: rows.map(([slot]) => slot), generation: rows.map(([, generation]) => generation) });

/// What an instance is of, as in C++: 0 and 1 are blobs, 2 is the tile, and 3 does not exist.
const meshOf = (i) => i % 10 < 8 ? i % 2 : i % 10 - 6;

/// Changes an empty scene as C++ does, and returns the words of the results and the statuses among them.
function change(scene, blob, questions) {
    const handles = [], words = [], statuses = [];
    const insert = (first, count) => {
        const numbers = Array.from({ length: count }, (_, i) => i);
        const inserted = scene.insert({
            ...placesFrom(questions, first, count), mesh: numbers.map(meshOf), mask: numbers.map((i) => 1 + i % 3), user: numbers.map((i) => 7 * i),
        });
        const rows = rowsOf(inserted, ['slot', 'generation', 'status']);
        handles.push(...rows);
        words.push(...rows.flat());
        statuses.push(...inserted.status);
    };
    const move = (first, count) => {
        const moved = scene.move(handlesOf(handles.slice(0, count)), placesFrom(questions, first, count));
        words.push(...moved);
        statuses.push(...moved);
    };
    insert(80, 60);
    move(15, 20);
    words.push(...scene.remove(handlesOf([10, 11, 12, 13, 14, 10].map((i) => handles[i]))));
    const some = handlesOf(handles.slice(14, 22)), masks = scene.setMasks(some, 6);
    const users = scene.setUsers(some, [14, 15, 16, 17, 18, 19, 20, 21].map((i) => 1000 + i));
    masks.forEach((status, i) => words.push(status, users[i]));
    scene.repack();
    scene.endStep();
    insert(150, 6);
    move(170, 4);
    scene.setMesh(1, blob);
    words.push(0, scene.instanceCount, scene.capacity, scene.slotEnd, scene.stepExponent >>> 0, ...bits(Float32Array.of(scene.quality)));
    const named = rowsOf(scene.handles(), ['slot', 'generation', 'status']), { length } = named, all = scene.instances();
    const instances = wordsOf('instance', all), width = instances.length / length;
    named.forEach((handle, slot) => words.push(...handle, ...(handle[2] === 0 ? instances.slice(width * slot, width * (slot + 1)) : [])));
    return { words, statuses };
}

function pairWords({ items, next, status }) {
    const columns = Object.values(items);
    return [...columns[0].keys()].flatMap((i) => columns.map((column) => column[i])).concat(next, status);
}

/// Returns the scene of C++, as it is before its queries, the words of its changes, and the statuses among them.
export function movingScene(library, blob, coarse, tile, questions) {
    const scene = library.createMovingScene([blob, coarse], CAPACITY, { stepExponent: -8, tiles: [tile] });
    const { words, statuses } = change(scene, blob, questions);
    return { scene, moving_changes: words, statuses };
}

export function movingAnswers(scene, baked, questions) {
    const limit = { workLimit: 300 };
    const pairs = {
        moving_candidates: scene.candidatePairs({ start: [1, 5] }), moving_moved: scene.candidatePairs({ onlyMoved: true }),
        moving_collisions: scene.collidingPairs(), moving_collisions_limited: scene.collidingPairs(limit),
        moving_candidates_with_baked: scene.candidatePairs({ baked, start: [2, 3, 0] }),
        moving_collisions_with_baked: scene.collidingPairs({ baked, onlyMoved: true }),
        moving_collisions_with_baked_limited: scene.collidingPairs({ baked, ...limit }),
    };
    return {
        queries: bothAnswers(scene, questions, 'moving_', scene.slotEnd),
        pairs: Object.fromEntries(Object.entries(pairs).map(([name, found]) => [name, pairWords(found)])),
        statuses: Object.fromEntries(Object.entries(pairs).map(([name, found]) => [name, found.status])),
    };
}
