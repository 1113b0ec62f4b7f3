#include "encoder.hpp"

#include <algorithm>
#include <bit>

#include "support/base/checksum.hpp"

namespace espalier::tests {

namespace {

/// Numbers into the bytes of a blob.
class Writer {
public:
    void put(std::uint64_t value, unsigned size) {
        for (unsigned i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
    void pad_to(std::size_t multiple) {
        while (bytes.size() % multiple != 0) bytes.push_back(std::byte{0});
    }
    /// A bit at a time, low bits first; `end_stream` fills the last byte up.
    void put_bits(std::uint64_t value, unsigned width) {
        for (unsigned i = 0; i < width; ++i, ++bit_) {
            if (bit_ % 8 == 0) bytes.push_back(std::byte{0});
            bytes.back() |= static_cast<std::byte>((value >> i & 1u) << (bit_ % 8));
        }
    }
    void end_stream() { bit_ = 0; }
    void append(const Writer& other) { bytes.insert(bytes.end(), other.bytes.begin(), other.bytes.end()); }

    std::vector<std::byte> bytes;

private:
    std::size_t bit_ = 0;
};

unsigned bits_for(std::uint32_t number) {
    unsigned count = 0;
    for (; number != 0; number /= 2) ++count;
    return count;
}

void put_axis(Writer& out, const PlainLeaf& leaf, std::size_t axis, std::int32_t start, unsigned width) {
    for (const GridPoint& vertex : leaf.vertices) out.put_bits(static_cast<std::uint32_t>(vertex[axis] - start), width);
    out.end_stream();
}

class Encoder {
public:
    explicit Encoder(const PlainBlob& blob) : blob_(blob), head_(blob.decoded) {}

    std::vector<std::byte> run() {
        if (!blob_.nodes.empty()) {
            nodes_.resize(1);
            sources_.resize(1);
            node_count_ = 1;
            visit(0, 0, 1);
        }
        Writer sections;
        put_sections(sections);
        Writer out;
        put_header(out, sections.bytes.size());
        for (const Writer& node : nodes_) out.append(node);
        out.append(leaves_);
        for (std::size_t i = 0; i < 64; ++i) out.put(0, 1);
        out.append(sections);
        repair_checksum(out.bytes);
        return std::move(out.bytes);
    }

private:
    void visit(std::size_t place, std::uint32_t number, unsigned depth) {
        const PlainNode& node = blob_.nodes[place];
        depth_ = depth > depth_ ? depth : depth_;
        std::uint32_t node_children = 0;
        for (const PlainChild& child : node.children) node_children += child.leaf ? 0u : 1u;
        const auto leaf_children = static_cast<std::uint32_t>(node.children.size()) - node_children;
        const std::uint32_t first = node_children == 0 ? 0 : node_count_;
        node_count_ += node_children;
        nodes_.resize(node_count_);
        sources_.resize(node_count_);

        const std::uint32_t block = leaf_children == 0 ? 0 : static_cast<std::uint32_t>(leaves_.bytes.size() / 4);
        Writer descriptors;
        if (leaf_children != 0) put_block(node, descriptors);
        if (is_deformable()) put_sources(node, sources_[number]);
        Writer out;
        if (has_strips()) {
            for (const std::uint32_t base : node.base) out.put(base, 2);
            out.put(node.shift[0] | node.shift[1] << 5 | node.shift[2] << 10, 2);
            out.put(first | node_children << 24 | leaf_children << 28, 4);
            out.put(block, 4);
            put_planes(out, node, 8, 1);
        } else {
            put_planes(out, node, 16, 2);
            out.put(first | node_children << 24, 4);
            out.put(block, 4);
            descriptors.bytes.resize(48);
            out.append(descriptors);
            out.put(leaf_children, 8);
        }
        nodes_[number] = std::move(out);

        std::uint32_t next = first;
        for (const PlainChild& child : node.children)
            if (!child.leaf) visit(child.node, next++, depth + 1);
    }

    [[nodiscard]] bool has_strips() const { return head_.profile != Profile::fast; }
    [[nodiscard]] bool is_deformable() const { return (head_.features & 1u << 9) != 0; }

    [[nodiscard]] bool has_source_origin() const { return (head_.features & 1u << 11) != 0; }

    void put_sources(const PlainNode& node, Writer& out) {
        for (const PlainChild& child : node.children) {
            if (!child.leaf) continue;
            for (const std::uint32_t source : child.leaf->sources)
                out.put(source, head_.position_count > 65536 ? 4 : 2);
            vertex_slots_ += child.leaf->sources.size();
        }
    }

    static void put_planes(Writer& out, const PlainNode& node, std::size_t places, unsigned size) {
        for (const bool high : {false, true})
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < places; ++i) {
                    const bool there = i < node.children.size();
                    out.put(!there ? 0 : high ? node.children[i].high[axis] : node.children[i].low[axis], size);
                }
    }

    /// Descriptors of strips become part of the block, those of other leaves part of the node.
    void put_block(const PlainNode& node, Writer& descriptors) {
        Writer data;
        const std::uint32_t first = triangles_;
        for (const PlainChild& child : node.children) {
            if (!child.leaf) continue;
            const PlainLeaf& leaf = *child.leaf;
            const GridBox box = node.box_of(child, head_.profile, head_.bits);
            if (head_.profile == Profile::tiny) put_predicted_strip(descriptors, data, leaf, box);
            else if (has_strips()) put_strip(descriptors, data, leaf, box, triangles_ - first);
            else put_triangles(descriptors, data, leaf);
            triangles_ += static_cast<std::uint32_t>(leaf.corners().size());
        }
        if (has_strips()) {
            leaves_.put(first, 4);
            leaves_.append(descriptors);
        }
        leaves_.append(data);
        leaves_.pad_to(4);
    }

    void put_triangles(Writer& descriptors, Writer& data, const PlainLeaf& leaf) {
        const auto triangles = static_cast<std::uint32_t>(leaf.triangles.size());
        const auto vertices = static_cast<std::uint32_t>(leaf.vertices.size());
        std::uint32_t size = 0;
        for (const GridPoint& a : leaf.vertices)
            for (const GridPoint& b : leaf.vertices)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    size = a[axis] - b[axis] > static_cast<std::int32_t>(size)
                               ? static_cast<std::uint32_t>(a[axis] - b[axis])
                               : size;
        const unsigned least = head_.bits > 16 ? head_.bits - 15 : 1;
        const unsigned field = bits_for(size) > least ? bits_for(size) - least : 0;
        descriptors.put(static_cast<std::uint32_t>(data.bytes.size() / 4) | (triangles - 1) << 11 |
                            (vertices - 1) << 15 | field << 20,
                        3);
        data.put(triangles_, 4);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const GridPoint& vertex : leaf.vertices)
                data.put(static_cast<std::uint32_t>(vertex[axis]) & 0xFFFFu, 2);
        Writer& corners = is_deformable() ? corners_ : data;
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (const auto& triangle : leaf.triangles) corners.put(triangle[corner], 1);
        for (std::size_t axis = 0; axis < 3 && head_.bits > 16; ++axis)
            for (const GridPoint& vertex : leaf.vertices) data.put(static_cast<std::uint32_t>(vertex[axis]) >> 16, 1);
        data.pad_to(4);
    }

