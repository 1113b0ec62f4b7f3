#include "decoder.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "bytes_reader.hpp"
#include "leaf_decoder.hpp"

namespace espalier::tests {

using namespace decoding;

namespace {

class Decoder {
public:
    explicit Decoder(std::span<const std::byte> bytes) : bytes_(bytes) {}

    DecodedBlob run() {
        read_header();
        if (node_count_ > 0) read_nodes();
        if (decoded_.triangles.size() != decoded_.triangle_count) {
            throw std::runtime_error("decoder: the leaves hold another number of triangles than the header says");
        }
        read_optional_sections();
        return std::move(decoded_);
    }

private:
    [[nodiscard]] bool has_copies() const { return (decoded_.features & format::feature::split_references) != 0; }
    [[nodiscard]] std::size_t source_origin_bytes() const { return (decoded_.features & 1u << 11) != 0 ? 24 : 0; }
    [[nodiscard]] bool is_deformable() const { return (decoded_.features & format::feature::deformable) != 0; }

    void read_header() {
        namespace at = format::header;
        decoded_.features = bytes_.u32(at::features_at);
        decoded_.profile = static_cast<Profile>(bytes_.u8(at::profile_at));
        has_strips_ = decoded_.profile != Profile::fast;
        decoded_.bits = bytes_.u8(at::bits_at);
        decoded_.step_exponent = static_cast<std::int16_t>(bytes_.u16(at::step_exponent_at));
        decoded_.triangle_count = bytes_.u32(at::triangle_count_at);
        decoded_.vertex_count = bytes_.u32(at::vertex_count_at);
        node_count_ = bytes_.u32(at::node_count_at);
        leaf_bytes_ = bytes_.u32(at::leaf_bytes_at);
        for (unsigned axis = 0; axis < 3; ++axis) {
            decoded_.origin[axis] = bytes_.f32(at::origin_at + 4 * axis);
            decoded_.extent[axis] = bytes_.u32(at::extent_at + 4 * axis);
        }
        decoded_.max_error = bytes_.f32(at::max_error_at);
        decoded_.depth = bytes_.u8(at::depth_at);
        id_kind_bits_ = bytes_.u8(at::id_kind_bits_at);
        source_count_ = bytes_.u32(at::source_count_at);
        decoded_.source_triangles = bytes_.u32(at::source_triangles_at);
        leaves_at_ = at::bytes + std::size_t{node_count_} * (has_strips_ ? 64 : 256);
        if (is_deformable()) read_motion();
    }

    /// The last two sections of a deformable blob are found from its end.
    void read_motion() {
        namespace at = format::header;
        if (has_strips_) throw std::runtime_error("decoder: a deformable blob has another profile than fast");
        decoded_.position_count = bytes_.u32(at::position_count_at);
        decoded_.rest_cost = bytes_.f32(at::rest_cost_at);
        for (unsigned axis = 0; axis < 3; ++axis) {
            decoded_.pose.low[axis] = static_cast<std::int32_t>(bytes_.u32(at::pose_low_at + 4 * axis));
            decoded_.pose.high[axis] = static_cast<std::int32_t>(bytes_.u32(at::pose_high_at + 4 * axis));
        }
        vertex_slots_ = bytes_.u32(at::vertex_slots_at);
        const std::size_t number_bytes = decoded_.position_count > 65536 ? 4 : 2;
        const std::size_t source_bytes = padded(number_bytes * vertex_slots_);
        const std::size_t corner_bytes = std::size_t{3} * decoded_.triangle_count;
        const std::size_t end = bytes_.u32(at::total_bytes_at) - source_origin_bytes();
        if (source_bytes + 64 + padded(corner_bytes) > end)
            throw std::runtime_error("decoder: the corners and the vertex sources are more than the blob");
        vertex_sources_at_ = end - source_bytes;
        corner_rows_.at = vertex_sources_at_ - 64 - padded(corner_bytes);
        corner_rows_.end = corner_rows_.at + corner_bytes;
    }

    [[nodiscard]] std::uint32_t vertex_source(std::size_t slot) const {
        if (slot >= vertex_slots_) throw std::runtime_error("decoder: leaves have more vertices than have a source");
        const std::uint32_t source = decoded_.position_count > 65536 ? bytes_.u32(vertex_sources_at_ + 4 * slot)
                                                                     : bytes_.u16(vertex_sources_at_ + 2 * slot);
        if (source >= decoded_.position_count)
            throw std::runtime_error("decoder: a vertex has a position that there is not");
        return source;
    }

