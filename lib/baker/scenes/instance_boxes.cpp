#include <baker/scenes/instance_boxes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/format.hpp>

#include <baker/base/float_rounding.hpp>

namespace espalier::baker {

namespace {

/// A part is placed by about that many boxes.
constexpr std::size_t enough_boxes = 128;

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
    const TreeBytes tree{{data.nodes, data.node_count * node_bytes}, {}, data.bits, data.profile, false, extent};
    // A node and its box: those of the upper levels, breadth first, until there are enough boxes.
    struct Node {
        std::uint32_t number;
        DecodedBox box;
    };
    std::vector<Node> waiting = {{0, {{}, extent}}};
    std::vector<DecodedBox> boxes;
    for (std::size_t next = 0; next < waiting.size(); ++next) {
        const Node node = waiting[next];
        DecodedNode decoded;
        if (waiting.size() - next + boxes.size() > enough_boxes || !tree.decode_node(node.number, decoded)) {
            boxes.push_back(node.box);
            continue;
        }
        for (unsigned child = 0; child < decoded.children(); ++child) {
            const DecodedBox box = node.box.intersection(decoded.boxes[child]);
            if (child < decoded.node_children) waiting.push_back({decoded.first_child + child, box});
            else boxes.push_back(box);
        }
    }
    for (const DecodedBox& box : boxes) boxes_.push_back(local_box(data, box));
    lattice_ = {local_box(data, {{}, extent})};
}

PartBoxes::LocalBox PartBoxes::local_box(const detail::BlobData& tree, const DecodedBox& box) {
    const double step = std::ldexp(1.0, tree.step_exponent);
    LocalBox local{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = double(tree.origin[k]) + box.lo[k] * step, high = double(tree.origin[k]) + box.hi[k] * step;
        local.center[k] = (low + high) / 2;
        local.half[k] = (high - low) / 2;
    }
    return local;
}

WorldBox PartBoxes::place(std::span<const LocalBox> boxes, const Transform& transform) {
    const Matrix matrix = matrix_of(transform.rotation);
    const Vector translation = coordinates_of(transform.translation);
    if (boxes.empty()) return {translation, translation};
    const auto scale = double(transform.scale);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    WorldBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    double size = 0.0;
    for (const LocalBox& local : boxes) {
        double of_box = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            double middle = 0.0, reach = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                middle += matrix[i][k] * local.center[k];
                reach += std::abs(matrix[i][k]) * local.half[k];
            }
            box.lo[i] = std::min(middle - reach, box.lo[i]);
            box.hi[i] = std::max(middle + reach, box.hi[i]);
            of_box += std::abs(local.center[i]) + local.half[i];
        }
        size = std::max(of_box, size);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        // to_local() and to_world() are within 2^-19 of the size; the queries' slack does not cover the box itself.
        const double margin = scale * size * 0x1p-17 + 0x1p-98 + std::abs(translation[i]) * 0x1p-50;
        box.lo[i] = translation[i] + scale * box.lo[i] - margin;
        box.hi[i] = translation[i] + scale * box.hi[i] + margin;
    }
    return box;
}

WorldBox PartBoxes::at(const Transform& transform) const { return place(boxes_, transform); }

WorldBox PartBoxes::lattice_at(const Transform& transform) const {
    WorldBox box = place(lattice_, transform);
    const Vector translation = coordinates_of(transform.translation);
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
