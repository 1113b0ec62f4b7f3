#include "decoder.hpp"

#include <algorithm>
#include <bit>
#include <deque>
#include <stdexcept>
#include <string>

#include <espalier/format.hpp>

namespace espalier::tests {

namespace {

class Bytes {
public:
    explicit Bytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] std::uint32_t u8(std::size_t at) const {
        if (at >= bytes_.size()) throw std::runtime_error("decoder: read past the end at byte " + std::to_string(at));
        return std::to_integer<std::uint32_t>(bytes_[at]);
    }
    [[nodiscard]] std::uint32_t u16(std::size_t at) const { return u8(at) | u8(at + 1) << 8; }
    [[nodiscard]] std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }
    [[nodiscard]] float f32(std::size_t at) const { return std::bit_cast<float>(u32(at)); }

    /// `width` bits, `bit` bits after the byte `at`, low bits first; one bit at a time, so that nobody has to trust a
    /// shift.
    [[nodiscard]] std::uint32_t field(std::size_t at, std::size_t bit, unsigned width) const {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < width; ++i, ++bit) value |= (u8(at + bit / 8) >> (bit % 8) & 1u) << i;
        return value;
    }

private:
    std::span<const std::byte> bytes_;
};

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

/// One leaf, whose data begin at `at`, and its box in its node.
struct Leaf {
    std::uint32_t descriptor;
    std::size_t at;
    GridBox box;
};

/// `width` bits for each vertex, counted from the low corner of the leaf's box; returns where the stream ends.
std::size_t read_axis(const Bytes& bytes, const Leaf& leaf, std::size_t at, unsigned axis, unsigned width,
                      std::vector<GridPoint>& vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i][axis] = leaf.box.low[axis] + static_cast<std::int32_t>(bytes.field(at, i * width, width));
    }
    return at + (vertices.size() * width + 7) / 8;
}

/// How many bits a number takes: 0 for 0.
unsigned bits_of(std::uint32_t number) {
    unsigned count = 0;
    for (; number != 0; number /= 2) ++count;
    return count;
}

std::vector<GridTriangle> read_plain_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits) {
    namespace layout = format::plain_leaf;
    const std::size_t triangle_count = (leaf.descriptor >> layout::triangles_shift & 15u) + 1;
    std::vector<GridPoint> vertices((leaf.descriptor >> layout::vertices_shift & 31u) + 1);
    std::size_t at = leaf.at + 4;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (GridPoint& vertex : vertices) {
            vertex[axis] = static_cast<std::int32_t>(bytes.u16(at));
            at += 2;
        }
    const std::size_t corners = at;
    at += 3 * triangle_count;
    if (bits > 16) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (GridPoint& vertex : vertices) vertex[axis] += static_cast<std::int32_t>(bytes.u8(at++) * 65536);
    }
    std::int64_t size = 0;
    for (const GridPoint& a : vertices)
        for (const GridPoint& b : vertices)
            for (std::size_t axis = 0; axis < 3; ++axis) size = std::max(size, std::int64_t{a[axis]} - b[axis]);
    unsigned field = 0;
    for (const unsigned least = bits > 16 ? bits - 15 : 1; size >= std::int64_t{1} << (field + least);) ++field;
    if (field != (leaf.descriptor >> layout::size_shift & 15u))
        throw std::runtime_error("decoder: a leaf's size is another one than its descriptor says");
    std::vector<GridTriangle> triangles;
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const auto vertex = [&](std::size_t k) {
            const std::uint32_t number = bytes.u8(corners + k * triangle_count + i);
            if (number >= vertices.size()) throw std::runtime_error("decoder: a triangle names no vertex of its leaf");
            return vertices[number];
        };
        triangles.push_back({vertex(0), vertex(1), vertex(2)});
    }
    return triangles;
}

/// The triangles of a strip whose entries name these vertices.
std::vector<GridTriangle> windows_of(const std::vector<std::uint32_t>& numbers, const std::vector<bool>& is_pivot,
                                     const std::vector<bool>& is_triangle, const std::vector<GridPoint>& vertices) {
    std::vector<GridTriangle> triangles;
    unsigned pivot = 0;
    unsigned pivots_so_far = 0;
    for (unsigned window = 0; window < numbers.size() - 2; ++window) {
        if (is_pivot[window]) {
            pivot = window;
            ++pivots_so_far;
        }
        if (!is_triangle[window]) continue;
        const GridPoint& first = vertices[numbers[pivot]];
        const GridPoint& before = vertices[numbers[window + 1]];
        const GridPoint& last = vertices[numbers[window + 2]];
        if (pivots_so_far % 2 == 1) {
            triangles.push_back({first, before, last});
        } else {
            triangles.push_back({first, last, before});
        }
    }
    return triangles;
}

