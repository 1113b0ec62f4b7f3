// Edges of triangles, bounds that a bake stored, and how far queries are rounded.
import { column, integers, places, Strided } from './arguments.js';
import { QueryError } from './errors.js';
import { MOVING, shapesOf, ShapeQueries } from './shapes.js';
import { inSource } from './source.js';

const OK = 0;
const ROUNDED = ['segment', 'sphere', 'capsule', 'box', 'orientedBox', 'triangle'];
/// The directions of the slabs of kDopBounds().
const DIRECTIONS = [
    [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1], [1, 1, 1],
    [1, 1, -1], [1, -1, 1], [1, -1, -1],
];

export class EdgeQueries extends ShapeQueries {
    roundingError(shape, displacements) {
        if (displacements !== undefined) {
            const given = new Strided(displacements, 3, 'displacements'), shapes = shapesOf(shape, MOVING);
            return this.#rounded([...shapes.arguments, given], `sweep_${shapes.name}`,
                                 (batch) => [shapes.place(batch), batch.placePacked(given, 3)]);
        }
        if (shape?.kind === 'ray') {
            const rays = {
                origin: places(shape.origin, 'ray.origin'), direction: new Strided(shape.direction, 3, 'ray.direction'),
                tMin: new Strided(0, 1, 'tMin'), tMax: new Strided(0, 1, 'tMax'), culling: new Strided(0, 1, 'culling'),
            };
            return this.#rounded(Object.values(rays), 'ray', (batch) => [batch.placeRecords('ray', rays)]);
        }
        if (shape?.kind !== undefined) {
            const shapes = shapesOf(shape, ROUNDED);
            return this.#rounded(shapes.arguments, shapes.name, (batch) => [shapes.place(batch)]);
        }
        const points = places(shape, 'points');
        return this.#rounded([points], 'point', (batch) => [batch.placePacked(points, 3)]);
    }

    edgeKinds(triangles) {
        const given = column(integers(triangles, 'triangles'), 'triangles');
        return this.batch([given], (batch) => {
            const kinds = batch.allocateRecords('edge_kinds_result');
            batch.functions.wasm_edge_kinds(kinds, batch.view, batch.place(given, Uint32Array).first, batch.count);
            return batch.columns('edge_kinds_result', kinds);
        });
    }

    fixInternalEdgeNormals(triangles, features, normals) {
        const given = new Strided(normals, 3, 'normals');
        const numbers = each(integers(triangles, 'triangles'), given.count, 'triangles');
        const parts = each(integers(features, 'features'), given.count, 'features');
        if (!parts.every((feature) => feature <= 6)) throw new RangeError('features must be integers from 0 to 6, of Feature');
        return this.batch([given], (batch) => {
            const fixed = batch.placePacked(given, 3), ids = batch.allocate(4 * given.count), features = batch.allocate(given.count);
            batch.instance.array(Uint32Array, ids, given.count).set(numbers);
            batch.instance.array(Uint8Array, features, given.count).set(parts);
            batch.functions.wasm_fix_internal_edge_normals(fixed, batch.view, ids, features, given.count);
            return batch.copy(Float32Array, fixed, 3 * given.count);
        });
    }

    boundingSphere() {
        const { center, radius } = this.#stored('sphere_result', 'espalier_bounding_sphere');
        return { kind: 'sphere', center: inSource(center, this.sourceOrigin), radius };
    }

    orientedBounds() {
        const { center, halfAxes } = this.#stored('oriented_box_result', 'espalier_oriented_bounds');
        return { kind: 'orientedBox', center: inSource(center, this.sourceOrigin), halfAxes: Float32Array.from(halfAxes) };
    }

    kDopBounds() {
        const { low, high } = this.#stored('k_dop_result', 'espalier_k_dop_bounds');
        const directions = Float32Array.from(DIRECTIONS.flat()), origin = this.sourceOrigin;
        if (origin === null) return { directions, low: Float32Array.from(low), high: Float32Array.from(high) };
        const along = DIRECTIONS.map((direction) => direction.reduce((sum, x, k) => sum + x * origin[k], 0));
        const moved = (bounds) => Float64Array.from(bounds, (x, i) => x + along[i]);
        return { directions, low: moved(low), high: moved(high) };
    }

    #stored(record, name) {
        const { status, ...bounds } = this.structure(record, name);
        if (status !== OK) this.use((instance) => { throw new QueryError(instance.describeQuery(status), status); });
        return bounds;
    }

    #rounded(argumentsOfAll, name, place) {
        return this.batch(argumentsOfAll, (batch) => {
            const errors = batch.allocateRecords('float_result');
            batch.functions[`wasm_rounding_error_${name}`](errors, batch.view, ...place(batch), batch.count);
            return batch.columns('float_result', errors);
        });
    }
}

/// Returns an integer for each query, of one for each or one for all.
function each(array, count, name) {
    if (array.length === 1) return new Uint32Array(count).fill(array[0]);
    if (array.length !== count) throw new RangeError(`${name} has ${array.length} elements, but another argument has ${count}`);
    return array;
}
