// Volumes, bodies and moving shapes against one blob.
import { cullingNumber, integer, integers, places, Strided } from './arguments.js';
import { placeFlags, refuseFilter } from './filters.js';
import { fieldsOf, PLACE } from './memory/batch.js';
import { PointQueries } from './points.js';
import { YesNo } from './results.js';

/// The fields of each shape of fixed size, and how many numbers each of them has.
const FIELDS = {
    sphere: { center: PLACE, radius: 1 },
    capsule: { from: PLACE, to: PLACE, radius: 1 },
    box: { min: PLACE, max: PLACE },
    orientedBox: { center: PLACE, halfAxes: 9 },
    cone: { apex: PLACE, axis: 3, radius: 1 },
    triangle: { a: PLACE, b: PLACE, c: PLACE },
    segment: { from: PLACE, to: PLACE },
};
export const VOLUMES = ['sphere', 'capsule', 'box', 'orientedBox', 'cone', 'triangle'];
const VOLUMES_OF_BLOBS = [...VOLUMES, 'convexVolume'];
export const MOVING = ['sphere', 'capsule', 'box', 'orientedBox', 'convexHull'];
export const BODIES = ['sphere', 'capsule', 'orientedBox', 'convexHull'];

/// Shapes of any number of parts, and how many numbers each of those has.
const OF_PARTS = { convexHull: { field: 'vertices', components: 3 }, convexVolume: { field: 'planes', components: 4 } };

/// orientedBox: oriented_box
const nameInC = (kind) => kind.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

/// Checks shapes of one kind. Returns its name in C, the arguments, and place(batch), which writes a structure for each
/// query and returns their address.
export function shapesOf(given, kinds) {
    if (!kinds.includes(given?.kind)) throw new RangeError(`the kind of a shape must be one of ${kinds.join(', ')}, not ${given?.kind}`);
    const name = nameInC(given.kind);
    if (Object.hasOwn(OF_PARTS, given.kind)) return shapesOfParts(given, name, OF_PARTS[given.kind]);
    const fields = fieldsOf(given, FIELDS[given.kind], given.kind);
    return { name, arguments: Object.values(fields), place: (batch) => batch.placeRecords(name, fields) };
}

function shapesOfParts(given, name, { field, components }) {
    const parts = places(given[field], `${given.kind}.${field}`, components);
    const offsets = given.offsets == null ? Uint32Array.of(0, parts.count) : integers(given.offsets, `${given.kind}.offsets`);
    const isOrdered = offsets.every((offset, i) => i === 0 || offset >= offsets[i - 1]);
    if (offsets.length === 0 || !isOrdered || offsets.at(-1) > parts.count)
        throw new RangeError(`${given.kind}.offsets must ascend from where the first shape begins to where the last one ends, at most ${parts.count}`);
    const shapes = { name: given.kind, count: offsets.length - 1 };
    return {
        name, arguments: [shapes],
        place(batch) {
            const records = batch.allocateRecords(name), at = batch.allocate(4 * offsets.length);
            batch.instance.array(Uint32Array, at, offsets.length).set(offsets);
            batch.functions[`wasm_place_${name}`](records, batch.count, batch.placeAll(parts, components), at, shapes.count);
            return records;
        },
    };
}

export class ShapeQueries extends PointQueries {
    overlaps(shape, options) {
        refuseFilter(options, 'overlaps of a blob');
        if (options?.accuracy !== undefined) return this.#nearlyOverlaps(shape, options.accuracy);
        return this.#ofShapes(shape, VOLUMES_OF_BLOBS, [], (batch, name, shapes) => {
            const answers = batch.allocate(batch.count);
            batch.functions[`wasm_overlaps_${name}`](answers, batch.view, shapes, batch.count);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    #nearlyOverlaps(shape, accuracy) {
        return this.#ofShapes(shape, ['sphere', 'box'], [], (batch, name, shapes) => {
            const answers = batch.allocate(batch.count);
            batch.functions[`wasm_overlaps_${name}_approximate`](answers, batch.view, shapes, batch.count, accuracy);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    overlappingTriangles(shape, options) {
        refuseFilter(options, 'a list of all triangles');
        return this.#ofShapes(shape, VOLUMES_OF_BLOBS, [], (batch, name, shapes) => {
            const { bytes } = batch.instance.records[name];
            return batch.collect(4, (filled, done, to) => batch.functions[`wasm_collect_overlaps_${name}`](
                filled, batch.view, shapes + done * bytes, to.statuses, to.offsets, to.count, to.items, to.capacity),
            (triangles, count) => batch.copy(Uint32Array, triangles, count));
        });
    }

    contacts(shape, most, margin = 0, options) {
        refuseFilter(options, 'contacts');
        integer(most, 'most');
        const margins = new Strided(margin, 1, 'margin');
        return this.#ofShapes(shape, BODIES, [margins], (batch, name, bodies) => {
            const contacts = batch.allocateRecords('contact', batch.count * most), found = batch.allocateRecords('filled');
            batch.functions[`wasm_find_contacts_${name}`](contacts, most, found, batch.view, bodies, batch.placePacked(margins, 1), batch.count);
            return batch.pack('contact', contacts, most, found);
        });
    }

    planes(capsule, most, margin) {
        integer(most, 'most');
        const margins = new Strided(margin, 1, 'margin');
        return this.#ofShapes(capsule, ['capsule'], [margins], (batch, _, bodies) => {
            const planes = batch.allocateRecords('contact_plane', batch.count * most), found = batch.allocateRecords('filled');
            batch.functions.wasm_collect_planes(planes, most, found, batch.view, bodies, batch.placePacked(margins, 1), batch.count);
            return batch.pack('contact_plane', planes, most, found);
        });
    }

    sweep(shape, displacements, { culling = 'none', ignoreLeaving = false, skin = 0, only } = {}) {
        const given = new Strided(displacements, 3, 'displacements'), flags = this.flags(only);
        const options = { culling: cullingNumber(culling), ignoreLeaving: Number(ignoreLeaving), skin };
        return this.#ofShapes(shape, MOVING, [given], (batch, name, shapes) => {
            const hits = batch.allocateRecords('sweep_hit');
            batch.functions[`wasm_sweep_${name}`](hits, batch.view, shapes, batch.placePacked(given, 3), batch.count,
                                                  batch.allocateStructure('sweep_options', options), placeFlags(batch, flags));
            return batch.columns('sweep_hit', hits);
        });
    }

    #ofShapes(given, kinds, others, use) {
        const shapes = shapesOf(given, kinds);
        return this.batch([...shapes.arguments, ...others], (batch) => use(batch, shapes.name, shapes.place(batch)));
    }
}
