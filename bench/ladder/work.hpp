// What walks through trees count.
#pragma once

#include <cstdint>

namespace espalier::bench {

struct TreeWork {
    std::uint64_t nodes = 0;  ///< whose children were tested
    std::uint64_t leaves = 0;
    std::uint64_t box_tests = 0;  ///< the root's included
    std::uint64_t triangle_tests = 0;

    void count_node() { ++nodes; }
    void count_box() { ++box_tests; }
    void count_leaf(std::uint32_t triangles) {
        ++leaves;
        triangle_tests += triangles;
    }
    TreeWork& operator+=(const TreeWork& more) {
        nodes += more.nodes;
        leaves += more.leaves;
        box_tests += more.box_tests;
        triangle_tests += more.triangle_tests;
        return *this;
    }
    friend bool operator==(const TreeWork&, const TreeWork&) = default;
};

/// Counts nothing: for walks that are timed.
struct NoWork {
    void count_node() {}
    void count_box() {}
    void count_leaf(std::uint32_t) {}
};

}  // namespace espalier::bench
