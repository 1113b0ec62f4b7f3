#include "weird_blobs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace espalier::tests {

namespace {

enum class Size { one, most, any };

bool has_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    const auto edge = [&](const GridPoint& to, std::size_t k) { return std::int64_t{to[k]} - a[k]; };
    return edge(b, 0) * edge(c, 1) != edge(b, 1) * edge(c, 0) || edge(b, 1) * edge(c, 2) != edge(b, 2) * edge(c, 1) ||
           edge(b, 2) * edge(c, 0) != edge(b, 0) * edge(c, 2);
}

class Maker {
public:
    explicit Maker(Random& random) : random_(random) {}

    PlainBlob run() {
        make_header();
        if (random_.below(50) != 0) {
            const GridBox everything = {{0, 0, 0}, to_point(head_.extent)};
            static_cast<void>(make_node(everything, 1));
            for (const PlainNode& node : blob_.nodes)
                for (const PlainChild& child : node.children)
                    if (child.leaf) triangles_ += static_cast<std::uint32_t>(child.leaf->corners().size());
            head_.vertex_count = random_.coin() ? 3 : 1 + random_.below(0xFFFFFFFEu);
        }
        make_sections();
        return std::move(blob_);
    }

private:
    static GridPoint to_point(const std::array<std::uint32_t, 3>& numbers) {
        return {static_cast<std::int32_t>(numbers[0]), static_cast<std::int32_t>(numbers[1]),
                static_cast<std::int32_t>(numbers[2])};
    }

    std::uint32_t choose(Size size, std::uint32_t least, std::uint32_t most) {
        if (size == Size::one || most <= least) return least;
        return size == Size::most ? most : least + random_.below(most - least + 1);
    }
    Size some_size() { return static_cast<Size>(random_.below(3)); }