std::vector<GridTriangle> read_strip_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits) {
    const unsigned entry_count = (leaf.descriptor >> format::strip_leaf::entries_shift & 63u) + 3;
    std::size_t bit = 0;
    const auto take = [&](unsigned width) {
        const std::uint32_t value = bytes.field(leaf.at, bit, width);
        bit += width;
        return value;
    };
    std::vector<bool> is_pivot(entry_count, false);
    std::vector<bool> is_triangle(entry_count - 2, true);
    std::vector<bool> is_first_use(entry_count, true);
    is_pivot[0] = true;
    for (unsigned entry = 1; entry <= entry_count - 3; ++entry) is_pivot[entry] = take(1) != 0;
    for (unsigned window = 1; window <= entry_count - 3; ++window) is_triangle[window] = take(1) != 0;
    for (unsigned entry = 3; entry < entry_count; ++entry) is_first_use[entry] = take(1) != 0;

    std::uint32_t vertex_count = 0;
    for (const bool is_new : is_first_use) vertex_count += is_new ? 1 : 0;
    std::vector<std::uint32_t> numbers;
    std::uint32_t used = 0;
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        numbers.push_back(is_first_use[entry] ? used++ : take(bits_of(vertex_count - 1)));
        if (numbers.back() >= used) throw std::runtime_error("decoder: an entry names a vertex before its first use");
    }

    std::vector<GridPoint> vertices(vertex_count);
    std::size_t at = leaf.at + (bit + 7) / 8;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto side = static_cast<std::uint32_t>(leaf.box.high[axis] - leaf.box.low[axis]);
        at = read_axis(bytes, leaf, at, axis, std::min(bits_of(side), bits), vertices);
    }

    return windows_of(numbers, is_pivot, is_triangle, vertices);
}

struct PredictedLeaf {
    std::vector<GridTriangle> triangles;
    std::size_t bytes = 0;
};

