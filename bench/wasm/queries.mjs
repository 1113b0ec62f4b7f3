// Queries about a box around a mesh: rays with directions of length 1, and points.
import { randomNumbers } from '../../tests/wasm/support/questions.mjs';

function normalised(direction) {
    const length = Math.hypot(...direction);
    return direction.map((x) => x / length);
}

/// As bench/base.cpp has them: from a sphere around the asset towards random points in its box.
export function incoherentRays(bounds, count, seed = 1) {
    const random = randomNumbers(seed), origins = [], directions = [];
    const radius = 0.6 * Math.hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
    while (origins.length < 3 * count) {
        const s = [0, 1, 2].map(() => 2 * random() - 1), length = Math.hypot(...s);
        if (length > 1 || length < 0.03) continue;
        const from = s.map((x, k) => (bounds[k] + bounds[3 + k]) / 2 + x * radius / length);
        origins.push(...from);
        directions.push(...normalised(from.map((x, k) => bounds[k] + random() * (bounds[3 + k] - bounds[k]) - x)));
    }
    return { origins: Float32Array.from(origins), directions: Float32Array.from(directions) };
}

/// Rows of a picture from the front.
export function coherentRays(bounds, count) {
    const side = Math.floor(Math.sqrt(count)), origins = [], directions = [];
    const radius = 0.5 * Math.hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]);
    const center = [0, 1, 2].map((k) => (bounds[k] + bounds[3 + k]) / 2);
    for (let row = 0; row < side; ++row)
        for (let column = 0; column < side; ++column) {
            const across = (i) => radius * (2 * i + 1 - side) / side;
            origins.push(center[0], center[1], center[2] + 2.4 * radius);
            directions.push(...normalised([across(column), across(row), -2.4 * radius]));
        }
    return { origins: Float32Array.from(origins), directions: Float32Array.from(directions) };
}

/// Points in the box, enlarged by a quarter.
export function points(bounds, count) {
    const random = randomNumbers(3);
    return Float32Array.from({ length: 3 * count }, (_, i) => {
        const [low, high] = [bounds[i % 3], bounds[3 + i % 3]];
        return low + (1.25 * random() - 0.125) * (high - low);
    });
}
