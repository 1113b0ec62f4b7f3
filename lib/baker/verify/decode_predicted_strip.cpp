#include <algorithm>

#include <baker/verify/decode_tree.hpp>
#include <baker/verify/field_reader.hpp>

namespace espalier::baker {

namespace {

constexpr std::size_t most = format::max_leaf_entries;

/// The part of a predicted strip before its coordinates.
struct PredictedMarks {
    std::array<unsigned, 3> large{}, small{};
    unsigned entry_count = 0;
    std::array<bool, most> is_pivot{true};
    std::array<bool, most> is_triangle{};  ///< by window
    std::array<bool, most> is_first_use{true, true, true};
    unsigned joint_count = 0;
};

bool read_marks(FieldReader& fields, unsigned entry_count, PredictedMarks& marks) {
    marks.entry_count = entry_count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        marks.large[axis] = fields.next(5);
        marks.small[axis] = fields.next(5);
    }
    marks.joint_count = fields.next(4);
    for (unsigned i = 1; i + 2 < entry_count; ++i) marks.is_pivot[i] = fields.next(1) != 0;
    for (unsigned i = 3; i < entry_count; ++i) marks.is_first_use[i] = fields.next(1) != 0;
    std::fill_n(marks.is_triangle.begin(), entry_count - 2, true);
    for (unsigned i = 0; i < marks.joint_count; ++i) {
        const std::uint32_t window = fields.next(6);
        if (window == 0 || window + 5 > entry_count) return false;
        marks.is_triangle[window] = marks.is_triangle[window + 1] = false;
    }
    return true;
}

}  // namespace

bool TreeBytes::decode_predicted_strip(const DecodedNode& node, unsigned index, DecodedLeaf& leaf) const {
    // Where leaves begin, and with which triangle, follows from the leaves before them.
    leaf.at = first_leaf_at(node);
    if (leaf.at > leaves.size()) return false;
    leaf.first_triangle = read(leaves, node.leaf_block, 4);
    PredictedMarks marks;
    for (unsigned number = 0;; ++number) {
        const std::uint32_t descriptor = read(leaves, node.leaf_block + 4 + 2 * std::size_t{number}, 2);
        leaf.bytes = descriptor & 1023;
        if (leaf.bytes > leaves.size() - leaf.at) return false;
        const unsigned entry_count = (descriptor >> 10) + 3;
        if (entry_count > most) return false;
        if (number == index) {
            marks.entry_count = entry_count;
            break;
        }
        if (leaf.bytes < 5) return false;
        FieldReader counting(leaves.subspan(leaf.at, leaf.bytes));
        static_cast<void>(counting.next(30));
        leaf.first_triangle += entry_count - 2 - 2 * counting.next(4);
        leaf.at += leaf.bytes;
    }
    const unsigned entry_count = marks.entry_count;
    // First up to the joints, then up to the choices of widths, then all: each count of bits follows from those before.
    std::size_t size = 34 + 2 * std::size_t{entry_count - 3};
    if (size > 8 * leaf.bytes) return false;
    FieldReader counting(leaves.subspan(leaf.at, leaf.bytes));
    static_cast<void>(counting.next(30));
    size += 6 * counting.next(4);
    if (size > 8 * leaf.bytes) return false;
    FieldReader fields(leaves.subspan(leaf.at, leaf.bytes));
    if (!read_marks(fields, entry_count, marks)) return false;
    leaf.vertex_count =
        static_cast<unsigned>(std::count(marks.is_first_use.begin(), marks.is_first_use.begin() + entry_count, true));
    if (leaf.vertex_count > leaf.vertices.size()) return false;
    const unsigned reference_width = format::strip_leaf::reference_width(leaf.vertex_count);
    size += (entry_count - leaf.vertex_count) * reference_width;
    if (size > 8 * leaf.bytes) return false;

    std::array<unsigned, most> entries{};
    std::array<bool, most> is_predicted{};  // by vertex
    unsigned used = 0;
    for (unsigned i = 0; i < entry_count; ++i) {
        if (marks.is_first_use[i]) is_predicted[used] = i >= 3 && marks.is_triangle[i - 2] && marks.is_triangle[i - 3];
        entries[i] = marks.is_first_use[i] ? used++ : fields.next(reference_width);
        if (entries[i] >= used) return false;
    }
    std::array<std::array<bool, 3>, most> is_large{};
    size += 3 * static_cast<std::size_t>(std::count(is_predicted.begin(), is_predicted.end(), true));
    if (size > 8 * leaf.bytes) return false;
    for (unsigned i = 0; i < used; ++i)
        for (bool& large : is_large[i]) large = is_predicted[i] && fields.next(1) != 0;

    const DecodedBox& box = node.boxes[node.node_children + index];
    std::array<std::array<unsigned, 3>, most> widths{};
    for (unsigned i = 0; i < used; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            widths[i][axis] = is_large[i][axis] ? marks.large[axis]
                              : is_predicted[i] ? marks.small[axis]
                                                : format::strip_leaf::coordinate_width(
                                                      static_cast<std::uint32_t>(box.hi[axis] - box.lo[axis]), bits);
            size += widths[i][axis];
        }
    }
    if ((size + 7) / 8 != leaf.bytes) return false;

    unsigned pivot = 0, pivot_before = 0;  // of the window that ends with the entry, and of the one before
    bool keeps_order = true;               // of that window
    used = 0;
    leaf.triangle_count = 0;
    for (unsigned i = 0; i < entry_count; ++i) {
        const bool turns = i > 2 && marks.is_pivot[i - 2];
        pivot_before = pivot;
        if (turns) pivot = i - 2;
        keeps_order ^= turns;
        if (marks.is_first_use[i]) {
            const unsigned opposite = i < 2 ? 0 : entries[turns ? pivot_before : i - 2];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const unsigned width = widths[used][axis];
                auto number = static_cast<std::int64_t>(fields.next(width));
                if (is_predicted[used]) {
                    const auto along = [&](unsigned vertex) { return std::int64_t{leaf.vertices[vertex][axis]}; };
                    number += along(entries[pivot]) + along(entries[i - 1]) - along(opposite) -
                              (width == 0 ? 0 : std::int64_t{1} << (width - 1));
                } else {
                    number += box.lo[axis];
                }
                if (number < 0 || number >= std::int64_t{1} << format::max_bits) return false;
                leaf.vertices[used][axis] = static_cast<std::int32_t>(number);
            }
            ++used;
        }
        if (i < 2 || !marks.is_triangle[i - 2]) continue;
        const unsigned one = entries[i - 1], other = entries[i];
        leaf.corners[leaf.triangle_count++] = {entries[pivot], keeps_order ? one : other, keeps_order ? other : one};
    }
    return true;
}

}  // namespace espalier::baker