    // Leaf blocks hold consecutive storage indices but are reached in the order of the nodes, so each leaf's triangles
    // are put where its block says.
    void read_nodes() {
        decoded_.nodes.resize(node_count_);
        decoded_.nodes[0].depth = 1;
        decoded_.triangles.resize(decoded_.triangle_count);
        if (is_deformable()) decoded_.corner_sources.resize(decoded_.triangle_count);
        std::vector<std::pair<std::uint32_t, std::uint8_t>> leaf_sizes;
        std::size_t filled = 0;
        for (std::uint32_t node = 0; node < node_count_; ++node) read_node(node, leaf_sizes, filled);
        if (filled != decoded_.triangle_count) {
            throw std::runtime_error("decoder: the leaves hold another number of triangles than the header says");
        }
        if (vertex_slots_seen_ != vertex_slots_)
            throw std::runtime_error("decoder: the leaves hold another number of vertices than the header says");
        std::sort(leaf_sizes.begin(), leaf_sizes.end());
        for (const auto& [first, count] : leaf_sizes) decoded_.triangles_in_leaf.push_back(count);
    }

    /// What nodes of both kinds hold.
    struct Node {
        std::size_t at = 0;
        std::uint32_t first_node = 0, nodes = 0, leaves = 0;
        std::size_t block = 0;  // of its leaves
        std::vector<GridBox> boxes;
    };

    void count_children(Node& node, std::uint32_t nodes, std::uint32_t leaves) const {
        if (nodes + leaves > (has_strips_ ? 8u : 16u))
            throw std::runtime_error("decoder: a node has more children than its profile allows");
        node.nodes = nodes;
        node.leaves = leaves;
        node.boxes.resize(nodes + leaves);
    }

    [[nodiscard]] Node read_plain_node(std::size_t at) const {
        namespace layout = format::plain_node;
        Node node;
        node.at = at;
        const std::uint32_t children = bytes_.u32(at + layout::children_at);
        node.first_node = children & 0xFFFFFFu;
        count_children(node, children >> 24, bytes_.u8(at + layout::leaf_children_at));
        node.block = leaves_at_ + std::size_t{4} * bytes_.u32(at + layout::leaf_block_at);
        const std::uint32_t unit = decoded_.bits > 16 ? 1u << (decoded_.bits - 16) : 1u;
        for (unsigned child = 0; child < node.boxes.size(); ++child) {
            for (unsigned axis = 0; axis < 3; ++axis) {
                const std::size_t plane = at + 32 * std::size_t{axis} + 2 * std::size_t{child};
                const std::uint32_t low = bytes_.u16(plane + layout::lo_at), high = bytes_.u16(plane + layout::hi_at);
                node.boxes[child].low[axis] = static_cast<std::int32_t>(low * unit);
                node.boxes[child].high[axis] = static_cast<std::int32_t>((high + 1) * unit - 1);
            }
        }
        return node;
    }

    [[nodiscard]] Node read_packed_node(std::size_t at) const {
        namespace layout = format::packed_node;
        Node node;
        node.at = at;
        const std::uint32_t children = bytes_.u32(at + layout::children_at);
        node.first_node = children & 0xFFFFFFu;
        count_children(node, children >> 24 & 15u, children >> 28);
        node.block = leaves_at_ + std::size_t{4} * bytes_.u32(at + layout::leaf_block_at);
        const std::uint32_t shifts = bytes_.u16(at + layout::shifts_at);
        const unsigned unit = decoded_.bits > 16 ? decoded_.bits - 16 : 0;
        const auto plane = [&](std::size_t planes_at, unsigned axis, unsigned child) {
            const std::uint32_t base = bytes_.u16(at + layout::base_at + 2 * axis) << unit;
            const std::uint32_t steps = bytes_.u8(at + planes_at + 8 * axis + child);
            return static_cast<std::int32_t>(base + (steps << (shifts >> (5 * axis) & 31u)));
        };
        for (unsigned child = 0; child < node.boxes.size(); ++child) {
            for (unsigned axis = 0; axis < 3; ++axis) {
                node.boxes[child].low[axis] = plane(layout::lo_at, axis, child);
                node.boxes[child].high[axis] = plane(layout::hi_at, axis, child);
            }
        }
        return node;
    }

