// The queries of baked and of moving scenes. Shapes and results are in world space.
import { cullingNumber, integer, places, Strided } from '../arguments.js';
import { placeFlags, refuseFilter } from '../filters.js';
import { YesNo } from '../results.js';
import { BODIES, MOVING, shapesOf, VOLUMES } from '../shapes.js';
import { ALL } from './instances.js';

/// Adds the queries to a class whose view is an espalier_scene, and which has flags(only): the flags of its instances.
/// `sorts`: its lists are not in ascending order of instances by themselves.
export const withSceneQueries = (Base, { sorts }) => class extends Base {
    raycast(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, selection) => {
            const hits = batch.allocateRecords('scene_ray_hit');
            batch.functions.wasm_scene_raycast(hits, batch.view, rays, batch.count, selection);
            return batch.columns('scene_ray_hit', hits);
        });
    }

    occluded(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, selection) => {
            const answers = batch.allocate(batch.count);
            batch.functions.wasm_scene_occluded(answers, batch.view, rays, batch.count, selection);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    allHits(origins, directions, options) {
        return this.#ofRays(origins, directions, options, (batch, rays, selection) =>
            lists(batch, 'scene_ray_hit', 'wasm_scene_all_hits', 'ray', rays, selection));
    }

    closestPoint(points, maxDistance = Infinity, { mask = ALL, ...others } = {}) {
        const given = places(points, 'points'), bits = integer(mask, 'mask');
        refuseFilter(others, 'closestPoint of a scene');
        return this.batch([given], (batch) => {
            const nearest = batch.allocateRecords('scene_closest_point_result');
            batch.functions.wasm_scene_closest_point(nearest, batch.view, batch.placePacked(given, 3), batch.count, maxDistance, bits);
            return batch.columns('scene_closest_point_result', nearest);
        });
    }

    candidates(box, options) {
        refuseFilter(options, 'candidates');
        return this.#ofShapes(box, ['box'], [], options, (batch, name, boxes, selection) =>
            lists(batch, 'scene_candidate', 'wasm_scene_candidates', name, boxes, selection));
    }

    overlaps(shape, options) {
        return this.#ofShapes(shape, VOLUMES, [], options, (batch, name, shapes, selection) => {
            const answers = batch.allocate(batch.count);
            batch.functions[`wasm_scene_overlaps_${name}`](answers, batch.view, shapes, batch.count, selection);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    overlappingTriangles(shape, options) {
        return this.#ofShapes(shape, VOLUMES, [], options, (batch, name, shapes, selection) =>
            lists(batch, 'scene_triangle', `wasm_scene_collect_overlaps_${name}`, name, shapes, selection));
    }

    contacts(shape, most, margin = 0, options) {
        integer(most, 'most');
        const margins = new Strided(margin, 1, 'margin');
        return this.#ofShapes(shape, BODIES, [margins], options, (batch, name, bodies, selection) => {
            const contacts = batch.allocateRecords('scene_contact', batch.count * most), found = batch.allocateRecords('filled');
            batch.functions[`wasm_scene_find_contacts_${name}`](contacts, most, found, batch.view, bodies, batch.placePacked(margins, 1),
                                                                batch.count, batch.allocateRecords('contact', most), selection);
            return batch.pack('scene_contact', contacts, most, found);
        });
    }

    sweep(shape, displacements, { culling = 'none', ignoreLeaving = false, skin = 0, ...selected } = {}) {
        const given = new Strided(displacements, 3, 'displacements');
        const options = { culling: cullingNumber(culling), ignoreLeaving: Number(ignoreLeaving), skin };
        return this.#ofShapes(shape, MOVING, [given], selected, (batch, name, shapes, selection) => {
            const hits = batch.allocateRecords('scene_sweep_hit');
            batch.functions[`wasm_scene_sweep_${name}`](hits, batch.view, shapes, batch.placePacked(given, 3), batch.count,
                                                        batch.allocateStructure('scene_sweep_options', options), selection);
            return batch.columns('scene_sweep_hit', hits);
        });
    }

    /// Calls use(batch, rays, selection), where rays is the address of an espalier_ray for each query.
    #ofRays(origins, directions, { tMin = 0, tMax = Infinity, culling = 'none', ...selected } = {}, use) {
        const given = {
            origin: places(origins, 'origins'), direction: new Strided(directions, 3, 'directions'),
            tMin: new Strided(tMin, 1, 'tMin'), tMax: new Strided(tMax, 1, 'tMax'),
            culling: new Strided(cullingNumber(culling), 1, 'culling'),
        };
        const placeSelection = this.#selection(selected);
        return this.batch(Object.values(given), (batch) => use(batch, batch.placeRecords('ray', given), placeSelection(batch)));
    }

    #ofShapes(given, kinds, others, selected, use) {
        const shapes = shapesOf(given, kinds), placeSelection = this.#selection(selected);
        return this.batch([...shapes.arguments, ...others], (batch) => use(batch, shapes.name, shapes.place(batch), placeSelection(batch)));
    }

    /// Checks what a query takes into account. Returns a function of a batch, which returns the address of that.
    #selection({ mask = ALL, only } = {}) {
        const bits = integer(mask, 'mask'), flags = this.flags(only);
        return (batch) => batch.allocateStructure('scene_selection', { only: placeFlags(batch, flags), mask: bits, sorts: Number(sorts) });
    }
};

/// Returns the lists of a query: `queries` is the address of its records.
function lists(batch, record, name, queryRecord, queries, selection) {
    const { [record]: item, [queryRecord]: query } = batch.instance.records;
    return batch.collect(item.bytes, (filled, done, to) => batch.functions[name](
        filled, batch.view, queries + done * query.bytes, to.statuses, to.offsets, to.count, to.items, to.capacity, selection),
    (items, count) => batch.columns(record, items, count));
}
