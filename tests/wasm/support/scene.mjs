// What the package answers about a scene, as words under the names of the files of C++.
import { MOVING, shapesOf, VOLUMES } from './answers.mjs';
import { placesOf } from './pairs.mjs';
import { bits, codesOf, wordsOf, wordsOfLists } from './words.mjs';

/// Returns the instances of C++.
export function instancesOf(questions) {
    const { rotation, translation, scale } = placesOf(questions), numbers = Array.from({ length: 40 }, (_, i) => i);
    return {
        rotation: rotation.subarray(160, 320), translation: translation.subarray(120, 240), scale: scale.subarray(40, 80),
        mesh: numbers.map((i) => i % 2), mask: numbers.map((i) => 1 + i % 3), user: numbers.map((i) => 7 * i),
    };
}

/// Returns the flags of C++ for instances or slots.
const flagsOf = (length) => Uint8Array.from({ length }, (_, i) => Number(i % 4 !== 2));

/// Returns the answers about a scene, baked or moving, under names with a prefix.
function queryAnswers(scene, questions, prefix, only) {
    const { origins, directions, limits } = questions, mask = 2, selection = { mask, only };
    const options = { tMin: 0.05, tMax: limits, culling: 'back', ...selection }, shapes = shapesOf(questions);
    const rowsOf = (kind, lists, begin) => wordsOfLists(kind, lists, { begin, end: (to, i) => to.push(lists.status[i]) });
    const words = {
        raycast: wordsOf('scene_hit', scene.raycast(origins, directions, options)),
        occluded: codesOf(scene.occluded(origins, directions, options)),
        all_hits: rowsOf('scene_hit', scene.allHits(origins, directions, options)),
        closest_point: wordsOf('scene_nearest', scene.closestPoint(origins, 2.5, { mask })),
    };
    for (const name of VOLUMES) {
        const codes = codesOf(scene.overlaps(shapes[name], selection));
        words[name] = rowsOf('scene_triangle', scene.overlappingTriangles(shapes[name], selection), (to, i) => to.push(codes[i]));
    }
    for (const name of MOVING) {
        const sweeps = scene.sweep(shapes[name], directions, { culling: 'back', ignoreLeaving: true, skin: 0.01, ...selection });
        words[`sweep_${name}`] = wordsOf('scene_sweep', sweeps);
    }
    return Object.fromEntries(Object.entries(words).map(([name, all]) => [prefix + name, all]));
}

/// Returns the answers with and without flags.
export function bothAnswers(scene, questions, prefix, count) {
    return { ...queryAnswers(scene, questions, prefix), ...queryAnswers(scene, questions, `filtered_${prefix}`, flagsOf(count)) };
}

export function sceneAnswers(scene, questions) {
    return {
        scene_facts: [scene.instanceCount, scene.meshCount, ...bits(Float32Array.of(scene.maxError, ...scene.bounds)), ...wordsOf('instance', scene.instances())],
        ...bothAnswers(scene, questions, 'scene_', scene.instanceCount),
    };
}