    void put_strip(Writer& descriptors, Writer& data, const PlainLeaf& leaf, const GridBox& box,
                   std::uint32_t first) const {
        const std::size_t joints = leaf.entries.size() - 3;
        descriptors.put(
            static_cast<std::uint32_t>(data.bytes.size()) | static_cast<std::uint32_t>(joints) << 13 | first << 19, 4);
        for (std::size_t i = 1; i <= joints; ++i) data.put_bits(leaf.entries[i].is_pivot ? 1 : 0, 1);
        for (std::size_t i = 1; i <= joints; ++i) data.put_bits(leaf.entries[i].is_triangle ? 1 : 0, 1);
        std::vector<unsigned> references;
        unsigned used = 3;
        for (std::size_t i = 3; i < leaf.entries.size(); ++i) {
            const bool is_first = leaf.entries[i].vertex == used;
            data.put_bits(is_first ? 1 : 0, 1);
            if (is_first) ++used;
            else references.push_back(leaf.entries[i].vertex);
        }
        const unsigned width = bits_for(static_cast<std::uint32_t>(leaf.vertices.size()) - 1);
        for (const unsigned reference : references) data.put_bits(reference, width);
        data.end_stream();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const unsigned side = bits_for(static_cast<std::uint32_t>(box.high[axis] - box.low[axis]));
            put_axis(data, leaf, axis, box.low[axis], side < head_.bits ? side : head_.bits);
        }
    }

