// What the vocabulary of an instruction set (lanes/<set>.hpp) provides, and fragments rely on. A lane holds a triangle
// or a vertex of a leaf, or a child of a node. The sets share names and no base class: a fragment is compiled in the
// namespace of each, and this header checks that the names are there.
#ifndef ESPALIER_LANES_CONTRACT_HPP
#define ESPALIER_LANES_CONTRACT_HPP

#include <concepts>
#include <cstddef>
#include <cstdint>

#include <runtime/lanes/set.hpp>

ESPALIER_BEGIN_SET

static_assert(lanes * sizeof(float) == sizeof(Floats) && sizeof(Ints) == sizeof(Floats) &&
              sizeof(SignedInts) == sizeof(Floats) && sizeof(Compared) == sizeof(Floats));

// Numbers. `at_most` returns a bit for each lane, smaller(a, b) and larger(a, b) return b where either is NaN, and
// multiply_add may be fused: what it computes decides only with a bound that allows for both ways of rounding.
static_assert(requires(Floats a, Ints i, SignedInts s, Compared c, const std::byte* bytes, const std::uint32_t* words,
                       float* floats) {
    { load_bytes(bytes) } -> std::same_as<Ints>;
    { load_words(bytes) } -> std::same_as<Ints>;
    { load_ints(words) } -> std::same_as<Ints>;
    { bytes_to_floats(bytes) } -> std::same_as<Floats>;
    { to_floats(i) } -> std::same_as<Floats>;
    { to_compared(a) } -> std::same_as<Compared>;
    { splat(0.0f) } -> std::same_as<Floats>;
    { splat_integer(0) } -> std::same_as<SignedInts>;
    { add(a, a) } -> std::same_as<Floats>;
    { subtract(a, a) } -> std::same_as<Floats>;
    { multiply(a, a) } -> std::same_as<Floats>;
    { divide(a, a) } -> std::same_as<Floats>;
    { multiply_add(a, a, a) } -> std::same_as<Floats>;
    { multiply_subtract(a, a, a) } -> std::same_as<Floats>;
    { square_roots(a) } -> std::same_as<Floats>;
    { negate(a) } -> std::same_as<Floats>;
    { magnitude(a) } -> std::same_as<Floats>;
    { smaller(a, a) } -> std::same_as<Floats>;
    { larger(a, a) } -> std::same_as<Floats>;
    { where_at_most(a, a, a, a) } -> std::same_as<Floats>;
    { at_most(a, a) } -> std::same_as<unsigned>;
    { at_most(s, s) } -> std::same_as<unsigned>;
    store(floats, a);
    store_compared(floats, c);
});

// Pairs of 16-bit integers in a lane: two coordinates of a vertex, and the products that tell on which side of an edge
// the ray passes. With sixteen lanes floats are as fast.
#if ESPALIER_LANES <= 8
static_assert(requires(Floats a, Ints pair) {
    { pair_of(a, a) } -> std::same_as<Ints>;
    { cross_pairs(pair, pair) } -> std::same_as<SignedInts>;
    { weigh_magnitudes(pair, pair, pair, 1) } -> std::same_as<SignedInts>;
});
#endif

// Leaves: fields of any width out of a stream of bits, the vertices of each triangle, and tables that are looked up by
// these.
static_assert(requires(const std::byte* bytes, const std::uint32_t* words, const StripLeaf& strip,
                       const PlainLeaf& plain, Numbers number, Table<2> table, PairTable<2> pairs) {
    { unpack(bytes, 1u, 0u) } -> std::same_as<Ints>;
    { offsets_of(strip, 0u, 0u) } -> std::same_as<Ints>;
    { offsets_of(plain, 0u, 0u) } -> std::same_as<Ints>;
    { load_numbers(bytes) } -> std::same_as<Numbers>;
    { load_numbers(words) } -> std::same_as<Numbers>;
    { corners_of(strip).next() } -> std::same_as<CornerNumbers>;
    { corners_of(plain).next() } -> std::same_as<CornerNumbers>;
    { table.look_up(number) } -> std::same_as<Floats>;
    { pairs.look_up(number) } -> std::same_as<Ints>;
    { owner_index(strip, 0u) } -> std::same_as<std::uint32_t>;
});

// Nodes: the frame that turns the planes of a packed node into lattice steps, or into distances along a ray; and boxes
// in whole steps.
static_assert(requires(const PackedNode& node, const BlobData& blob, const RayLanes& ray, const std::int32_t (*rows)[8],
                       const std::int32_t* box) {
    { load_frame(node, blob) } -> std::same_as<Frame>;
    { load_slab_frame(node, ray) } -> std::same_as<SlabFrame>;
    { eight_that_touch(rows, rows, box, box) } -> std::same_as<unsigned>;
});

ESPALIER_END_SET

#endif
