#include "trees.hpp"

#include "../traversal/corners.hpp"

namespace espalier::bench {
namespace {

/// The triangles of a node follow one another.
struct Range {
    std::size_t first;
    std::size_t end;
};

}  // namespace

std::vector<Volumes> fit_nodes(const AabbTree& topology) {
    // Children come after their parent, so that their ranges are there when its own is joined.
    std::vector<Range> ranges(topology.nodes.size());
    for (std::size_t i = topology.nodes.size(); i-- > 0;) {
        const AabbNode& node = topology.nodes[i];
        if (node.is_leaf()) ranges[i] = {node.first, std::size_t{node.first} + node.count};
        else ranges[i] = {ranges[node.first].first, ranges[node.first + 1].end};
    }
    std::vector<Volumes> volumes;
    volumes.reserve(ranges.size());
    std::vector<Point> points;
    for (const Range& range : ranges) {
        points.clear();
        for (std::size_t i = range.first; i < range.end; ++i)
            for (const Vec3& corner : topology.triangles[i]) points.push_back(point_of(corner));
        volumes.push_back(fit_volumes(points));
    }
    return volumes;
}

}  // namespace espalier::bench
