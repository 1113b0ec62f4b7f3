// Values by vertex in registers, or with one lane in memory: the numbers of the vertices are in lanes, and the set's
// `look_up_in` finds the values.

/// A vertex for each lane, and the three vertices of a triangle in each.
using Numbers = Ints;
struct CornerNumbers {
    Numbers a, b, c;
};
inline Numbers load_numbers(const std::byte* bytes) { return load_bytes(bytes); }
inline Numbers load_numbers(const std::uint32_t* from) { return load_ints(from); }

template <unsigned groups>
struct Table {
    Floats group[groups];
    static unsigned groups_of(unsigned vertex_count) { return lanes > 1 ? groups : vertex_count; }
    void set(unsigned number, Floats a) { group[number] = a; }
    /// By the low bits of each index; bits above those that number the vertices are ignored.
    [[nodiscard]] Floats look_up(Ints index) const { return look_up_among<groups>(index); }
    /// Where only the first groups are set.
    template <unsigned used>
    [[nodiscard]] Floats look_up_among(Ints index) const {
        return look_up_in<used>(group, index);
    }
};
template <unsigned groups>
using PairTable = PairTableIn<Table<groups>>;
