#include "ways.hpp"

namespace espalier::bench {

std::vector<Way> all_ways(const Mesh& mesh) {
    std::vector<Way> ways;
#ifdef ESPALIER_BENCH_EMBREE
    add_embree_ways(ways, mesh);
#endif
#ifdef ESPALIER_BENCH_MESHOPT
    const Bytes file = write_meshopt(snap_mesh(mesh));
#ifdef ESPALIER_BENCH_EMBREE
    add_embree_meshopt_ways(ways, file);
#endif
    add_espalier_meshopt_ways(ways, file);
#endif
    add_espalier_ways(ways, mesh);
    return ways;
}

}  // namespace espalier::bench
