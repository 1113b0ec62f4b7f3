// The kinds of edges at which one blob's surface goes on in another blob.
#include <espalier/bake.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/contact.hpp>
#include <espalier/format.hpp>
#include <runtime/blob/checksum.hpp>
#include <runtime/blob/duplicate_references.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/base/edge_table.hpp>
#include <baker/base/expected.hpp>
#include <baker/base/indexed_hash_set.hpp>
#include <baker/sections/edge_flags.hpp>
#include <baker/verify/decode_tree.hpp>

namespace espalier {

namespace baker {

namespace {

using detail::Integer3;
using Kinds = std::array<std::uint8_t, 3>;

constexpr auto boundary = static_cast<std::uint8_t>(EdgeKind::boundary);

/// An edge that one triangle of a blob has alone.
struct BorderEdge {
    Integer3 low, high;  ///< its ends on the common lattice
    bool ascends;        ///< from low to high
    std::uint32_t blob;
    std::uint32_t triangle;
    std::uint8_t number;
    bool is_crowded = false;  ///< another blob has two triangles there or more

    [[nodiscard]] auto ends() const { return std::tuple(low.x, low.y, low.z, high.x, high.y, high.z); }
};

/// A blob on the lattice that it shares with others.
struct Part {
    Blob blob;
    Integer3 origin{};  ///< in steps from that of the first
    std::uint32_t flat_limit = 0;
    std::vector<std::array<Integer3, 3>> corners;  ///< of each storage index, from `origin`
    std::vector<Kinds> kinds;                      ///< of each storage index that is no copy

    [[nodiscard]] TriangleAtEdge at(const BorderEdge& edge) const {
        const auto corner = [&](unsigned k) { return corners[edge.triangle][(edge.number + k) % 3u] + origin; };
        return {corner(0), corner(1), corner(2)};
    }
};

Refusal refuse(std::size_t number, const std::string& what) {
    return {BakeStatus::invalid_mesh, "blob " + std::to_string(number) + ' ' + what};
}

/// The corners of each storage index.
std::vector<std::array<Integer3, 3>> corners_of(const detail::BlobData& data) {
    std::vector<std::array<Integer3, 3>> corners(data.triangle_count);
    const TreeBytes tree{{data.nodes, data.node_count * format::node_bytes(data.profile)},
                         {data.leaves, data.leaf_bytes},
                         data.bits,
                         data.profile,
                         data.copies != nullptr,
                         {data.extent[0], data.extent[1], data.extent[2]}};
    DecodedNode node;
    DecodedLeaf leaf;
    for (std::uint32_t number = 0; number < data.node_count && tree.decode_node(number, node); ++number) {
        for (unsigned i = 0; i < node.leaves && tree.decode_leaf(node, i, leaf); ++i) {
            for (std::size_t t = 0; t < leaf.triangle_count; ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const Coordinates& at = leaf.vertices[leaf.corners[t][k]];
                    corners[leaf.first_triangle + t][k] = {at[0], at[1], at[2]};
                }
            }
        }
    }
    return corners;
}

Expected<Part> open_part(const JoinedBlob& placed, std::size_t number, const JoinedBlob& first) {
    Part part;
    part.blob = open(placed.bytes);
    if (!part.blob) return refuse(number, std::string("does not open: ") + describe(part.blob.status()));
    if (!part.blob.has_edge_flags()) return refuse(number, "has no edge flags; bake it with flat_angle");
    const detail::BlobData& data = detail::data_of(part.blob);
    part.flat_limit = detail::load_u32(data.edge_flags + format::edge_flags::flat_limit_at);
    const Blob base = open(first.bytes);
    const espalier::Lattice lattice = part.blob.lattice(), common = base.lattice();
    if (lattice.step_exponent != common.step_exponent)
        return refuse(number, "has another lattice step than blob 0; bake all with one resolution");
    const auto steps = [&](float origin, float move, float from, float from_move) {
        return std::ldexp(double(origin) + double(move) - double(from) - double(from_move), -lattice.step_exponent);
    };
    const double away[3] = {steps(lattice.origin.x, placed.translation.x, common.origin.x, first.translation.x),
                            steps(lattice.origin.y, placed.translation.y, common.origin.y, first.translation.y),
                            steps(lattice.origin.z, placed.translation.z, common.origin.z, first.translation.z)};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::abs(away[k]) < 0x1p40) || away[k] != std::floor(away[k]))
            return refuse(number,
                          "does not lie a whole number of lattice steps from blob 0; its translation must be a "
                          "multiple of the step");
        part.origin[k] = static_cast<std::int64_t>(away[k]);
    }
    part.corners = corners_of(data);
    part.kinds.resize(data.triangle_count);
    for (std::uint32_t index = 0; index < data.triangle_count; ++index) {
        const EdgeKinds kinds = *edge_kinds(part.blob, TriangleId{index});
        part.kinds[index] = {static_cast<std::uint8_t>(kinds.ab), static_cast<std::uint8_t>(kinds.bc),
                             static_cast<std::uint8_t>(kinds.ca)};
    }
    return part;
}

