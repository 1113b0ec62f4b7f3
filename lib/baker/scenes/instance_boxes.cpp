#include <baker/scenes/instance_boxes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/format.hpp>

#include <baker/base/float_rounding.hpp>

namespace espalier::baker {

namespace {

/// A search in a direction measures about as many boxes; surfaces across the direction could need all of them.
constexpr std::size_t most_boxes = 512;

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector coordinates_of(const Vec3& v) { return {double(v.x), double(v.y), double(v.z)}; }

Matrix matrix_of(const Quaternion& rotation) {
    const auto x = double(rotation.x), y = double(rotation.y), z = double(rotation.z), w = double(rotation.w);
    const double n = x * x + y * y + z * z + w * w;
    return {{{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
             {2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
             {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n}}};
}

// The subtraction of an origin in double may lose a small part of a coordinate; a sum of whole steps loses nothing.

/// Returns the last step at or below a coordinate.
double step_below(double coordinate, double origin, double step) {
    const double steps = std::floor((coordinate - origin) / step);
    return origin + steps * step > coordinate ? steps - 1 : steps;
}

/// Returns the first step at or above a coordinate.
double step_above(double coordinate, double origin, double step) {
    const double steps = std::ceil((coordinate - origin) / step);
    return origin + steps * step < coordinate ? steps + 1 : steps;
}

/// Rounds the boxes outward onto the lattice of that step. False if it is too fine for them.
bool round_boxes(std::span<const WorldBox> boxes, const WorldBox& all, BoxLattice& lattice) {
    const double step = std::ldexp(1.0, lattice.step_exponent);
    Vector origin{};
    for (std::size_t k = 0; k < 3; ++k) {
        // A float that is rounded to more than a step is a multiple of the step as well.
        origin[k] = double(round_down_to_float(std::floor(all.lo[k] / step) * step));
        if (origin[k] == 0.0) origin[k] = 0.0;  // not -0
        const double extent = step_above(all.hi[k], origin[k], step);
        if (!(extent < double{1 << format::scene::bits})) return false;
        lattice.extent[k] = static_cast<std::int32_t>(extent);
    }
    lattice.origin = {static_cast<float>(origin[0]), static_cast<float>(origin[1]), static_cast<float>(origin[2])};
    lattice.boxes.clear();
    for (const WorldBox& box : boxes) {
        ChildBox rounded{};
        for (std::size_t k = 0; k < 3; ++k) {
            rounded.lo[k] = static_cast<std::int32_t>(step_below(box.lo[k], origin[k], step));
            rounded.hi[k] = static_cast<std::int32_t>(step_above(box.hi[k], origin[k], step));
        }
        lattice.boxes.push_back(rounded);
    }
    return true;
}

}  // namespace

PartBoxes::PartBoxes(const ScenePart& part) {
    const detail::BlobData& data = part.tree();
    if (data.node_count == 0) return;
    const bool is_fast = data.profile == Profile::fast;
    const std::size_t node_bytes = is_fast ? format::plain_node::bytes : format::packed_node::bytes;
    const Coordinates extent = {data.extent[0], data.extent[1], data.extent[2]};
    const DecodedBox whole = {{}, extent};
    add_nodes({{data.nodes, data.node_count * node_bytes}, {}, data.bits, data.profile, false, extent}, data, whole);
    for (const Node& node : nodes_)
        if (node.children == 0) size_ = std::max(node.box.size(), size_);
    // Queries of a deformable mesh are rounded by its range, which may be larger than its pose.
    if (data.corners != nullptr) size_ = std::max(LocalBox(data, whole).size(), size_);
    lattice_.emplace_back(data, whole);
}

void PartBoxes::add_nodes(const TreeBytes& tree, const detail::BlobData& data, const DecodedBox& whole) {
    struct InTree {
        std::uint32_t number;
        bool is_leaf;
        DecodedBox box;
    };
    std::vector<InTree> in_tree = {{0, false, whole}};
    for (std::size_t next = 0; next < in_tree.size(); ++next) {
        const InTree source = in_tree[next];
        Node& node = nodes_.emplace_back(Node{LocalBox(data, source.box)});
        DecodedNode decoded;
        if (source.is_leaf || !tree.decode_node(source.number, decoded)) continue;
        node.first_child = static_cast<std::uint32_t>(in_tree.size());
        node.children = decoded.children();
        for (unsigned child = 0; child < decoded.children(); ++child)
            in_tree.push_back({decoded.first_child + child, child >= decoded.node_children,
                               source.box.intersection(decoded.boxes[child])});
    }
}

PartBoxes::LocalBox::LocalBox(const detail::BlobData& tree, const DecodedBox& box) {
    const double step = std::ldexp(1.0, tree.step_exponent);
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = double(tree.origin[k]) + box.lo[k] * step, high = double(tree.origin[k]) + box.hi[k] * step;
        center[k] = (low + high) / 2;
        half[k] = std::max((high - low) / 2, 0.0);  // nodes that contradict each other leave no box
    }
}

double PartBoxes::LocalBox::farthest(const Vector& direction) const {
    double middle = 0.0, reach = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        middle += direction[k] * center[k];
        reach += std::abs(direction[k]) * half[k];
    }
    return middle + reach;
}

double PartBoxes::LocalBox::size() const {
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) size += std::abs(center[k]) + half[k];
    return size;
}

