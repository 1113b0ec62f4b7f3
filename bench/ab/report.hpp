// What bench/ab prints: a table for people, or one JSON object for each row.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "turns.hpp"

namespace espalier::bench {

/// What is compared, the same for all rows.
struct Heading {
    std::string base, other;  ///< commits
    std::string base_compiler, other_compiler;
    unsigned bits = 16;
    bool printed = false;
};

/// The rows of one mesh in one profile have this in common.
struct Baking {
    std::string mesh, profile, set;
    std::size_t triangles = 0;
    std::size_t base_bytes = 0, other_bytes = 0;
    bool same_bytes = false;
};

void print_heading(const Heading& heading);
void print_baking(const Baking& baking);
void print_row(const std::string& questions, const std::optional<Comparison>& comparison);
void print_json(const Heading& heading, const Baking& baking, const std::string& questions,
                const std::optional<Comparison>& comparison);

}  // namespace espalier::bench
