// Points against one blob: closest points and triangles, inside, and how often the surface winds around.
import { integer, places } from './arguments.js';
import { refuseFilter } from './filters.js';
import { fieldsOf, PLACE } from './memory/batch.js';
import { RayQueries } from './rays.js';
import { YesNo } from './results.js';

const SHAPES = { segment: { from: PLACE, to: PLACE }, box: { min: PLACE, max: PLACE } };

export class PointQueries extends RayQueries {
    closestPoint(points, maxDistance = Infinity, options) {
        refuseFilter(options, 'closestPoint of a blob');
        if (points?.kind !== undefined) return this.#closestToShapes(points, maxDistance);
        return this.#nearest('espalier_closest_point_arrays', points, maxDistance);
    }

    signedDistance(points, maxDistance = Infinity, options) {
        refuseFilter(options, 'signedDistance');
        return this.#nearest('espalier_signed_distance_arrays', points, maxDistance);
    }

    closestTriangles(points, most, maxDistance = Infinity, options) {
        refuseFilter(options, 'closestTriangles');
        integer(most, 'most');
        return this.#ofPoints(points, (batch, given) => {
            const record = 'closest_point_result';
            const nearest = batch.allocateRecords(record, batch.count * most), found = batch.allocateRecords('filled');
            batch.fill('espalier_closest_triangles_arrays', batch.placeStrided(given), nearest, most, found, batch.count, maxDistance);
            return batch.pack(record, nearest, most, found);
        });
    }

    distanceBounds(points, accuracy, maxDistance = Infinity) {
        return this.#ofPoints(points, (batch, given) => {
            const bounds = batch.allocateRecords('distance_bounds_result'), packed = batch.placePacked(given, 3);
            batch.functions.wasm_distance_bounds(bounds, batch.view, packed, batch.count, maxDistance, accuracy);
            return batch.columns('distance_bounds_result', bounds);
        });
    }

    contains(points, options) {
        refuseFilter(options, 'contains');
        return this.#ofPoints(points, (batch, given) => {
            const answers = batch.allocate(batch.count);
            batch.fill('espalier_contains_arrays', batch.placeStrided(given), answers, batch.count);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    windingNumber(points, directions = 64, options) {
        refuseFilter(options, 'windingNumber');
        integer(directions, 'directions');
        return this.#ofPoints(points, (batch, given) => {
            const numbers = batch.allocateRecords('float_result');
            const packed = batch.placePacked(given, 3);
            batch.functions.wasm_winding_number(numbers, batch.view, packed, batch.count, directions);
            return batch.columns('float_result', numbers);
        });
    }

    #ofPoints(points, use) {
        const given = places(points, 'points');
        return this.batch([given], (batch) => use(batch, given));
    }

    #nearest(name, points, maxDistance) {
        return this.#ofPoints(points, (batch, given) => {
            const nearest = batch.allocateRecords('closest_point_result');
            batch.fill(name, batch.placeStrided(given), nearest, batch.count, maxDistance);
            return batch.columns('closest_point_result', nearest);
        });
    }

    #closestToShapes(shape, maxDistance) {
        const components = Object.hasOwn(SHAPES, shape.kind) ? SHAPES[shape.kind] : null;
        if (!components) throw new RangeError(`closestPoint takes points, or a segment or box, and no ${shape.kind}`);
        const fields = fieldsOf(shape, components, shape.kind);
        return this.batch(Object.values(fields), (batch) => {
            const nearest = batch.allocateRecords('closest_point_result');
            batch.functions[`wasm_closest_point_${shape.kind}`](
                nearest, batch.view, batch.placeRecords(shape.kind, fields), batch.count, maxDistance);
            return batch.columns('closest_point_result', nearest);
        });
    }
}
