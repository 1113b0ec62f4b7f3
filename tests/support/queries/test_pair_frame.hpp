// Two blobs on their common grid, for tests that call the queries of an instruction set.
#pragma once

#include <runtime/blob/plain_leaf.hpp>
#include <runtime/blob/strip_leaf.hpp>
#include <runtime/pairs/frame.hpp>

namespace espalier::tests {

/// A frame with room for the vertices of predicted strips.
struct TestPairFrame : detail::PairFrame {
    detail::PredictedVertices room[2];

    TestPairFrame() { vertices = room; }
    TestPairFrame(const TestPairFrame& other) : PairFrame(other) { vertices = room; }
    TestPairFrame& operator=(const TestPairFrame& other) {
        PairFrame::operator=(other);
        vertices = room;
        return *this;
    }
};

}  // namespace espalier::tests