    /// The triangles of leaf `number` of a node, and the storage index that its bytes state for the first of them.
    struct LeafTriangles {
        std::uint32_t first = 0;
        std::vector<GridTriangle> triangles;
        unsigned vertex_count = 0;                          // of a plain leaf
        std::vector<std::array<std::uint32_t, 3>> corners;  // as vertices of a plain leaf
    };

    [[nodiscard]] LeafTriangles read_leaf(const Node& node, std::uint32_t number) const {
        const GridBox& box = node.boxes[node.nodes + number];
        if (!has_strips_) {
            const std::size_t place = node.at + format::plain_node::leaves_at + 3 * std::size_t{number};
            const std::uint32_t descriptor = bytes_.u16(place) | bytes_.u8(place + 2) << 16;
            const std::size_t at = node.block + 4 * std::size_t{descriptor & 0x7FFu};
            PlainLeafContent content = read_plain_leaf(bytes_, {descriptor, at, box}, decoded_.bits,
                                                       is_deformable() ? &corner_rows_ : nullptr);
            return {bytes_.u32(at), std::move(content.triangles), content.vertex_count, std::move(content.corners)};
        }
        namespace layout = format::strip_leaf;
        const std::size_t descriptors = node.block + layout::descriptors_at;
        if (decoded_.profile == Profile::tiny) {
            std::size_t at = descriptors + 2 * std::size_t{node.leaves};
            std::uint32_t first = bytes_.u32(node.block);
            for (std::uint32_t i = 0;; ++i) {
                const std::uint32_t descriptor = bytes_.u16(descriptors + 2 * std::size_t{i});
                PredictedLeaf leaf =
                    read_predicted_strip(bytes_, {descriptor, at, node.boxes[node.nodes + i]}, decoded_.bits);
                if (leaf.bytes != (descriptor & 1023u))
                    throw std::runtime_error("decoder: a leaf's bytes are not as many as its descriptor says");
                if (i == number) return {first, std::move(leaf.triangles), 0, {}};
                at += leaf.bytes;
                first += static_cast<std::uint32_t>(leaf.triangles.size());
            }
        }
        const std::size_t data = descriptors + 4 * std::size_t{node.leaves};
        const std::uint32_t descriptor = bytes_.u32(descriptors + 4 * std::size_t{number});
        return {bytes_.u32(node.block) + (descriptor >> layout::first_shift),
                read_strip_leaf(bytes_, {descriptor, data + (descriptor & 0x1FFFu), box}, decoded_.bits),
                0,
                {}};
    }

    void read_node(std::uint32_t number, std::vector<std::pair<std::uint32_t, std::uint8_t>>& leaf_sizes,
                   std::size_t& filled) {
        const std::size_t at = format::header::bytes + std::size_t{number} * (has_strips_ ? 64 : 256);
        const Node node = has_strips_ ? read_packed_node(at) : read_plain_node(at);
        std::uint32_t triangle = 0;
        for (unsigned child = 0; child < node.boxes.size(); ++child) {
            DecodedChild out;
            out.box = node.boxes[child];
            if (child < node.nodes) {
                out.is_node = true;
                out.node = node.first_node + child;
                if (out.node >= node_count_) throw std::runtime_error("decoder: a child node is out of range");
                decoded_.nodes[out.node].depth = decoded_.nodes[number].depth + 1;
            } else {
                const LeafTriangles leaf = read_leaf(node, child - node.nodes);
                if (child > node.nodes && leaf.first != triangle) {
                    throw std::runtime_error("decoder: a leaf's first triangle does not follow the leaf before it");
                }
                out.first_triangle = leaf.first;
                out.triangle_count = static_cast<std::uint32_t>(leaf.triangles.size());
                if (std::size_t{leaf.first} + leaf.triangles.size() > decoded_.triangles.size()) {
                    throw std::runtime_error("decoder: a leaf's storage indices are out of range");
                }
                std::copy(leaf.triangles.begin(), leaf.triangles.end(), decoded_.triangles.begin() + leaf.first);
                if (is_deformable()) read_corner_sources(leaf);
                leaf_sizes.emplace_back(leaf.first, static_cast<std::uint8_t>(leaf.triangles.size()));
                filled += leaf.triangles.size();
                triangle = leaf.first + out.triangle_count;
            }
            decoded_.nodes[number].children.push_back(out);
        }
    }

