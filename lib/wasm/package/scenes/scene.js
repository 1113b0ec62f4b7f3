// Scenes: many instances of blobs, each with a place in the world.
import { cullingNumber, integer, Strided } from '../arguments.js';
import { Opened } from '../memory/opened.js';
import { YesNo } from '../results.js';
import { MOVING, shapesOf, VOLUMES } from '../shapes.js';

/// Shares a bit with the mask of every instance but 0.
const ALL = 0xFFFFFFFF;

export class Scene extends Opened {
    constructor(instance, bytes) {
        const { functions, records } = instance;
        const parts = (address, length) => ({
            meshes: functions.espalier_scene_mesh_count(address, length) >>> 0,
            tiles: functions.espalier_scene_tile_count(address, length) >>> 0,
        });
        // The scene, its tiles, its meshes.
        super(instance, bytes, (address, length) => {
            const { meshes, tiles } = parts(address, length);
            return records.scene.bytes * (1 + tiles) + records.blob.bytes * meshes;
        }, (view, address, length) => {
            const { meshes, tiles } = parts(address, length), tilesAt = view + records.scene.bytes;
            return functions.espalier_open_scene(address, length, tilesAt + records.scene.bytes * tiles, meshes, tilesAt, tiles, view);
        });
    }

    get instanceCount() {
        return this.use(({ functions }, scene) => functions.espalier_scene_instance_count(scene) >>> 0);
    }
    get meshCount() {
        return this.use(({ functions }, scene) => functions.wasm_scene_mesh_count(scene) >>> 0);
    }
    /// The largest distance between the surface of any instance and its source.
    get maxError() {
        return this.use(({ functions }, scene) => functions.espalier_scene_max_error(scene));
    }
    /// The lower and the upper corner of a box around all instances, in one array.
    get bounds() {
        const { min, max } = this.structure('box', 'espalier_scene_bounds');
        return Float32Array.of(...min, ...max);
    }

    /// Returns all instances, each field in an array.
    instances() {
        const count = this.instanceCount;
        return this.batch([], (batch) => {
            const instances = batch.allocateRecords('instance', count);
            batch.functions.wasm_scene_instances(instances, batch.view);
            return batch.columns('instance', instances, count);
        });
    }

    raycast(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, mask) => {
            const hits = batch.allocateRecords('scene_ray_hit');
            batch.functions.wasm_scene_raycast(hits, batch.view, rays, batch.count, mask);
            return batch.columns('scene_ray_hit', hits);
        });
    }

    occluded(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, mask) => {
            const answers = batch.allocate(batch.count);
            batch.functions.wasm_scene_occluded(answers, batch.view, rays, batch.count, mask);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    allHits(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, mask) =>
            lists(batch, 'scene_ray_hit', 'wasm_scene_all_hits', 'ray', rays, mask));
    }

    closestPoint(points, maxDistance = Infinity, { mask = ALL } = {}) {
        const given = new Strided(points, 3, 'points'), bits = integer(mask, 'mask');
        return this.batch([given], (batch) => {
            const nearest = batch.allocateRecords('scene_closest_point_result');
            batch.functions.wasm_scene_closest_point(nearest, batch.view, batch.placePacked(given, 3), batch.count, maxDistance, bits);
            return batch.columns('scene_closest_point_result', nearest);
        });
    }

    overlaps(shape, options) {
        return this.#ofShapes(shape, VOLUMES, [], options, (batch, name, shapes, mask) => {
            const answers = batch.allocate(batch.count);
            batch.functions[`wasm_scene_overlaps_${name}`](answers, batch.view, shapes, batch.count, mask);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    overlappingTriangles(shape, options) {
        return this.#ofShapes(shape, VOLUMES, [], options, (batch, name, shapes, mask) =>
            lists(batch, 'scene_triangle', `wasm_scene_collect_overlaps_${name}`, name, shapes, mask));
    }

    sweep(shape, displacements, { culling = 'none', ignoreLeaving = false, skin = 0, mask } = {}) {
        const given = new Strided(displacements, 3, 'displacements');
        const options = { culling: cullingNumber(culling), ignoreLeaving: Number(ignoreLeaving), skin };
        return this.#ofShapes(shape, MOVING, [given], { mask }, (batch, name, shapes, bits) => {
            const hits = batch.allocateRecords('scene_sweep_hit');
            batch.functions[`wasm_scene_sweep_${name}`](hits, batch.view, shapes, batch.placePacked(given, 3), batch.count,
                                                        batch.allocateStructure('scene_sweep_options', options), bits);
            return batch.columns('scene_sweep_hit', hits);
        });
    }

    /// Calls use(batch, rays, mask), where rays is the address of an espalier_ray for each query.
    #ofRays(origins, directions, { tMin = 0, tMax = Infinity, culling = 'none', mask = ALL } = {}, use) {
        const given = {
            origin: new Strided(origins, 3, 'origins'), direction: new Strided(directions, 3, 'directions'),
            tMin: new Strided(tMin, 1, 'tMin'), tMax: new Strided(tMax, 1, 'tMax'),
            culling: new Strided(cullingNumber(culling), 1, 'culling'),
        };
        const bits = integer(mask, 'mask');
        return this.batch(Object.values(given), (batch) => use(batch, batch.placeRecords('ray', given), bits));
    }

    #ofShapes(shape, kinds, others, { mask = ALL } = {}, use) {
        const shapes = shapesOf(shape, kinds), bits = integer(mask, 'mask');
        return this.batch([...shapes.arguments, ...others], (batch) => use(batch, shapes.name, shapes.place(batch), bits));
    }
}

/// Returns the lists of a query: `queries` is the address of its records.
function lists(batch, record, name, queryRecord, queries, mask) {
    const { [record]: item, [queryRecord]: query } = batch.instance.records;
    return batch.collect(item.bytes, (filled, done, to) => batch.functions[name](
        filled, batch.view, queries + done * query.bytes, to.statuses, to.offsets, to.count, to.items, to.capacity, mask),
    (items, count) => batch.columns(record, items, count));
}