/// A strip whose vertices are predicted: section 5.5.
PredictedLeaf read_predicted_strip(const Bytes& bytes, const Leaf& leaf, unsigned bits) {
    const unsigned entry_count = (leaf.descriptor >> 10) + 3;
    std::size_t bit = 0;
    const auto take = [&](unsigned width) {
        const std::uint32_t value = bytes.field(leaf.at, bit, width);
        bit += width;
        return value;
    };
    std::array<std::array<unsigned, 2>, 3> width{};
    for (auto& [large, small] : width) {
        large = take(5);
        small = take(5);
    }
    const std::uint32_t joints = take(4);
    std::vector<bool> is_pivot(entry_count, false);
    std::vector<bool> is_triangle(entry_count - 2, true);
    std::vector<bool> is_first_use(entry_count, true);
    is_pivot[0] = true;
    for (unsigned entry = 1; entry <= entry_count - 3; ++entry) is_pivot[entry] = take(1) != 0;
    for (unsigned entry = 3; entry < entry_count; ++entry) is_first_use[entry] = take(1) != 0;
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
        const std::uint32_t window = take(6);
        if (window == 0 || window + 5 > entry_count) throw std::runtime_error("decoder: a joint outside of its strip");
        is_triangle[window] = is_triangle[window + 1] = false;
    }
    const auto vertex_count = static_cast<std::uint32_t>(std::count(is_first_use.begin(), is_first_use.end(), true));
    std::vector<std::uint32_t> numbers;
    std::uint32_t used = 0;
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        numbers.push_back(is_first_use[entry] ? used++ : take(bits_of(vertex_count - 1)));
        if (numbers.back() >= used) throw std::runtime_error("decoder: an entry names a vertex before its first use");
    }
    const auto is_predicted = [&](unsigned entry) {
        return entry > 2 && is_triangle[entry - 2] && is_triangle[entry - 3];
    };
    std::vector<std::array<bool, 3>> is_large(entry_count);
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        if (!is_first_use[entry] || !is_predicted(entry)) continue;
        for (bool& large : is_large[entry]) large = take(1) != 0;
    }
    std::vector<GridPoint> vertices(vertex_count);
    for (unsigned entry = 0; entry < entry_count; ++entry) {
        if (!is_first_use[entry]) continue;
        GridPoint& vertex = vertices[numbers[entry]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!is_predicted(entry)) {
                const auto side = static_cast<std::uint32_t>(leaf.box.high[axis] - leaf.box.low[axis]);
                vertex[axis] = leaf.box.low[axis] + static_cast<std::int32_t>(take(std::min(bits_of(side), bits)));
                continue;
            }
            const auto pivot_up_to = [&](unsigned window) {
                while (!is_pivot[window]) --window;
                return window;
            };
            const auto at = [&](unsigned place) { return vertices[numbers[place]][axis]; };
            const unsigned field = width[axis][is_large[entry][axis] ? 0 : 1];
            const auto residual = static_cast<std::int32_t>(take(field)) - (field == 0 ? 0 : 1 << (field - 1));
            const std::int32_t opposite = at(is_pivot[entry - 2] ? pivot_up_to(entry - 3) : entry - 2);
            vertex[axis] = at(pivot_up_to(entry - 2)) + at(entry - 1) - opposite + residual;
        }
    }
    return {windows_of(numbers, is_pivot, is_triangle, vertices), (bit + 7) / 8};
}

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

    void read_header() {
        namespace at = format::header;
        decoded_.features = bytes_.u32(at::features_at);
        decoded_.profile = static_cast<format::Profile>(bytes_.u8(at::profile_at));
        has_strips_ = decoded_.profile != format::Profile::fast;
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
    }

    // Leaf blocks hold consecutive storage indices but are reached in the order of the nodes, so each leaf's triangles
    // are put where its block says.
    void read_nodes() {
        decoded_.nodes.resize(node_count_);
        decoded_.nodes[0].depth = 1;
        decoded_.triangles.resize(decoded_.triangle_count);
        std::vector<std::pair<std::uint32_t, std::uint8_t>> leaf_sizes;
        std::size_t filled = 0;
        for (std::uint32_t node = 0; node < node_count_; ++node) read_node(node, leaf_sizes, filled);
        if (filled != decoded_.triangle_count) {
            throw std::runtime_error("decoder: the leaves hold another number of triangles than the header says");
        }
        std::sort(leaf_sizes.begin(), leaf_sizes.end());
        for (const auto& [first, count] : leaf_sizes) decoded_.triangles_in_leaf.push_back(count);
    }

    /// What nodes of both kinds hold.
    struct Node {
        std::size_t at = 0;
        std::uint32_t first_node = 0;
        std::uint32_t nodes = 0;
        std::uint32_t leaves = 0;
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
    };

    [[nodiscard]] LeafTriangles read_leaf(const Node& node, std::uint32_t number) const {
        const GridBox& box = node.boxes[node.nodes + number];
        if (!has_strips_) {
            const std::size_t place = node.at + format::plain_node::leaves_at + 3 * std::size_t{number};
            const std::uint32_t descriptor = bytes_.u16(place) | bytes_.u8(place + 2) << 16;
            const std::size_t at = node.block + 4 * std::size_t{descriptor & 0x7FFu};
            return {bytes_.u32(at), read_plain_leaf(bytes_, {descriptor, at, box}, decoded_.bits)};
        }
        namespace layout = format::strip_leaf;
        const std::size_t descriptors = node.block + layout::descriptors_at;
        if (decoded_.profile == format::Profile::tiny) {
            std::size_t at = descriptors + 2 * std::size_t{node.leaves};
            std::uint32_t first = bytes_.u32(node.block);
            for (std::uint32_t i = 0;; ++i) {
                const std::uint32_t descriptor = bytes_.u16(descriptors + 2 * std::size_t{i});
                PredictedLeaf leaf =
                    read_predicted_strip(bytes_, {descriptor, at, node.boxes[node.nodes + i]}, decoded_.bits);
                if (leaf.bytes != (descriptor & 1023u))
                    throw std::runtime_error("decoder: a leaf's bytes are not as many as its descriptor says");
                if (i == number) return {first, std::move(leaf.triangles)};
                at += leaf.bytes;
                first += static_cast<std::uint32_t>(leaf.triangles.size());
            }
        }
        const std::size_t data = descriptors + 4 * std::size_t{node.leaves};
        const std::uint32_t descriptor = bytes_.u32(descriptors + 4 * std::size_t{number});
        return {bytes_.u32(node.block) + (descriptor >> layout::first_shift),
                read_strip_leaf(bytes_, {descriptor, data + (descriptor & 0x1FFFu), box}, decoded_.bits)};
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
                leaf_sizes.emplace_back(leaf.first, static_cast<std::uint8_t>(leaf.triangles.size()));
                filled += leaf.triangles.size();
                triangle = leaf.first + out.triangle_count;
            }
            decoded_.nodes[number].children.push_back(out);
        }
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
        std::uint64_t number = 0;
        std::deque<std::uint64_t> recent;
        for (std::uint32_t i = 0; i < decoded_.triangle_count; ++i) {
            if (i % 128 == 0) {
                byte += (bit + 7) / 8;
                bit = 0;
                if (bytes_.u32(blocks_at + i / 32) != byte - steps_at)
                    throw std::runtime_error("decoder: a block of ids begins elsewhere than the one before it ends");
                number = bytes_.field(byte, bit, number_bits);
                bit += number_bits;
                recent.assign(8, number);
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
        return blocks_at + 4 * ((std::size_t{decoded_.triangle_count} + 127) / 128);
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
        if (at != bytes_.u32(format::header::total_bytes_at)) {
            throw std::runtime_error("decoder: the sections do not fill the blob");
        }
    }

    Bytes bytes_;
    DecodedBlob decoded_;
    bool has_strips_ = false;
    std::uint32_t node_count_ = 0;
    std::uint32_t leaf_bytes_ = 0;
    std::uint32_t source_count_ = 0;
    unsigned id_kind_bits_ = 0;
    std::size_t leaves_at_ = 0;
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