    /// What a vertex of a strip is predicted by: entries a + b - c. Nothing where it is not.
    static std::optional<std::array<std::size_t, 3>> prediction_of(const PlainLeaf& leaf, std::size_t entry) {
        if (entry < 3 || !leaf.entries[entry - 2].is_triangle || !leaf.entries[entry - 3].is_triangle) return {};
        const auto pivot_of = [&](std::size_t window) {
            while (!leaf.entries[window].is_pivot) --window;
            return window;
        };
        const bool turns = leaf.entries[entry - 2].is_pivot;
        return {{pivot_of(entry - 2), entry - 1, turns ? pivot_of(entry - 3) : entry - 2}};
    }

    void put_predicted_strip(Writer& descriptors, Writer& data, const PlainLeaf& leaf, const GridBox& box) const {
        const std::size_t count = leaf.entries.size();
        const std::size_t begin = data.bytes.size();
        std::vector<std::size_t> joints;
        for (std::size_t i = 1; i + 2 < count; ++i)
            if (!leaf.entries[i].is_triangle && leaf.entries[i - 1].is_triangle) joints.push_back(i);
        // Vertices where they are used first, with what they differ by from their prediction.
        std::vector<std::array<std::int32_t, 3>> residuals(count);
        std::vector<std::size_t> first_uses;
        std::array<std::array<unsigned, 2>, 3> width{};  // large, small
        for (std::size_t i = 0; i < count; ++i) {
            if (leaf.entries[i].vertex != first_uses.size()) continue;
            first_uses.push_back(i);
            const auto prediction = prediction_of(leaf, i);
            if (!prediction) continue;
            const auto at = [&](std::size_t entry) { return leaf.vertices[leaf.entries[entry].vertex]; };
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto& [a, b, c] = *prediction;
                residuals[i][axis] = at(i)[axis] - (at(a)[axis] + at(b)[axis] - at(c)[axis]);
                width[axis][0] = std::max(width[axis][0], residual_bits(residuals[i][axis]));
            }
        }
        for (auto& [large, small] : width) {
            small = large / 2;
            data.put_bits(large, 5);
            data.put_bits(small, 5);
        }
        data.put_bits(joints.size(), 4);
        for (std::size_t i = 1; i + 2 < count; ++i) data.put_bits(leaf.entries[i].is_pivot ? 1 : 0, 1);
        const auto is_first = [&](std::size_t entry) {
            return std::find(first_uses.begin(), first_uses.end(), entry) != first_uses.end();
        };
        for (std::size_t i = 3; i < count; ++i) data.put_bits(is_first(i) ? 1 : 0, 1);
        for (const std::size_t joint : joints) data.put_bits(joint, 6);
        const unsigned number_width = bits_for(static_cast<std::uint32_t>(leaf.vertices.size()) - 1);
        for (std::size_t i = 3; i < count; ++i)
            if (!is_first(i)) data.put_bits(leaf.entries[i].vertex, number_width);
        const auto is_large = [&](std::size_t entry, std::size_t axis) {
            return residual_bits(residuals[entry][axis]) > width[axis][1];
        };
        for (const std::size_t i : first_uses)
            for (std::size_t axis = 0; axis < 3 && prediction_of(leaf, i); ++axis)
                data.put_bits(is_large(i, axis) ? 1 : 0, 1);
        for (const std::size_t i : first_uses) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!prediction_of(leaf, i)) {
                    const unsigned side = bits_for(static_cast<std::uint32_t>(box.high[axis] - box.low[axis]));
                    const GridPoint& vertex = leaf.vertices[leaf.entries[i].vertex];
                    data.put_bits(static_cast<std::uint32_t>(vertex[axis] - box.low[axis]),
                                  side < head_.bits ? side : head_.bits);
                    continue;
                }
                const unsigned bits = width[axis][is_large(i, axis) ? 0 : 1];
                data.put_bits(static_cast<std::uint64_t>(residuals[i][axis] + (1 << bits >> 1)), bits);
            }
        }
        data.end_stream();
        descriptors.put(data.bytes.size() - begin + ((count - 3) << 10), 2);
    }

    /// Bits of a field for it, half of whose range is added.
    static unsigned residual_bits(std::int32_t residual) {
        unsigned bits = 0;
        while (residual < -(1 << bits >> 1) || residual >= (bits == 0 ? 1 : 1 << (bits - 1))) ++bits;
        return bits;
    }

    void put_sections(Writer& out) {
        const std::uint32_t features = head_.features;
        if ((features & 1u << 0) != 0) {
            for (const DecodedSource& source : head_.sources)
                for (const std::uint32_t number : {source.first, source.file, source.mesh}) out.put(number, 4);
            put_ids(out);
        }
        if ((features & (1u << 1 | 1u << 2)) != 0) {
            for (const std::uint16_t material : head_.materials) out.put(material, (features & 1u << 1) != 0 ? 1 : 2);
            out.pad_to(4);
        }
        if ((features & 1u << 4) != 0) put_copies(out);
        if ((features & 1u << 5) != 0) {
            out.put(head_.flat_limit, 4);
            for (const auto& flags : head_.edge_flags)
                for (const std::uint8_t flag : flags) out.put_bits(flag, 2);
            out.end_stream();
            out.pad_to(4);
        }
        for (std::size_t i = 0; i < head_.oriented_box.size(); ++i)
            out.put(static_cast<std::uint32_t>(head_.oriented_box[i]), i < 4 ? 2 : 4);
        for (const std::int32_t number : head_.sphere) out.put(static_cast<std::uint32_t>(number), 4);
        for (const std::int32_t number : head_.k_dop) out.put(static_cast<std::uint32_t>(number), 4);
        if (is_deformable()) {
            out.append(corners_);
            out.pad_to(4);
            for (std::size_t i = 0; i < 64; ++i) out.put(0, 1);
            for (const Writer& sources : sources_) out.append(sources);
            out.pad_to(4);
        }
        if (!has_source_origin()) return;
        for (const std::uint64_t coordinate : head_.source_origin) out.put(coordinate, 8);
    }

    void put_ids(Writer& out) {
        const std::uint64_t factor = head_.profile == Profile::fast ? 1 : 3;
        const std::uint64_t limit = factor * head_.source_triangles;
        const unsigned number_bits = limit == 0 ? 0 : bits_for(static_cast<std::uint32_t>(limit - 1));
        const std::uint64_t modulus = std::uint64_t{1} << number_bits;
        const bool has_runs = (head_.features & 1u << 10) != 0;
        const std::size_t of_run = has_runs ? 32 : 128;
        Writer blocks, steps;
        std::vector<std::uint64_t> recent;
        std::uint64_t first = 0;
        std::size_t last = 0, block_begin = 0;
        std::uint64_t run_begins = 0;
        for (std::size_t i = 0; i < triangles_; ++i) {
            const std::uint64_t corner = factor == 1 ? 0 : head_.first_corners[i];
            const std::uint64_t number = factor * head_.original_ids[i] + corner;
            if (i % of_run == 0) steps.end_stream();
            if (i % 128 == 0) {
                if (i != 0 && has_runs) blocks.put(run_begins, 4);
                run_begins = 0;
                block_begin = steps.bytes.size();
                blocks.put(block_begin, 4);
                steps.put_bits(number, number_bits);
                first = number;
            } else if (i % of_run == 0) {
                run_begins += (steps.bytes.size() - block_begin) << 10 * (i % 128 / 32 - 1);
            }
            if (i % of_run == 0) recent.assign(8, first);
            if (i % 128 != 0) {
                std::uint64_t field = modulus;
                PlainIdKind kind;
                do {
                    last = (last + 1) % blob_.id_kinds.size();
                    kind = blob_.id_kinds[last];
                    field = (number + 2 * modulus - recent[kind.from] - kind.offset % modulus) % modulus;
                } while (field >> kind.width != 0);
                steps.put_bits(last % (std::size_t{1} << kind.prefix), kind.prefix);
                steps.put_bits(field, kind.width);
                recent.erase(recent.begin() + kind.replaced);
                recent.insert(recent.begin(), number);
            }
        }
        if (triangles_ != 0 && has_runs) blocks.put(run_begins, 4);
        id_step_bytes_ = steps.bytes.size();
        for (const PlainIdKind& kind : blob_.id_kinds) {
            out.put(kind.offset, 4);
            for (const unsigned field : {kind.width, kind.prefix, kind.from, kind.replaced}) out.put(field, 1);
        }
        out.append(steps);
        out.pad_to(4);
        out.append(blocks);
    }

    void put_copies(Writer& out) const {
        std::vector<std::uint32_t> owners;
        Writer blocks;
        for (std::size_t begin = 0; begin < triangles_; begin += 256) {
            blocks.put(owners.size(), 4);
            for (std::size_t i = begin; i < begin + 256; ++i) {
                const bool is_copy = i < triangles_ && head_.owners[i] != i;
                blocks.put_bits(is_copy ? 1 : 0, 1);
                if (is_copy) owners.push_back(head_.owners[i]);
            }
            blocks.end_stream();
        }
        out.put(owners.size(), 4);
        out.append(blocks);
        for (const std::uint32_t owner : owners) out.put(owner, 4);
    }

    void put_header(Writer& out, std::size_t section_bytes) const {
        const std::size_t total =
            128 + std::size_t{has_strips() ? 64u : 256u} * node_count_ + leaves_.bytes.size() + 64 + section_bytes;
        out.put(0x4C505345u, 4);
        out.put(2, 2);
        out.put((head_.features & 1u << 10) != 0 || has_source_origin() ? 2 : is_deformable() ? 1 : 0, 2);
        out.put(total, 4);
        out.put(0, 4);  // the checksum comes last
        out.put(head_.features, 4);
        out.put(static_cast<std::uint8_t>(head_.profile), 1);
        out.put(head_.bits, 1);
        out.put(static_cast<std::uint16_t>(head_.step_exponent), 2);
        out.put(triangles_, 4);
        out.put(head_.vertex_count, 4);
        out.put(node_count_, 4);
        out.put(leaves_.bytes.size(), 4);
        for (const float origin : head_.origin) out.put(std::bit_cast<std::uint32_t>(origin), 4);
        for (const std::uint32_t extent : head_.extent) out.put(extent, 4);
        out.put(std::bit_cast<std::uint32_t>(head_.max_error), 4);
        out.put(depth_, 1);
        out.put((head_.features & 1u << 0) != 0 ? bits_for(static_cast<std::uint32_t>(blob_.id_kinds.size()) - 1) : 0,
                1);
        out.put(0, 2);
        out.put(head_.sources.size(), 4);
        out.put(head_.source_triangles, 4);
        out.put(id_step_bytes_, 4);
        out.put(head_.position_count, 4);
        out.put(vertex_slots_, 4);
        out.put(std::bit_cast<std::uint32_t>(head_.rest_cost), 4);
        for (const GridPoint& point : {head_.pose.low, head_.pose.high})
            for (const std::int32_t coordinate : point) out.put(static_cast<std::uint32_t>(coordinate), 4);
        out.put(0, 8);
    }

    const PlainBlob& blob_;
    const DecodedBlob& head_;
    std::vector<Writer> nodes_;
    Writer leaves_;
    Writer corners_;
    std::vector<Writer> sources_;  ///< of each node's leaves
    std::size_t vertex_slots_ = 0;
    std::uint32_t node_count_ = 0, triangles_ = 0;
    std::size_t id_step_bytes_ = 0;
    unsigned depth_ = 0;
};

}  // namespace

