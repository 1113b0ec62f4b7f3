// A leaf's vertices as the filter of rays reads them: floats.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/rays/plain_slab_test.inl>
#endif

/// A leaf's vertices, seen along the ray, as floats; and the test of triangles, which is whether the ray passes all
/// their edges on the same side. A hit lies among the leaf's vertices, so the sheared coordinates of a triangle that is
/// hit are at most twice as large as the leaf; each is off by at most the shear error, and so each edge function by at
/// most this.
template <unsigned groups>
class FloatVertices {
public:
    template <class Leaf>
    [[gnu::always_inline]] FloatVertices(const Leaf& leaf, const LatticeRay& ray) {
        const float reach = 2.0f * static_cast<float>(1u << leaf.size_bits) + ray.shear_error;
        error_ = reach * (4.125f * ray.shear_error + reach * 0x1.2p-21f);
    }
    static unsigned groups_of(unsigned vertex_count) { return Table<groups>::groups_of(vertex_count); }
    [[gnu::always_inline]] void set(unsigned group, Floats x, Floats y) {
        xs_.set(group, x);
        ys_.set(group, y);
    }
    /// The triangles, a lane each, that are not clearly excluded.
    [[gnu::always_inline]] unsigned allow(const CornerNumbers& corners) const {
        const Floats ax = xs_.look_up(corners.a), ay = ys_.look_up(corners.a);
        const Floats bx = xs_.look_up(corners.b), by = ys_.look_up(corners.b);
        const Floats cx = xs_.look_up(corners.c), cy = ys_.look_up(corners.c);
        const Floats u = multiply_subtract(bx, cy, multiply(by, cx));
        const Floats v = multiply_subtract(cx, ay, multiply(cy, ax));
        const Floats w = multiply_subtract(ax, by, multiply(ay, bx));
        return at_most(splat(-error_), smaller(u, smaller(v, w))) | at_most(larger(u, larger(v, w)), splat(error_));
    }

private:
    Table<groups> xs_, ys_;
    float error_;
};
