// Volumes, bodies and moving shapes against one blob.
import { cullingNumber, integer, Strided } from './arguments.js';
import { fieldsOf } from './memory/batch.js';
import { PointQueries } from './points.js';
import { YesNo } from './results.js';

/// The fields of each shape, and how many numbers each of them has.
export const VOLUMES = {
    sphere: { center: 3, radius: 1 },
    capsule: { from: 3, to: 3, radius: 1 },
    box: { min: 3, max: 3 },
    orientedBox: { center: 3, halfAxes: 9 },
    cone: { apex: 3, axis: 3, radius: 1 },
    triangle: { a: 3, b: 3, c: 3 },
};
export const MOVING = ['sphere', 'capsule', 'box', 'orientedBox'];
const BODIES = ['sphere', 'capsule', 'orientedBox'];

/// orientedBox: oriented_box
export const nameInC = (kind) => kind.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

export function fieldsOfShape(shape, kinds) {
    if (!kinds.includes(shape?.kind)) throw new RangeError(`the kind of a shape must be one of ${kinds.join(', ')}, not ${shape?.kind}`);
    return fieldsOf(shape, VOLUMES[shape.kind], shape.kind);
}

export class ShapeQueries extends PointQueries {
    overlaps(shape) {
        return this.#ofShapes(shape, Object.keys(VOLUMES), [], (batch, name, shapes) => {
            const answers = batch.allocate(batch.count);
            batch.functions[`wasm_overlaps_${name}`](answers, batch.view, shapes, batch.count);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    overlappingTriangles(shape) {
        return this.#ofShapes(shape, Object.keys(VOLUMES), [], (batch, name, shapes) => {
            const { bytes } = batch.instance.records[name];
            return batch.collect(4, (filled, done, to) => batch.functions[`wasm_collect_overlaps_${name}`](
                filled, batch.view, shapes + done * bytes, to.statuses, to.offsets, to.count, to.items, to.capacity),
            (triangles, count) => batch.copy(Uint32Array, triangles, count));
        });
    }

    contacts(shape, most, margin = 0) {
        integer(most, 'most');
        const margins = new Strided(margin, 1, 'margin');
        return this.#ofShapes(shape, BODIES, [margins], (batch, name, bodies) => {
            const contacts = batch.allocateRecords('contact', batch.count * most), found = batch.allocateRecords('filled');
            batch.functions[`wasm_find_contacts_${name}`](contacts, most, found, batch.view, bodies, batch.placePacked(margins, 1), batch.count);
            return batch.pack('contact', contacts, most, found);
        });
    }

    sweep(shape, displacements, { culling = 'none', ignoreLeaving = false, skin = 0 } = {}) {
        const given = new Strided(displacements, 3, 'displacements');
        const options = { culling: cullingNumber(culling), ignoreLeaving: Number(ignoreLeaving), skin };
        return this.#ofShapes(shape, MOVING, [given], (batch, name, shapes) => {
            const hits = batch.allocateRecords('sweep_hit');
            batch.functions[`wasm_sweep_${name}`](hits, batch.view, shapes, batch.placePacked(given, 3), batch.count,
                                                  batch.allocateStructure('sweep_options', options));
            return batch.columns('sweep_hit', hits);
        });
    }

    #ofShapes(shape, kinds, others, use) {
        const fields = fieldsOfShape(shape, kinds);
        return this.batch([...Object.values(fields), ...others], (batch) => {
            const name = nameInC(shape.kind);
            return use(batch, name, batch.placeRecords(name, fields));
        });
    }
}
