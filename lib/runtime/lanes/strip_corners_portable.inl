// The windows of a strip one after the other, for instruction sets without a better way.

class StripCorners {
public:
    explicit StripCorners(const StripLeaf& leaf)
        : pivots_(leaf.pivots), first_uses_(leaf.first_uses), leaf_(leaf), bit_(leaf.references_at) {
        before_ = next_entry();
        middle_ = next_entry();
    }
    ESPALIER_ALWAYS_INLINE CornerNumbers next() {
        std::uint32_t a[lanes], b[lanes], c[lanes];
        for (unsigned lane = 0; lane < lanes; ++lane) {
            pivot_ = (pivots_ & 1) != 0 ? before_ : pivot_;
            pivots_ >>= 1;
            before_ = middle_;
            middle_ = next_entry();
            a[lane] = pivot_;
            b[lane] = before_;
            c[lane] = middle_;
        }
        return {load_numbers(a), load_numbers(b), load_numbers(c)};
    }

private:
    std::uint32_t next_entry() {
        const bool fresh = (first_uses_ & 1) != 0;
        first_uses_ >>= 1;
        if (fresh) return used_++;
        const std::uint32_t number = load_few_bits(leaf_.marks, bit_, leaf_.reference_width);
        bit_ += leaf_.reference_width;
        return number;
    }

    std::uint64_t pivots_;
    std::uint64_t first_uses_;
    const StripLeaf& leaf_;
    unsigned bit_;
    std::uint32_t used_ = 0;
    std::uint32_t before_ = 0, middle_ = 0, pivot_ = 0;
};

#if ESPALIER_PREDICTED_STRIPS
/// Stores the vertices of a leaf, of which `open` has proved the numbers, axis by axis.
inline void decode_points(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z) {
    store_predicted_vertices(leaf, x, y, z);
}
#endif