std::vector<GridTriangle> PlainLeaf::corners() const {
    std::vector<GridTriangle> result;
    for (const auto& [a, b, c] : triangles) result.push_back({vertices[a], vertices[b], vertices[c]});
    std::size_t pivot = 0;
    bool swapped = true;
    for (std::size_t window = 0; window + 2 < entries.size(); ++window) {
        if (entries[window].is_pivot) {
            pivot = window;
            swapped = !swapped;
        }
        if (!entries[window].is_triangle) continue;
        const GridPoint& before = vertices[entries[window + 1].vertex];
        const GridPoint& last = vertices[entries[window + 2].vertex];
        result.push_back({vertices[entries[pivot].vertex], swapped ? last : before, swapped ? before : last});
    }
    return result;
}

GridBox PlainNode::box_of(const PlainChild& child, Profile profile, unsigned bits) const {
    GridBox box{};
    const unsigned unit = bits > 16 ? bits - 16 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (profile == Profile::fast) {
            box.low[axis] = child.low[axis] << unit;
            box.high[axis] = ((child.high[axis] + 1) << unit) - 1;
            continue;
        }
        const std::uint32_t from = base[axis] << unit;
        box.low[axis] = static_cast<std::int32_t>(from + (std::uint32_t{child.low[axis]} << shift[axis]));
        box.high[axis] = static_cast<std::int32_t>(from + (std::uint32_t{child.high[axis]} << shift[axis]));
    }
    return box;
}

std::vector<std::byte> encode(const PlainBlob& blob) { return Encoder(blob).run(); }

}  // namespace espalier::tests
