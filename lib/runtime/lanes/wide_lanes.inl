// What instruction sets share whose registers hold all vertices of a leaf.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/lanes/alone.hpp>
#endif

/// A vertex for each lane, and the three vertices of a triangle in each.
using Numbers = Ints;
struct CornerNumbers {
    Numbers a, b, c;
};
inline Numbers load_numbers(const std::byte* bytes) { return load_bytes(bytes); }
inline Numbers load_numbers(const std::uint32_t* from) { return load_ints(from); }

/// Values by vertex.
template <unsigned groups>
struct Registers {
    Floats group[groups];
    static unsigned groups_of(unsigned) { return groups; }
    void set(unsigned number, Floats a) { group[number] = a; }
};
/// The function with the number of registers that this many vertices fill.
template <unsigned max_vertices, unsigned groups, class Function>
[[gnu::always_inline]] constexpr auto with_groups_from(unsigned vertex_count, Function function) {
    if constexpr (groups * lanes >= max_vertices) return function(std::integral_constant<unsigned, groups>{});
    else if (vertex_count <= groups * lanes) return function(std::integral_constant<unsigned, groups>{});
    else return with_groups_from<max_vertices, groups + 1>(vertex_count, function);
}
template <unsigned max_vertices, class Function>
constexpr auto with_table_groups(unsigned vertex_count, Function function) {
    return with_groups_from<max_vertices, 1>(vertex_count, function);
}
