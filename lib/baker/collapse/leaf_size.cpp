#include <baker/collapse/leaf_size.hpp>

#include <algorithm>
#include <bit>
#include <optional>

#include <baker/collapse/predicted_strip.hpp>

namespace espalier::baker {

namespace {

unsigned bits_of_side(const BinaryNode& node, std::size_t axis) {
    return static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(node.hi[axis] - node.lo[axis])));
}

class PlainLeafSizes final : public LeafSizes {
public:
    PlainLeafSizes(unsigned bits, bool has_corners) : bits_(bits), has_corners_(has_corners) {}

    [[nodiscard]] LeafSize of(const BinaryNode& node, unsigned vertices) const override {
        using namespace format::plain_leaf;
        if (vertices > max_vertices) return {};
        return {true, node.count, padded_bytes(vertices, has_corners_ ? node.count : 0, bits_)};
    }
    [[nodiscard]] unsigned most_triangles() const override { return format::plain_leaf::max_triangles; }
    [[nodiscard]] float byte_weight() const override { return 1.0f; }

private:
    unsigned bits_;
    bool has_corners_;
};

class StripLeafSizes final : public LeafSizes {
public:
    StripLeafSizes(const StripMaker& strips, unsigned most_entries, unsigned most_vertices, float byte_weight)
        : strips_(strips), most_entries_(most_entries), most_vertices_(most_vertices), byte_weight_(byte_weight) {}

    [[nodiscard]] LeafSize of(const BinaryNode& node, unsigned vertices) const override {
        using namespace format::strip_leaf;
        if (vertices > most_vertices_) return {};
        const unsigned entries = strips_.entries_of(node);
        if (entries > most_entries_) return {};
        std::size_t bytes = (mark_bits(entries, vertices) + 7) / 8;
        for (std::size_t axis = 0; axis < 3; ++axis) bytes += (vertices * bits_of_side(node, axis) + 7) / 8;
        return {true, entries - 2, descriptor_bytes + bytes};
    }
    [[nodiscard]] unsigned most_triangles() const override { return most_entries_ - 2; }
    [[nodiscard]] float byte_weight() const override { return byte_weight_; }

private:
    const StripMaker& strips_;
    unsigned most_entries_;
    unsigned most_vertices_;
    float byte_weight_;
};

class PredictedStripSizes final : public LeafSizes {
public:
    explicit PredictedStripSizes(const StripMaker& strips) : strips_(strips) {}

    [[nodiscard]] LeafSize of(const BinaryNode& node, unsigned vertices) const override {
        using namespace format::predicted_strip;
        if (vertices > max_vertices) return {};
        const std::optional<Strip> strip = strips_.make_predicted(node, predicted_planning_attempts);
        if (!strip) return {};
        const std::size_t bits = PredictedStrip(strips_.mesh(), *strip).bits(offset_widths(node));
        return {true, strip->entry_count - 2, descriptor_bytes + (bits + 7) / 8};
    }
    [[nodiscard]] unsigned most_triangles() const override { return format::predicted_strip::max_entries - 2; }
    [[nodiscard]] float byte_weight() const override { return 6.0f; }

private:
    const StripMaker& strips_;
};

}  // namespace

unsigned full_leaf(Profile profile, unsigned max_leaf_triangles) {
    switch (profile) {
        case Profile::fast:
            return std::min(format::plain_leaf::max_triangles, max_leaf_triangles);
        case Profile::tiny:
            return std::min((format::predicted_strip::max_entries - 2) * 7 / 8, max_leaf_triangles);
        case Profile::balanced:
        case Profile::small:
            break;
    }
    return 0;
}

std::unique_ptr<LeafSizes> leaf_sizes(Profile profile, unsigned bits, const StripMaker* strips, bool has_corners) {
    using namespace format::strip_leaf;
    switch (profile) {
        case Profile::balanced:
            return std::make_unique<StripLeafSizes>(*strips, max_balanced_entries, max_balanced_vertices, 1.0f);
        case Profile::small:
            return std::make_unique<StripLeafSizes>(*strips, max_small_entries, max_small_entries, 4.0f);
        case Profile::tiny:
            return std::make_unique<PredictedStripSizes>(*strips);
        case Profile::fast:
            break;
    }
    return std::make_unique<PlainLeafSizes>(bits, has_corners);
}

}  // namespace espalier::baker
