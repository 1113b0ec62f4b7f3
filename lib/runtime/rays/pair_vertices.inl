// A leaf's vertices as the filter of rays reads them: pairs of small integers, for instruction sets that keep them on
// the stack.
#include <runtime/rays/float_vertices.inl>

/// The same as pairs of 16-bit integers, in half the room: `scale_` makes 2^14 of twice the leaf's size. What is
/// larger, as it may be of triangles that are not hit, becomes anything. Edge functions of them are exact; that the
/// integers are coarse, each triangle's own size pays for: the nearer its corners, the less their errors move its
/// edges.
template <unsigned groups>
class PairVertices {
public:
    template <class Leaf>
    [[gnu::always_inline]] PairVertices(const Leaf& leaf, const LatticeRay& ray) {
        // 2^(13 - w) for a size of 2^w.
        const std::uint32_t size = std::bit_cast<std::uint32_t>(static_cast<float>(1u << leaf.size_bits));
        scale_ = std::bit_cast<float>(((2u * 127u + 13u) << 23) - size);
        const float error = ray.shear_error * scale_ + 0.5f;
        // Larger ones could make the integers overflow, and nothing is rejected.
        const bool is_small = error < 512.0f;
        weight_ = is_small ? static_cast<std::int32_t>(error * 34.0f) + 1 : 0;
        always_allowed_ = is_small ? static_cast<std::int32_t>(error * error * 2.125f) + 2 : INT32_MAX;
    }
    static unsigned groups_of(unsigned vertex_count) { return (vertex_count + lanes - 1) / lanes; }
    [[gnu::always_inline]] void set(unsigned group, Floats x, Floats y) {
        const Floats scale = splat(scale_), rounder = splat(0x1.8p23f);  // the integers are in the low bits then
        vertices_.set(group, pair_of(multiply_add(x, scale, rounder), multiply_add(y, scale, rounder)));
    }
    [[gnu::always_inline]] unsigned allow(const CornerNumbers& corners) const {
        const Ints a = vertices_.look_up(corners.a), b = vertices_.look_up(corners.b), c = vertices_.look_up(corners.c);
        const SignedInts u = cross_pairs(b, c), v = cross_pairs(c, a), w = negate(cross_pairs(b, a));
        const SignedInts least = smaller(u, smaller(v, w)), most = larger(u, larger(v, w));
        if constexpr (lanes == 1) {  // nearly always clear without looking at the triangle's own size
            const SignedInts largest = splat_integer((0xFFFF * weight_ >> 5) + always_allowed_);
            if ((at_most(negate(largest), least) | at_most(most, largest)) == 0) return 0;
        }
        const SignedInts above =
            add(shift_right<5>(weigh_magnitudes(a, b, c, weight_)), splat_integer(always_allowed_));
        return at_most(negate(above), least) | at_most(most, above);
    }

private:
    PairTable<groups> vertices_;
    float scale_;
    std::int32_t weight_;  ///< 32 times the error of each coordinate
    std::int32_t always_allowed_;
};

/// Floats for few vertices.
template <unsigned groups>
using SeenVertices = std::conditional_t<(groups * lanes < 32), FloatVertices<groups>, PairVertices<groups>>;
