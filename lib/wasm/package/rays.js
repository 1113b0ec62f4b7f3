// Rays against one blob: the points origin + t * direction with tMin <= t <= tMax.
import { cullingNumber, integer, places, Strided } from './arguments.js';
import { flagsOf, placeFlags, refuseFilter } from './filters.js';
import { Opened } from './memory/opened.js';
import { YesNo } from './results.js';

export class RayQueries extends Opened {
    raycast(origins, directions, options) {
        return this.#castFiltered(origins, directions, options, (batch, rays, only) => {
            const hits = batch.allocateRecords('ray_hit');
            if (only === 0) batch.fill('espalier_raycast_arrays', rays(0), hits, batch.count);
            else batch.functions.wasm_raycast_filtered(hits, batch.view, rays(0), batch.count, only);
            return batch.columns('ray_hit', hits);
        });
    }

    occluded(origins, directions, options) {
        if (options?.accuracy !== undefined) return this.#nearlyOccluded(origins, directions, options);
        return this.#castFiltered(origins, directions, options, (batch, rays, only) => {
            const answers = batch.allocate(batch.count);
            if (only === 0) batch.fill('espalier_occluded_arrays', rays(0), answers, batch.count);
            else batch.functions.wasm_occluded_filtered(answers, batch.view, rays(0), batch.count, only);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    #nearlyOccluded(origins, directions, { accuracy, tMin = 0, tMax = Infinity, culling = 'none', ...others }) {
        refuseFilter(others, 'a ray with an accuracy');
        const rays = {
            origin: places(origins, 'origins'), direction: new Strided(directions, 3, 'directions'),
            tMin: new Strided(tMin, 1, 'tMin'), tMax: new Strided(tMax, 1, 'tMax'),
            culling: new Strided(cullingNumber(culling), 1, 'culling'),
        };
        return this.batch(Object.values(rays), (batch) => {
            const answers = batch.allocate(batch.count);
            batch.functions.wasm_occluded_approximate(answers, batch.view, batch.placeRecords('ray', rays), batch.count, accuracy);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    closestHits(origins, directions, most, options) {
        integer(most, 'most');
        return this.#castFiltered(origins, directions, options, (batch, rays, only) => {
            const hits = batch.allocateRecords('ray_hit', batch.count * most), found = batch.allocateRecords('filled');
            if (only === 0) batch.fill('espalier_closest_hits_arrays', rays(0), hits, most, found, batch.count);
            else batch.functions.wasm_closest_hits_filtered(hits, most, found, batch.view, rays(0), batch.count, only);
            return batch.pack('ray_hit', hits, most, found);
        });
    }

    allHits(origins, directions, options) {
        return this.#lists('espalier_collect_hits_arrays', origins, directions, options);
    }

    crossings(origins, directions, options) {
        return this.#lists('espalier_collect_crossings_arrays', origins, directions, options);
    }

    /// Returns the flags of triangles.
    flags(only) {
        return flagsOf(only, this.triangleCount, 'triangles');
    }

    #lists(name, origins, directions, options) {
        refuseFilter(options, 'a list of all hits');
        return this.#cast(origins, directions, options, (batch, rays) =>
            batch.collect(batch.instance.records.ray_hit.bytes, (filled, done, to) =>
                batch.functions[name](filled, batch.view, rays(done), to.statuses, to.offsets, to.count, to.items, to.capacity),
            (hits, count) => batch.columns('ray_hit', hits, count)));
    }

    /// Calls use(batch, rays, only), where `only` is the address of an espalier_flags, or 0 for all triangles.
    #castFiltered(origins, directions, options, use) {
        const flags = this.flags(options?.only);
        return this.#cast(origins, directions, options, (batch, rays) => use(batch, rays, placeFlags(batch, flags)));
    }

    /// Calls use(batch, rays), where rays(n) is the address of an espalier_ray_arrays of the rays from n on.
    #cast(origins, directions, { tMin = 0, tMax = Infinity, culling = 'none' } = {}, use) {
        const given = {
            origins: places(origins, 'origins'), directions: new Strided(directions, 3, 'directions'),
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