    /// Vertex sources are in the order of the nodes' numbers, in which leaves are read.
    void read_corner_sources(const LeafTriangles& leaf) {
        for (std::size_t i = 0; i < leaf.corners.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner)
                decoded_.corner_sources[leaf.first + i][corner] =
                    vertex_source(vertex_slots_seen_ + leaf.corners[i][corner]);
        vertex_slots_seen_ += leaf.vertex_count;
    }

    /// Returns where the section ends.
    std::size_t read_ids(std::size_t at) {
        const std::uint64_t factor = has_strips_ ? 3 : 1;
        const unsigned number_bits = decoded_.source_triangles == 0
                                         ? 0
                                         : bits_of(static_cast<std::uint32_t>(factor * decoded_.source_triangles - 1));
        const std::size_t kinds_at = at;
        const std::size_t steps_at = kinds_at + (std::size_t{8} << id_kind_bits_);
        const std::size_t blocks_at = steps_at + padded(bytes_.u32(80));
        std::size_t byte = steps_at, bit = 0;
        std::uint64_t number = 0, first = 0;
        std::deque<std::uint64_t> recent;
        const bool has_runs = (decoded_.features & format::feature::id_runs) != 0;
        for (std::uint32_t i = 0; i < decoded_.triangle_count; ++i) {
            if (i % (has_runs ? 32 : 128) == 0) {
                byte += (bit + 7) / 8;
                bit = 0;
                const std::size_t block = blocks_at + i / 128 * (has_runs ? 8 : 4), run = i % 128 / 32;
                const std::size_t in_block = run == 0 ? 0 : bytes_.u32(block + 4) >> 10 * (run - 1) & 1023;
                if (bytes_.u32(block) + in_block != byte - steps_at)
                    throw std::runtime_error("decoder: a run of ids begins elsewhere than the one before it ends");
                if (run == 0) {
                    first = bytes_.field(byte, 0, number_bits);
                    bit = number_bits;
                }
                recent.assign(8, first);
            }
            if (i % 128 == 0) {
                number = first;
            } else {
                const std::size_t kind = kinds_at + std::size_t{8} * bytes_.field(byte, bit, id_kind_bits_);
                const unsigned width = bytes_.u8(kind + 4), prefix = bytes_.u8(kind + 5);
                const unsigned from = bytes_.u8(kind + 6), replaced = bytes_.u8(kind + 7);
                if (prefix > id_kind_bits_ || from > 7 || replaced > 7)
                    throw std::runtime_error("decoder: a kind of step between ids is out of range");
                number = recent[from] + bytes_.u32(kind) + bytes_.field(byte, bit + prefix, width);
                number %= std::uint64_t{1} << number_bits;
                bit += prefix + width;
                recent.erase(recent.begin() + replaced);
                recent.push_front(number);
            }
            decoded_.original_ids.push_back(static_cast<std::uint32_t>(number / factor));
            decoded_.first_corners.push_back(static_cast<std::uint8_t>(number % factor));
            if (decoded_.original_ids.back() >= decoded_.source_triangles)
                throw std::runtime_error("decoder: an original id is of no source triangle");
        }
        byte += (bit + 7) / 8;
        if (byte - steps_at != bytes_.u32(80)) throw std::runtime_error("decoder: ids do not fill their section");
        return blocks_at + (has_runs ? 8 : 4) * ((std::size_t{decoded_.triangle_count} + 127) / 128);
    }

