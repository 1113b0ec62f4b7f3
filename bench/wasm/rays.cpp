// Rays in WebAssembly: compare.mjs loads this program with and without SIMD128 and times both. It links the runtime
// alone; its caller lends it the memory from __heap_base on.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <espalier/espalier.hpp>

namespace {

espalier::Blob blob;

struct Line {
    espalier::Vec3 origin;
    espalier::Vec3 direction;
};

}  // namespace

/// Opens a blob whose bytes stay where they are. Returns 0 if they are refused.
extern "C" [[clang::export_name("open_blob")]] std::uint32_t open_blob(const std::byte* bytes, std::size_t size) {
    blob = espalier::open({bytes, size});
    return blob ? 1 : 0;
}

extern "C" [[clang::export_name("store_bounds")]] void store_bounds(espalier::Box* bounds) { *bounds = blob.bounds(); }

extern "C" [[clang::export_name("bytes_of_hit")]] std::size_t bytes_of_hit() { return sizeof(espalier::RayHit); }

/// Stores the closest hit of each ray; t is -1 where there is none. Returns how many rays hit.
extern "C" [[clang::export_name("closest_hits")]] std::uint32_t closest_hits(const Line* rays, std::size_t count,
                                                                             espalier::RayHit* hits) {
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        hits[i] = espalier::raycast(blob, {.origin = rays[i].origin, .direction = rays[i].direction});
        if (hits[i]) ++found;
        else hits[i].t = -1.0f;
    }
    return found;
}

/// Stores for each ray, in the t of its place, 1 if it hits anything, else 0. Returns how many rays hit.
extern "C" [[clang::export_name("any_hits")]] std::uint32_t any_hits(const Line* rays, std::size_t count,
                                                                     espalier::RayHit* hits) {
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const espalier::Ray ray = {.origin = rays[i].origin, .direction = rays[i].direction};
        const bool is_hit = espalier::occluded(blob, ray).yes();
        hits[i] = {.t = is_hit ? 1.0f : 0.0f};
        found += is_hit ? 1 : 0;
    }
    return found;
}