    void make_header() {
        head_.profile = static_cast<Profile>(random_.below(4));
        head_.bits = 1 + random_.below(24);
        const bool tame = random_.below(4) != 0;
        head_.step_exponent = tame ? random_.between(-30, 30) : random_.between(-100, 100);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t most = (1u << head_.bits) - 1;
            const unsigned kind = random_.below(6);
            head_.extent[axis] = kind == 0 ? 0 : kind == 1 ? most : random_.below(most + 1);
            float origin = std::ldexp(static_cast<float>(random_.between(-1000, 1000)), head_.step_exponent);
            if (!tame) origin = std::bit_cast<float>(static_cast<std::uint32_t>(random_.next()));
            const double steps = std::isfinite(origin) ? std::ldexp(double(origin), -head_.step_exponent) : 0.0;
            const double whole = std::abs(steps) < 0x1p24 ? std::nearbyint(steps) : steps;
            head_.origin[axis] = static_cast<float>(std::ldexp(whole, head_.step_exponent)) + 0.0f;  // never -0
        }
        head_.max_error = random_.unit();
        deepest_ = random_.below(3) == 0 ? 1 : random_.coin() ? 16 : 1 + random_.below(16);
        // A few thousand triangles at most; as a rule, so few that all can be asked about many times.
        const bool large = random_.below(32) == 0;
        node_budget_ = deepest_ + random_.below(large ? 24 : 3);
        leaf_budget_ = large ? 100 : 1 + random_.below(6);
        leaf_size_ = some_size();
        children_ = some_size();
        // Predicted strips leave out triangles in pairs only, whatever their area.
        flat_triangles_ = random_.below(8) == 0 || head_.profile == Profile::tiny;
        const std::uint32_t any = random_.below(512);  // features; all that exclude each other are taken out below
        head_.features = any & ~(1u << 4);
        if ((any & 2u) != 0) head_.features &= ~4u;
        if ((any & 1u) != 0 && random_.coin()) head_.features |= 1u << 10;
        if (head_.profile == Profile::fast && random_.below(4) == 0) head_.features |= 1u << 4;
    }

    [[nodiscard]] bool has(unsigned feature) const { return (head_.features >> feature & 1u) != 0; }

    std::int32_t between(std::int32_t low, std::int32_t high) { return random_.between(low, high); }

    /// Some of a region: all of it, a point of it, or any part.
    GridBox part_of(const GridBox& region) {
        GridBox part = any_part_of(region);
        for (int attempt = 0; attempt < 10 && !flat_triangles_ && !has_room(part); ++attempt)
            part = any_part_of(region);
        return part;
    }
    /// For triangles with area.
    static bool has_room(const GridBox& part) {
        int sides = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) sides += part.low[axis] != part.high[axis] ? 1 : 0;
        return sides >= 2;
    }
    GridBox any_part_of(const GridBox& region) {
        GridBox part = region;
        const unsigned kind = random_.below(8);
        for (std::size_t axis = 0; axis < 3 && kind > 1; ++axis) {
            const std::int32_t a = between(region.low[axis], region.high[axis]);
            const std::int32_t b = kind == 2 ? a : between(region.low[axis], region.high[axis]);
            if (random_.below(8) == 0) continue;  // this axis stays whole
            part.low[axis] = std::min(a, b);
            part.high[axis] = std::max(a, b);
        }
        return part;
    }

    [[nodiscard]] bool has_plain_nodes() const { return head_.profile == Profile::fast; }
    /// Of bases and of the planes of plain nodes, as a power of two.
    [[nodiscard]] unsigned unit() const { return head_.bits > 16 ? head_.bits - 16 : 0; }

    void make_frame(PlainNode& node, const GridBox& region) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.base[axis] = static_cast<std::uint32_t>(region.low[axis]) >> unit();
            if (random_.below(16) == 0) node.base[axis] = random_.below(node.base[axis] + 1);
            const auto reach = static_cast<std::uint32_t>(region.high[axis]) - (node.base[axis] << unit());
            while (255u << node.shift[axis] < reach) ++node.shift[axis];
            if (random_.below(16) == 0) node.shift[axis] = choose(Size::any, node.shift[axis], 17);
        }
    }

    std::size_t make_node(const GridBox& region, unsigned depth) {
        const std::size_t place = blob_.nodes.size();
        blob_.nodes.emplace_back();
        PlainNode node;
        if (!has_plain_nodes()) make_frame(node, region);
        std::uint32_t count = choose(children_, 1, has_plain_nodes() ? 16 : 8);
        std::uint32_t nodes = depth == deepest_ ? 0 : choose(some_size(), 1, count);
        nodes = std::min(nodes, node_budget_);
        node_budget_ -= nodes;
        count = std::max({count, nodes, 1u});
        const std::uint32_t leaves = std::max(nodes == 0 ? 1u : 0u, std::min(count - nodes, leaf_budget_));
        leaf_budget_ -= std::min(leaves, leaf_budget_);
        count = nodes + leaves;
        for (std::uint32_t i = 0; i < count; ++i) {
            const GridBox part = part_of(region);
            PlainChild child;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (has_plain_nodes()) {
                    child.low[axis] = static_cast<std::uint16_t>(part.low[axis] >> unit());
                    child.high[axis] = static_cast<std::uint16_t>(part.high[axis] >> unit());
                    continue;
                }
                const auto from = static_cast<std::int32_t>(node.base[axis] << unit());
                const std::int32_t round_up = (1 << node.shift[axis]) - 1;
                child.low[axis] = static_cast<std::uint16_t>((part.low[axis] - from) >> node.shift[axis]);
                child.high[axis] = static_cast<std::uint16_t>((part.high[axis] - from + round_up) >> node.shift[axis]);
            }
            if (i < nodes) child.node = make_node(part, depth + 1);
            else child.leaf = make_leaf(part, node.box_of(child, head_.profile, head_.bits));
            node.children.push_back(std::move(child));
        }
        blob_.nodes[place] = std::move(node);
        return place;
    }

    GridPoint point_in(const GridBox& part) {
        GridPoint point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const unsigned kind = random_.below(4);
            point[axis] = kind == 0   ? part.low[axis]
                          : kind == 1 ? part.high[axis]
                                      : between(part.low[axis], part.high[axis]);
        }
        return point;
    }

    /// The first three with area between them, if there is room for any.
    void add_vertices(PlainLeaf& leaf, const GridBox& part, std::uint32_t count) {
        for (int attempt = 0; attempt < 20; ++attempt) {
            leaf.vertices = {point_in(part), point_in(part), point_in(part)};
            if (flat_triangles_ || has_area(leaf.vertices[0], leaf.vertices[1], leaf.vertices[2])) break;
        }
        while (leaf.vertices.size() < count) leaf.vertices.push_back(point_in(part));
    }

    PlainLeaf make_leaf(const GridBox& part, const GridBox& box) {
        return head_.profile == Profile::fast ? make_triangles(part) : make_strip(part, box);
    }

    PlainLeaf make_triangles(const GridBox& part) {
        PlainLeaf leaf;
        add_vertices(leaf, part, choose(leaf_size_, 3, 32));
        const auto vertices = static_cast<std::uint32_t>(leaf.vertices.size());
        for (std::uint32_t count = choose(leaf_size_, 1, 16); count != 0; --count) {
            std::array<std::uint8_t, 3> triangle = {0, 1, 2};
            for (std::uint8_t& corner : triangle) corner = static_cast<std::uint8_t>(random_.below(vertices));
            const auto at = [&](std::size_t i) { return leaf.vertices[triangle[i]]; };
            if (!flat_triangles_ && !has_area(at(0), at(1), at(2))) triangle = {0, 1, 2};
            leaf.triangles.push_back(triangle);
        }
        return leaf;
    }

    PlainLeaf make_strip(const GridBox& part, const GridBox& box) {
        PlainLeaf leaf;
        const bool is_tiny = head_.profile == Profile::tiny;
        const std::uint32_t most = head_.profile == Profile::balanced ? 34 : is_tiny ? 64 : 56;
        // Three entries on one point have no data at all, which the format forbids.
        const std::uint32_t least = box.low == box.high ? 4 : 3;
        const std::uint32_t count = choose(leaf_size_, least, most);
        unsigned used = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const bool is_first = i < 3 || (used < 56 && random_.coin());
            const unsigned vertex = is_first ? used++ : random_.below(used);
            leaf.entries.push_back({vertex, i == 0 || (i + 2 < count && random_.below(3) == 0), false});
        }
        add_vertices(leaf, part, used);
        if (is_tiny) {
            add_joints(leaf);
            return leaf;
        }
        std::size_t pivot = 0;
        for (std::size_t window = 0; window + 2 < leaf.entries.size(); ++window) {
            if (leaf.entries[window].is_pivot) pivot = window;
            const auto at = [&](std::size_t entry) { return leaf.vertices[leaf.entries[entry].vertex]; };
            const bool good = flat_triangles_ || has_area(at(pivot), at(window + 1), at(window + 2));
            leaf.entries[window].is_triangle = window == 0 || (good && random_.below(4) != 0);
        }
        return leaf;
    }

    /// Marks the triangles of a predicted strip: all but two at each of up to 15 joints.
    void add_joints(PlainLeaf& leaf) {
        const std::size_t windows = leaf.entries.size() - 2;
        for (std::size_t window = 0; window < windows; ++window) leaf.entries[window].is_triangle = true;
        unsigned joints = 0;
        for (std::size_t window = 1; window + 2 < windows && joints < 15; ++window) {
            if (random_.below(4) != 0) continue;
            leaf.entries[window].is_triangle = leaf.entries[window + 1].is_triangle = false;
            window += 2;
            ++joints;
        }
    }

    std::int32_t length() {
        const std::int32_t most = 1 << 29;
        const unsigned kind = random_.below(4);
        return kind == 0 ? most : kind == 1 ? -most : between(-most, most);
    }

    /// A random tree of codes; the first takes every step.
    void make_id_kinds(unsigned number_bits) {
        const unsigned most = random_.below(8);
        blob_.id_kinds.resize(std::size_t{1} << most);
        std::vector<std::pair<std::size_t, unsigned>> codes = {{0, 0}};
        while (!codes.empty()) {
            const auto [code, prefix] = codes.back();
            codes.pop_back();
            if (prefix < most && random_.below(4) != 0) {
                codes.emplace_back(code, prefix + 1);
                codes.emplace_back(code + (std::size_t{1} << prefix), prefix + 1);
                continue;
            }
            PlainIdKind kind = {static_cast<std::uint32_t>(random_.next()), random_.below(number_bits + 1), prefix,
                                random_.below(8), random_.below(8)};
            if (code == 0) kind.width = number_bits;
            for (std::size_t row = code; row < blob_.id_kinds.size(); row += std::size_t{1} << prefix)
                blob_.id_kinds[row] = kind;
        }
    }

    void make_sections() {
        if (triangles_ == 0) head_.features &= 7u | 1u << 10;
        if (has(0)) {
            const std::uint32_t factor = head_.profile == Profile::fast ? 1 : 3;
            head_.source_triangles = (1 + random_.below(0xFFFFFFFFu / factor)) >> random_.below(32);
            if (head_.source_triangles == 0) head_.source_triangles = triangles_ == 0 ? random_.below(2) : 1;
            const std::uint32_t numbers = factor * head_.source_triangles;
            const std::uint32_t number_bits =
                numbers <= 1 ? 0 : static_cast<std::uint32_t>(std::bit_width(numbers - 1));
            make_id_kinds(number_bits);
            std::uint32_t first = 0;
            for (std::uint32_t i = random_.below(5) + (triangles_ == 0 ? 0 : 1); i != 0; --i) {
                head_.sources.push_back({first, random_.below(9), static_cast<std::uint32_t>(random_.next())});
                if (random_.coin()) first += random_.below(head_.source_triangles - first);
            }
        } else {
            head_.source_triangles = static_cast<std::uint32_t>(random_.next());
        }
        bool any_copy = false;
        for (std::uint32_t i = 0; i < triangles_; ++i) {
            head_.first_corners.push_back(static_cast<std::uint8_t>(random_.below(3)));
            head_.original_ids.push_back(random_.below(head_.source_triangles));
            if (has(1) || has(2))
                head_.materials.push_back(static_cast<std::uint16_t>(random_.below(has(1) ? 256 : 65536)));
            const std::uint32_t owner = i != 0 && random_.below(3) == 0 ? random_.below(i) : i;
            head_.owners.push_back(owner == i || head_.owners[owner] != owner ? i : owner);  // of no copy
            any_copy = any_copy || head_.owners.back() != i;
            head_.edge_flags.push_back({});
            for (std::uint8_t& flag : head_.edge_flags.back()) flag = static_cast<std::uint8_t>(random_.below(4));
        }
        if (has(4) && !any_copy) {
            if (triangles_ < 2) head_.features &= ~(1u << 4);  // there is no blob with copies that has none
            else head_.owners[1] = 0;
        }
        head_.flat_limit = random_.below((1u << 24) + 1);
        if (has(6)) {
            for (int i = 0; i < 4; ++i) head_.oriented_box.push_back(between(-2047, 2047));
            if (head_.oriented_box == std::vector<std::int32_t>(4, 0)) head_.oriented_box[0] = 1;
            for (int i = 0; i < 6; ++i) head_.oriented_box.push_back(length());
        }
        for (int i = 0; has(7) && i < 4; ++i) head_.sphere.push_back(length());
        for (int i = 0; has(8) && i < 20; ++i) head_.k_dop.push_back(length());
        if (random_.below(4) != 0) return;
        head_.features |= 1u << 11;
        // Any that is finite: of its exponent one bit is zero.
        for (std::uint64_t& coordinate : head_.source_origin) coordinate = random_.next() & ~(std::uint64_t{1} << 52);
    }

    Random& random_;
    PlainBlob blob_;
    DecodedBlob& head_ = blob_.decoded;
    std::uint32_t triangles_ = 0;
    unsigned deepest_ = 1;
    std::uint32_t node_budget_ = 0, leaf_budget_ = 0;
    Size leaf_size_ = Size::any;
    Size children_ = Size::any;
    bool flat_triangles_ = false;
};

}  // namespace

PlainBlob make_weird_blob(Random& random) { return Maker(random).run(); }

}  // namespace espalier::tests
