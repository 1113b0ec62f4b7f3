// What the package answers about a scene, as words under the names of the files of C++.
import { MOVING, shapesOf } from './answers.mjs';
import { placesOf } from './pairs.mjs';
import { bits, wordsOf, wordsOfLists } from './words.mjs';

/// Returns the instances of C++.
export function instancesOf(questions) {
    const { rotation, translation, scale } = placesOf(questions), numbers = Array.from({ length: 40 }, (_, i) => i);
    return {
        rotation: rotation.subarray(160, 320), translation: translation.subarray(120, 240), scale: scale.subarray(40, 80),
        mesh: numbers.map((i) => i % 2), mask: numbers.map((i) => 1 + i % 3), user: numbers.map((i) => 7 * i),
    };
}

export function sceneAnswers(scene, questions) {
    const { origins, directions, limits } = questions, mask = 2;
    const options = { tMin: 0.05, tMax: limits, culling: 'back', mask };
    const rowsOf = (kind, lists, begin) => wordsOfLists(kind, lists, { begin, end: (to, i) => to.push(lists.status[i]) });
    const words = {
        scene_facts: [scene.instanceCount, scene.meshCount, ...bits(Float32Array.of(scene.maxError, ...scene.bounds)), ...wordsOf('instance', scene.instances())],
        scene_raycast: wordsOf('scene_hit', scene.raycast(origins, directions, options)),
        scene_occluded: [...scene.occluded(origins, directions, options).status],
        scene_all_hits: rowsOf('scene_hit', scene.allHits(origins, directions, options)),
        scene_closest_point: wordsOf('scene_nearest', scene.closestPoint(origins, 2.5, { mask })),
    };
    const shapes = shapesOf(questions);
    for (const name of ['sphere', 'capsule', 'box', 'oriented_box', 'cone', 'triangle']) {
        const touches = scene.overlaps(shapes[name], { mask });
        words[`scene_${name}`] = rowsOf('scene_triangle', scene.overlappingTriangles(shapes[name], { mask }), (to, i) => to.push(touches.status[i]));
    }
    for (const name of MOVING) {
        const sweeps = scene.sweep(shapes[name], directions, { culling: 'back', ignoreLeaving: true, skin: 0.01, mask });
        words[`scene_sweep_${name}`] = wordsOf('scene_sweep', sweeps);
    }
    return words;
}
