#include <baker/collapse/predicted_strip.hpp>

#include <bit>

namespace espalier::baker {

namespace {

/// Returns the bits needed to store the residual with a half-range bias; 0 for 0.
unsigned width_of(std::int32_t residual) {
    if (residual == 0) return 0;
    return static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(residual < 0 ? ~residual : residual))) + 1;
}

bool has(std::uint64_t bits, unsigned number) { return (bits >> number & 1) != 0; }

}  // namespace

OffsetWidths offset_widths(const BinaryNode& node) {
    OffsetWidths widths;
    for (std::size_t axis = 0; axis < 3; ++axis)
        widths[axis] = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(node.hi[axis] - node.lo[axis])));
    return widths;
}

PredictedStrip::PredictedStrip(const LatticeMesh& mesh, const Strip& strip)
    : numbered(strip), entry_count_(strip.entry_count) {
    for (unsigned window = 1; window + 2 < strip.entry_count; ++window)
        if (has(strip.windows, window - 1) && !has(strip.windows, window))
            joints[joint_count++] = static_cast<std::uint8_t>(window);
    predict(mesh, strip);
    for (std::size_t axis = 0; axis < 3; ++axis) choose_widths(axis);
}

void PredictedStrip::predict(const LatticeMesh& mesh, const Strip& strip) {
    const auto coordinate = [&](unsigned entry, std::size_t axis) {
        return coordinate_of(mesh.vertices[strip.entries[entry]], axis);
    };
    const std::uint64_t predicted = format::predicted_strip::predicted_entries(strip.windows);
    unsigned pivot = 0;  // of the window whose last entry is at hand
    for (unsigned entry = 0; entry < strip.entry_count; ++entry) {
        const unsigned pivot_before = pivot;
        const bool turns = entry >= 2 && has(strip.pivots, entry - 2);
        if (turns) pivot = entry - 2;
        if (!numbered.is_first_use(entry)) continue;
        Vertex& vertex = vertices[numbered.numbers[entry]];
        vertex.is_predicted = has(predicted, entry);
        predicted_count += vertex.is_predicted ? 1 : 0;
        const unsigned opposite = turns ? pivot_before : entry - 2;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            vertex.numbers[axis] = coordinate(entry, axis);
            if (vertex.is_predicted)
                vertex.numbers[axis] -=
                    coordinate(pivot, axis) + coordinate(entry - 1, axis) - coordinate(opposite, axis);
        }
    }
}

void PredictedStrip::choose_widths(std::size_t axis) {
    std::array<unsigned, 32> with_width{};
    unsigned large = 0;
    for (unsigned i = 0; i < numbered.vertex_count; ++i) {
        if (!vertices[i].is_predicted) continue;
        const unsigned width = width_of(vertices[i].numbers[axis]);
        ++with_width[width];
        large = large < width ? width : large;
    }
    unsigned fitting = 0;
    std::size_t fewest_bits = std::size_t{predicted_count} * large;
    large_width[axis] = small_width[axis] = large;
    for (unsigned width = 0; width < large; ++width) {
        fitting += with_width[width];
        const std::size_t bits = fitting * width + (predicted_count - fitting) * large;
        if (bits >= fewest_bits) continue;
        fewest_bits = bits;
        small_width[axis] = width;
    }
    residual_bits_ += fewest_bits;
}

bool PredictedStrip::is_large(unsigned vertex, std::size_t axis) const {
    return width_of(vertices[vertex].numbers[axis]) > small_width[axis];
}

std::size_t PredictedStrip::bits(const OffsetWidths& offsets) const {
    return format::predicted_strip::choices_at(entry_count_, joint_count, numbered.vertex_count) + 3 * predicted_count +
           std::size_t{numbered.vertex_count - predicted_count} * (offsets[0] + offsets[1] + offsets[2]) +
           residual_bits_;
}

}  // namespace espalier::baker
