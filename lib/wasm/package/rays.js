// Rays against one blob: the points origin + t * direction with tMin <= t <= tMax.
import { cullingNumber, integer, Strided } from './arguments.js';
import { Opened } from './memory/opened.js';
import { YesNo } from './results.js';

export class RayQueries extends Opened {
    raycast(origins, directions, options) {
        return this.#cast(origins, directions, options, (batch, rays) => {
            const hits = batch.allocateRecords('ray_hit');
            batch.fill('espalier_raycast_arrays', rays(0), hits, batch.count);
            return batch.columns('ray_hit', hits);
        });
    }

    occluded(origins, directions, options) {
        return this.#cast(origins, directions, options, (batch, rays) => {
            const answers = batch.allocate(batch.count);
            batch.fill('espalier_occluded_arrays', rays(0), answers, batch.count);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    closestHits(origins, directions, most, options) {
        integer(most, 'most');
        return this.#cast(origins, directions, options, (batch, rays) => {
            const hits = batch.allocateRecords('ray_hit', batch.count * most), found = batch.allocateRecords('filled');
            batch.fill('espalier_closest_hits_arrays', rays(0), hits, most, found, batch.count);
            return batch.pack('ray_hit', hits, most, found);
        });
    }

    allHits(origins, directions, options) {
        return this.#lists('espalier_collect_hits_arrays', origins, directions, options);
    }

    crossings(origins, directions, options) {
        return this.#lists('espalier_collect_crossings_arrays', origins, directions, options);
    }

    #lists(name, origins, directions, options) {
        return this.#cast(origins, directions, options, (batch, rays) =>
            batch.collect(batch.instance.records.ray_hit.bytes, (filled, done, to) =>
                batch.functions[name](filled, batch.view, rays(done), to.statuses, to.offsets, to.count, to.items, to.capacity),
            (hits, count) => batch.columns('ray_hit', hits, count)));
    }

    /// Calls use(batch, rays), where rays(n) is the address of an espalier_ray_arrays of the rays from n on.
    #cast(origins, directions, { tMin = 0, tMax = Infinity, culling = 'none' } = {}, use) {
        const given = {
            origins: new Strided(origins, 3, 'origins'), directions: new Strided(directions, 3, 'directions'),
            tMin: new Strided(tMin, 1, 'tMin'), tMax: new Strided(tMax, 1, 'tMax'),
        };
        const number = cullingNumber(culling);
        return this.batch(Object.values(given), (batch) => {
            const placed = Object.entries(given).map(([name, argument]) => [name, batch.place(argument)]);
            const structure = batch.allocateStructure('ray_arrays', { culling: number });
            const rays = (from) => {
                for (const [name, { first, stride }] of placed)
                    batch.instance.write('ray_arrays', structure, {
                        [`${name}.first`]: first + from * stride, [`${name}.stride`]: stride,
                    });
                return structure;
            };
            return use(batch, rays);
        });
    }
}