    void read_optional_sections() {
        const std::size_t triangles = decoded_.triangle_count;
        std::size_t at = leaves_at_ + leaf_bytes_ + format::guard_bytes;
        if ((decoded_.features & format::feature::original_ids) != 0) {
            for (std::uint32_t i = 0; i < source_count_; ++i, at += format::source::bytes) {
                decoded_.sources.push_back({bytes_.u32(at + format::source::first_at),
                                            bytes_.u32(at + format::source::file_at),
                                            bytes_.u32(at + format::source::mesh_at)});
            }
            at = read_ids(at);
        }
        if ((decoded_.features & format::feature::materials_8) != 0) {
            for (std::size_t i = 0; i < triangles; ++i) {
                decoded_.materials.push_back(static_cast<std::uint16_t>(bytes_.u8(at + i)));
            }
            at += padded(triangles);
        }
        if ((decoded_.features & format::feature::materials_16) != 0) {
            for (std::size_t i = 0; i < triangles; ++i) {
                decoded_.materials.push_back(static_cast<std::uint16_t>(bytes_.u16(at + 2 * i)));
            }
            at += padded(2 * triangles);
        }
        for (std::size_t i = 0; i < triangles; ++i) decoded_.owners.push_back(static_cast<std::uint32_t>(i));
        if (has_copies()) {
            namespace layout = format::copies;
            const std::size_t owners_at =
                at + layout::blocks_at + static_cast<std::size_t>(layout::blocks_bytes(decoded_.triangle_count));
            std::size_t seen = 0;
            for (std::size_t i = 0; i < triangles; ++i) {
                const std::size_t block =
                    at + layout::blocks_at + i / layout::block_indices * layout::block_bytes + layout::bits_at;
                if (bytes_.field(block, i % layout::block_indices, 1) == 0) continue;
                decoded_.owners[i] = bytes_.u32(owners_at + layout::owner_bytes * seen++);
                if (decoded_.triangles[i] != decoded_.triangles[decoded_.owners[i]])
                    throw std::runtime_error("decoder: a copy is not the triangle that it copies");
            }
            if (seen != bytes_.u32(at)) throw std::runtime_error("decoder: there is another number of copies");
            at = owners_at + layout::owner_bytes * seen;
        }
        if ((decoded_.features & format::feature::edge_flags) != 0) {
            decoded_.flat_limit = bytes_.u32(at);
            for (std::size_t i = 0; i < triangles; ++i) {
                std::array<std::uint8_t, 3> flags{};
                for (std::size_t edge = 0; edge < 3; ++edge)
                    flags[edge] = static_cast<std::uint8_t>(bytes_.field(at + 4, 6 * i + 2 * edge, 2));
                decoded_.edge_flags.push_back(flags);
            }
            at += padded(4 + (6 * triangles + 7) / 8);
        }
        const auto take_integers = [&](unsigned count, std::vector<std::int32_t>& to) {
            for (unsigned i = 0; i < count; ++i, at += 4) to.push_back(static_cast<std::int32_t>(bytes_.u32(at)));
        };
        if ((decoded_.features & format::feature::oriented_box) != 0) {
            for (unsigned i = 0; i < 4; ++i, at += 2)
                decoded_.oriented_box.push_back(static_cast<std::int16_t>(bytes_.u16(at)));
            take_integers(6, decoded_.oriented_box);
        }
        if ((decoded_.features & format::feature::bounding_sphere) != 0) take_integers(4, decoded_.sphere);
        if ((decoded_.features & format::feature::k_dop) != 0) take_integers(20, decoded_.k_dop);
        if (is_deformable()) {
            if (at != corner_rows_.at)
                throw std::runtime_error("decoder: the corners do not follow the other sections");
            at = bytes_.u32(format::header::total_bytes_at) - source_origin_bytes();
        }
        if (source_origin_bytes() != 0) {
            for (std::uint64_t& coordinate : decoded_.source_origin) {
                coordinate = std::uint64_t{bytes_.u32(at + 4)} << 32 | bytes_.u32(at);
                at += 8;
            }
        }
        if (at != bytes_.u32(format::header::total_bytes_at)) {
            throw std::runtime_error("decoder: the sections do not fill the blob");
        }
    }

    Bytes bytes_;
    DecodedBlob decoded_;
    bool has_strips_ = false;
    std::uint32_t node_count_ = 0, leaf_bytes_ = 0, source_count_ = 0;
    unsigned id_kind_bits_ = 0;
    std::size_t leaves_at_ = 0;
    CornerRows corner_rows_{};
    std::size_t vertex_sources_at_ = 0, vertex_slots_ = 0, vertex_slots_seen_ = 0;
};

}  // namespace

DecodedBlob decode(std::span<const std::byte> bytes) { return Decoder(bytes).run(); }

std::vector<GridPoint> distinct_corners(const DecodedBlob& decoded) {
    std::vector<GridPoint> corners;
    corners.reserve(3 * decoded.triangles.size());
    for (const GridTriangle& triangle : decoded.triangles) {
        corners.insert(corners.end(), {triangle.a, triangle.b, triangle.c});
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

}  // namespace espalier::tests