double PartBoxes::farthest(const Vector& direction) const {
    struct Waiting {
        double farthest;
        std::uint32_t node;
    };
    double best = -std::numeric_limits<double>::infinity();
    std::size_t measured = 0;
    std::vector<Waiting> stack = {{nodes_.front().box.farthest(direction), 0}};
    while (!stack.empty()) {
        const Waiting waiting = stack.back();
        stack.pop_back();
        if (waiting.farthest <= best) continue;
        const Node& node = nodes_[waiting.node];
        if (node.children == 0 || measured > most_boxes) {
            best = waiting.farthest;
            continue;
        }
        measured += node.children;
        const std::size_t first = stack.size();
        for (std::uint32_t i = 0; i < node.children; ++i) {
            const std::uint32_t child = node.first_child + i;
            const double farthest = nodes_[child].box.farthest(direction);
            if (farthest <= best) continue;
            stack.push_back({farthest, child});
            // The farthest one is next.
            if (farthest < stack[first].farthest) continue;
            std::swap(stack[first], stack.back());
        }
        if (stack.size() > first) std::swap(stack[first], stack.back());
    }
    return best;
}

namespace {

/// Returns the box around a part at a place, from how far the part reaches in a local direction.
template <class Farthest>
WorldBox placed(const Transform& transform, double size, Farthest farthest) {
    const Matrix matrix = matrix_of(transform.rotation);
    const Vector translation = coordinates_of(transform.translation);
    const auto scale = double(transform.scale);
    WorldBox box{};
    for (std::size_t i = 0; i < 3; ++i) {
        // to_local() and to_world() are within 2^-19 of the size; the queries' slack does not cover the box itself.
        const double margin = scale * size * 0x1p-17 + 0x1p-98 + std::abs(translation[i]) * 0x1p-50;
        const Vector& up = matrix[i];
        box.lo[i] = translation[i] - scale * farthest(Vector{-up[0], -up[1], -up[2]}) - margin;
        box.hi[i] = translation[i] + scale * farthest(up) + margin;
    }
    return box;
}

}  // namespace

WorldBox PartBoxes::at(const Transform& transform) const {
    const Vector translation = coordinates_of(transform.translation);
    if (nodes_.empty()) return {translation, translation};
    return placed(transform, size_, [&](const Vector& direction) { return farthest(direction); });
}

WorldBox PartBoxes::lattice_at(const Transform& transform) const {
    const Vector translation = coordinates_of(transform.translation);
    if (lattice_.empty()) return {translation, translation};
    const LocalBox& lattice = lattice_.front();
    WorldBox box =
        placed(transform, lattice.size(), [&](const Vector& direction) { return lattice.farthest(direction); });
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(translation[k], box.lo[k]);
        box.hi[k] = std::max(translation[k], box.hi[k]);
    }
    return box;
}

bool fit_boxes(std::span<const WorldBox> boxes, std::span<const WorldBox> around, BoxLattice& lattice) {
    if (boxes.empty()) return true;
    WorldBox all = boxes.front();
    for (const auto& kind : {boxes, around})
        for (const WorldBox& box : kind)
            for (std::size_t k = 0; k < 3; ++k) {
                all.lo[k] = std::min(all.lo[k], box.lo[k]);
                all.hi[k] = std::max(all.hi[k], box.hi[k]);
            }
    constexpr double most = 0x1p127;
    for (std::size_t k = 0; k < 3; ++k)
        if (!(all.lo[k] >= -most && all.hi[k] <= most)) return false;
    for (int exponent = format::min_step_exponent; exponent <= format::max_step_exponent; ++exponent) {
        lattice.step_exponent = exponent;
        if (round_boxes(boxes, all, lattice)) return true;
    }
    return false;
}

}  // namespace espalier::baker