/// Calls function(edge, count) for each edge of a blob, as one of its triangles runs along it, and the number of these.
template <class Function>
void for_each_edge(const Part& part, std::uint32_t number, Function function) {
    IndexedHashSet points(part.corners.size() * 3);
    std::vector<Integer3> vertices;
    std::vector<std::array<std::uint32_t, 3>> numbers;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t index = 0; index < part.corners.size(); ++index) {
        if (detail::owner_of(detail::data_of(part.blob), index) != index) continue;
        std::array<std::uint32_t, 3> of_corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Integer3& at = part.corners[index][i];
            const LatticePoint point{static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y),
                                     static_cast<std::int32_t>(at.z)};
            of_corners[i] = points.find_or_insert(hash_of(point), static_cast<std::uint32_t>(vertices.size()),
                                                  [&](std::uint32_t other) { return is_zero(vertices[other] - at); });
            if (of_corners[i] == vertices.size()) vertices.push_back(at);
        }
        numbers.push_back(of_corners);
        triangles.push_back(index);
    }
    const EdgeTable table(static_cast<std::uint32_t>(numbers.size()), vertices.size(),
                          [&](std::uint32_t i) -> const std::array<std::uint32_t, 3>& { return numbers[i]; });
    table.for_each_pair([&](std::uint32_t, std::span<const TriangleEdge> edges) {
        BorderEdge edge{{}, {}, true, number, triangles[edges[0].triangle], edges[0].number};
        const TriangleAtEdge at = part.at(edge);
        edge.low = at[0];
        edge.high = at[1];
        edge.ascends = std::tuple(at[0].x, at[0].y, at[0].z) < std::tuple(at[1].x, at[1].y, at[1].z);
        if (!edge.ascends) std::swap(edge.low, edge.high);
        function(edge, edges.size());
    });
}

/// The edges that one triangle of a blob has alone, sorted by their ends. They are called boundaries, whatever an
/// earlier call made of them.
std::vector<BorderEdge> find_borders(std::vector<Part>& parts) {
    std::vector<BorderEdge> border;
    for (std::uint32_t number = 0; number < parts.size(); ++number) {
        for_each_edge(parts[number], number, [&](const BorderEdge& edge, std::size_t count) {
            if (count != 1) return;
            parts[number].kinds[edge.triangle][edge.number] = boundary;
            border.push_back(edge);
        });
    }
    const auto before = [](const BorderEdge& a, const BorderEdge& b) { return a.ends() < b.ends(); };
    std::ranges::stable_sort(border, before);
    // Where a third blob has several triangles, the edge is no border between two.
    for (std::uint32_t number = 0; parts.size() > 2 && number < parts.size(); ++number) {
        for_each_edge(parts[number], number, [&](const BorderEdge& edge, std::size_t count) {
            if (count == 1) return;
            const auto [begin, end] = std::equal_range(border.begin(), border.end(), edge, before);
            std::for_each(begin, end, [](BorderEdge& same) { same.is_crowded = true; });
        });
    }
    return border;
}

/// Writes the flags of each storage index; a copy has the corners of its owner, perhaps from another one on.
void write(std::span<std::byte> bytes, const Part& part) {
    using namespace format::edge_flags;
    const detail::BlobData& data = detail::data_of(part.blob);
    std::byte* const fields = bytes.data() + (data.edge_flags - bytes.data()) + fields_at;
    for (std::uint32_t index = 0; index < part.corners.size(); ++index) {
        const std::uint32_t owner = detail::owner_of(data, index);
        unsigned turn = 0;
        while (turn < 2 && !is_zero(part.corners[index][0] - part.corners[owner][turn])) ++turn;
        for (unsigned edge = 0; edge < 3; ++edge) {
            const std::uint64_t bit = std::uint64_t{index} * triangle_bits + std::uint64_t{edge} * edge_bits;
            const unsigned shift = bit % 8;
            std::byte& field = fields[bit / 8];
            field = (field & ~std::byte(3u << shift)) | std::byte(part.kinds[owner][(turn + edge) % 3u] << shift);
        }
    }
    set_u32(bytes.data() + format::header::checksum_at, detail::checksum_of_blob(bytes));
}

Expected<std::uint64_t> join(std::span<const JoinedBlob> blobs) {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        Expected<Part> part = open_part(blobs[i], i, blobs[0]);
        if (!part) return part.refusal();
        if (i != 0 && part->flat_limit != parts[0].flat_limit)
            return refuse(i, "was baked with another flat_angle than blob 0");
        parts.push_back(std::move(*part));
    }
    const std::vector<BorderEdge> border = find_borders(parts);
    std::uint64_t joined = 0;
    for (auto begin = border.begin(); begin != border.end();) {
        const auto end =
            std::find_if(begin, border.end(), [&](const BorderEdge& e) { return e.ends() != begin->ends(); });
        if (end - begin == 2 && begin[0].ascends != begin[1].ascends && !begin[0].is_crowded) {
            const EdgeKind kind =
                kind_of_edge(parts[begin[0].blob].at(begin[0]), parts[begin[1].blob].at(begin[1]), parts[0].flat_limit);
            for (const BorderEdge* edge : {&begin[0], &begin[1]})
                parts[edge->blob].kinds[edge->triangle][edge->number] = static_cast<std::uint8_t>(kind);
            ++joined;
        }
        begin = end;
    }
    for (std::size_t i = 0; i < blobs.size(); ++i) write(blobs[i].bytes, parts[i]);
    return joined;
}

}  // namespace

}  // namespace baker

JoinReport join_borders(std::span<const JoinedBlob> blobs) {
    const auto joined = baker::join(blobs);
    if (!joined) return {joined.refusal().status, joined.refusal().message, 0};
    return {BakeStatus::ok, {}, *joined};
}

}  // namespace espalier
