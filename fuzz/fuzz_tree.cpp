// Blobs that follow the format and that no baker would make: the input says what to build. They must open, mean to the
// independent decoder what was written, and stand everything that a blob must. Some are deformable, and walk through
// poses too.
#include <algorithm>
#include <exception>
#include <span>

#include <espalier/espalier.hpp>

#include "judge.hpp"
#include "refit/deform.hpp"
#include "refit/walk.hpp"
#include "support/blobs/weird_blobs.hpp"
#include "support/machine/exact_buffer.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Triangles in the order of the walk, which is that of storage.
void add_triangles(const PlainBlob& blob, std::size_t node, std::vector<GridTriangle>& triangles) {
    for (const PlainChild& child : blob.nodes[node].children) {
        if (!child.leaf) continue;
        const std::vector<GridTriangle> corners = child.leaf->corners();
        triangles.insert(triangles.end(), corners.begin(), corners.end());
    }
    for (const PlainChild& child : blob.nodes[node].children)
        if (!child.leaf) add_triangles(blob, child.node, triangles);
}

void compare(const PlainBlob& plain, std::span<const std::byte> bytes, bool has_copies) {
    std::vector<GridTriangle> triangles;
    if (!plain.nodes.empty()) add_triangles(plain, 0, triangles);
    try {
        if (decode(bytes).triangles != triangles) fuzz::fail("decoder", "reads other triangles than were written");
    } catch (const std::exception& error) {
        if (!has_copies) fuzz::fail("decoder", error.what());  // copies are of any triangle here
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    // What comes last says what is asked.
    const auto input = std::as_bytes(std::span(data, size));
    const std::size_t for_arguments = std::min<std::size_t>(size / 4, 256);
    Random shape(size, input.first(size - for_arguments));
    PlainBlob plain = make_weird_blob(shape);
    if (fuzz::can_deform(plain) && shape.below(3) == 0) fuzz::deform(plain, shape);
    const ExactBuffer buffer(encode(plain), size % 16);
    const Blob blob = open(buffer.bytes());
    if (!blob) fuzz::fail("open", describe(blob.status()));
    compare(plain, buffer.bytes(), blob.duplicate_reference_count() != 0);
    Random arguments(size, input.last(for_arguments));
    fuzz::judge(buffer.bytes(), blob, arguments);
    if (blob.is_deformable()) fuzz::walk_poses(buffer.bytes(), arguments);
    return 0;
}
