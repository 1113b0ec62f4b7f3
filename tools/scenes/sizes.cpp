#include "sizes.hpp"

#include <algorithm>
#include <string_view>

#include <espalier/format.hpp>

#include "layout/blob_layout.hpp"

namespace espalier::tools {

namespace {

/// Whether a blob has the section once, however many triangles it has.
bool is_once(std::string_view section) {
    for (const std::string_view name : {"header", "guard", "oriented_box", "sphere", "k_dop"})
        if (section == name) return true;
    return false;
}

/// Of a mesh with that many bytes of its own. On average half of the alignment is padding.
double bytes_of_variant(double mesh, double instances) {
    constexpr double once =
        static_cast<double>(format::scene::alignment) / 2 + static_cast<double>(format::scene::part_size_bytes);
    constexpr double each = static_cast<double>(format::scene::instance_bytes) + format::packed_node::bytes / 4.0;
    return mesh + once + each * instances;
}

}  // namespace

double bytes_as_part(std::span<const std::byte> bytes, const Blob& blob) {
    const Profile profile = blob.profile();
    const double children = format::max_node_children(profile);
    const double node_bytes = static_cast<double>(format::node_bytes(profile));
    double sum = 0.0;
    for (const Section& section : sections_of(blob)) {
        const auto own = static_cast<double>(section.bytes);
        if (std::string_view(section.name) == "nodes") {
            // Of full nodes there is one for all children but one.
            const double leaves = static_cast<double>(leaf_count(bytes, blob));
            sum += std::min(own, 1.25 * node_bytes * leaves / (children - 1.0));
        } else if (!is_once(section.name)) {
            sum += own;
        }
    }
    return sum;
}

double bytes_of_merging() {
    return bytes_of_variant(static_cast<double>(format::header::bytes + format::guard_bytes), 1.0);
}

double bytes_as_instances(const Blob& blob, std::uint64_t instances) {
    return bytes_of_variant(static_cast<double>(blob.size()), static_cast<double>(instances));
}

}  // namespace espalier::tools
