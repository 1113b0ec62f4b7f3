#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/collapse/predicted_strip.hpp>
#include <baker/encode/leaf.hpp>

namespace espalier::baker {

namespace {

void put_marks(const Strip& strip, const PredictedStrip& predicted, BitStream& stream) {
    const NumberedEntries& numbered = predicted.numbered;
    const auto put_row = [&](std::uint64_t marks) {
        for (unsigned i = 0; i + 3 < strip.entry_count; ++i) stream.put(static_cast<std::uint32_t>(marks >> i & 1), 1);
    };
    put_row(strip.pivots >> 1);
    put_row(numbered.first_uses >> 3);
    for (unsigned i = 0; i < predicted.joint_count; ++i)
        stream.put(predicted.joints[i], format::predicted_strip::place_bits);
    const unsigned reference_width = format::strip_leaf::reference_width(numbered.vertex_count);
    for (unsigned entry = 3; entry < strip.entry_count; ++entry)
        if (!numbered.is_first_use(entry)) stream.put(numbered.numbers[entry], reference_width);
}

void put_vertex(const PredictedStrip& predicted, unsigned number, const LeafBox& box, unsigned bits,
                BitStream& stream) {
    const PredictedStrip::Vertex& vertex = predicted.vertices[number];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!vertex.is_predicted) {
            stream.put(static_cast<std::uint32_t>(vertex.numbers[axis] - box.anchor[axis]),
                       format::strip_leaf::coordinate_width(static_cast<std::uint32_t>(box.side[axis]), bits));
            continue;
        }
        const unsigned width =
            predicted.is_large(number, axis) ? predicted.large_width[axis] : predicted.small_width[axis];
        stream.put(static_cast<std::uint32_t>(vertex.numbers[axis] + static_cast<std::int32_t>((1u << width) / 2)),
                   width);
    }
}

}  // namespace

std::uint32_t put_predicted_strip(const LatticeMesh& mesh, const WideTree& wide, std::uint32_t number,
                                  const LeafBox& box, std::vector<std::byte>& bytes) {
    const Strip& strip = wide.strips[number];
    const PredictedStrip predicted(mesh, strip);
    const std::size_t begin = bytes.size();
    BitStream stream(bytes);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stream.put(predicted.large_width[axis], format::predicted_strip::width_bits);
        stream.put(predicted.small_width[axis], format::predicted_strip::width_bits);
    }
    stream.put(predicted.joint_count, format::predicted_strip::joint_count_bits);
    put_marks(strip, predicted, stream);
    for (unsigned i = 0; i < predicted.numbered.vertex_count; ++i) {
        if (!predicted.vertices[i].is_predicted) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) stream.put(predicted.is_large(i, axis) ? 1 : 0, 1);
    }
    for (unsigned i = 0; i < predicted.numbered.vertex_count; ++i)
        put_vertex(predicted, i, box, mesh.lattice.bits, stream);
    stream.finish();
    return static_cast<std::uint32_t>(bytes.size() - begin) | (strip.entry_count - 3)
                                                                  << format::predicted_strip::entries_shift;
}

}  // namespace espalier::baker
