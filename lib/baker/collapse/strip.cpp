#include <baker/collapse/strip.hpp>

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include <baker/collapse/predicted_strip.hpp>

namespace espalier::baker {

namespace {

constexpr unsigned most = format::max_leaf_triangles;
using Set = std::uint64_t;
static_assert(most <= 64);

/// The triangles of a leaf by number, and who is whose neighbour.
struct Cluster {
    std::array<Set, most> neighbours{};
    std::array<std::uint32_t, most> of_mesh{};  ///< numbers in the mesh, which ascend with original ids
    unsigned count;

    Cluster(const Neighbours& all, const BinaryTree& tree, const BinaryNode& node) : count(node.count) {
        for (unsigned i = 0; i < count; ++i) {
            of_mesh[i] = tree.triangles[node.first + i];
            for (const std::uint32_t place : all.of(node.first + i)) {
                const std::uint32_t other = place - node.first;
                if (other < count && other != i) neighbours[i] |= Set{1} << other;
            }
        }
    }

    /// Bits of the step between their numbers in the mesh: what their original ids take, one after the other.
    [[nodiscard]] unsigned step_bits(unsigned a, unsigned b) const {
        return static_cast<unsigned>(
            std::bit_width(of_mesh[a] < of_mesh[b] ? of_mesh[b] - of_mesh[a] : of_mesh[a] - of_mesh[b]));
    }
};

/// Paths over neighbours that together hold every triangle of a cluster once.
struct Cover {
    std::array<std::uint8_t, most> triangles{};  ///< path after path
    Set starts = 0;                              ///< a bit for each place in `triangles` where a path begins
    unsigned paths = 0;
    unsigned step_bits = 0;  ///< of all steps from triangle to triangle
};

unsigned lowest(Set set) { return static_cast<unsigned>(std::countr_zero(set)); }

/// Of `from`, the one with the fewest neighbours that are still free; of equal ones the nearest to `last` in the
/// source; of equal ones the lowest. Warnsdorff's rule: what is hard to reach is taken first.
unsigned loneliest(const Cluster& cluster, Set from, Set free, unsigned last) {
    unsigned best = lowest(from);
    std::pair<int, unsigned> least = {most, 0};
    for (; from != 0; from &= from - 1) {
        const unsigned each = lowest(from);
        const std::pair rank = {std::popcount(cluster.neighbours[each] & free), cluster.step_bits(last, each)};
        if (rank < least) {
            least = rank;
            best = each;
        }
    }
    return best;
}

/// Takes free triangles from neighbour to neighbour as long as there are any; returns the end of what it wrote.
std::uint8_t* walk(const Cluster& cluster, unsigned from, Set& free, std::uint8_t* to) {
    for (Set next = cluster.neighbours[from] & free; next != 0; next = cluster.neighbours[from] & free) {
        from = loneliest(cluster, next, free, from);
        free &= ~(Set{1} << from);
        *to++ = static_cast<std::uint8_t>(from);
    }
    return to;
}

Cover cover_from(const Cluster& cluster, unsigned start) {
    Cover cover;
    std::uint8_t* end = cover.triangles.data();
    Set free = ~Set{0} >> (64 - cluster.count);
    for (unsigned first = start;; first = loneliest(cluster, free, free, end[-1])) {
        std::uint8_t* const path = end;
        cover.starts |= Set{1} << (path - cover.triangles.data());
        ++cover.paths;
        free &= ~(Set{1} << first);
        // From the first triangle one way, then, turned round, on from there the other way.
        end = walk(cluster, first, free, end);
        std::reverse(path, end);
        *end++ = static_cast<std::uint8_t>(first);
        end = walk(cluster, first, free, end);
        if (free == 0) break;
    }
    for (unsigned i = 1; i < cluster.count; ++i)
        cover.step_bits += cluster.step_bits(cover.triangles[i - 1], cover.triangles[i]);
    return cover;
}

/// How many covers of a cluster are compared.
constexpr unsigned attempts = 8;

/// The order within paths matters where a leaf is written; where it is planned, one path is as good as any other.
enum class Order : std::uint8_t { matters, does_not_matter };

unsigned first_start(const Cluster& cluster) {
    const Set all = ~Set{0} >> (64 - cluster.count);
    return loneliest(cluster, all, all, 0);
}

Cover best_cover(const Cluster& cluster, Order order) {
    Cover best = cover_from(cluster, first_start(cluster));
    for (unsigned start = 0; start < std::min(attempts - 1, cluster.count); ++start) {
        if (best.paths == 1 && order == Order::does_not_matter) break;
        const Cover other = cover_from(cluster, start);
        if (std::pair(other.paths, other.step_bits) < std::pair(best.paths, best.step_bits)) best = other;
    }
    return best;
}

unsigned entry_count(const Cluster& cluster, const Cover& cover) { return cluster.count + 2 * cover.paths; }

/// Which corner of the triangle an edge to `other` begins at.
unsigned edge_to(const Neighbours& neighbours, std::uint32_t place, std::uint32_t other) {
    const auto& across = neighbours.of(place);
    return across[0] == other ? 0 : across[1] == other ? 1 : 2;
}

/// Writes paths as entries and marks.
class StripWriter {
public:
    StripWriter(const LatticeMesh& mesh, const BinaryTree& tree, const Neighbours& neighbours, Strip& strip)
        : mesh_(mesh), tree_(tree), neighbours_(neighbours), strip_(strip) {}

    void add_path(std::span<const std::uint32_t> places) {
        // A triangle is first entered opposite the edge that leads on, so that the next one turns on its second entry.
        const unsigned pivot = places.size() == 1 ? 0 : (edge_to(neighbours_, places[0], places[1]) + 2) % 3;
        mark_pivot(strip_.entry_count);
        unsigned middle = (pivot + 1) % 3;
        unsigned newest = (pivot + 2) % 3;
        if (!keeps_order()) std::swap(middle, newest);
        for (const unsigned corner : {pivot, middle, newest}) add_entry(corners_of(places[0])[corner]);
        pivot_ = corners_of(places[0])[pivot];
        add_triangle(places[0]);
        for (std::size_t i = 1; i < places.size(); ++i) {
            // They may share more than one edge: it is the one that the previous triangle is left through.
            const unsigned left_through = edge_to(neighbours_, places[i - 1], places[i]);
            const std::uint32_t edge_end = corners_of(places[i - 1])[(left_through + 1) % 3];
            const auto& corners = corners_of(places[i]);
            const unsigned edge = number_of(corners, edge_end);
            const unsigned place_of_middle = strip_.entry_count - 2;
            // The edge has the newest entry and either the pivot or the entry between; the latter then is the pivot.
            if (corners[edge] != pivot_ && corners[(edge + 1) % 3] != pivot_) {
                mark_pivot(place_of_middle);
                pivot_ = strip_.entries[place_of_middle];
            }
            add_entry(corners[(edge + 2) % 3]);
            add_triangle(places[i]);
        }
    }

private:
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners_of(std::uint32_t place) const {
        return mesh_.triangles[tree_.triangles[place]].corners;
    }
    static unsigned number_of(const std::array<std::uint32_t, 3>& corners, std::uint32_t vertex) {
        return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    }
    [[nodiscard]] bool keeps_order() const { return std::popcount(strip_.pivots) % 2 != 0; }
    void mark_pivot(unsigned entry) { strip_.pivots |= std::uint64_t{1} << entry; }
    void add_entry(std::uint32_t vertex) { strip_.entries[strip_.entry_count++] = vertex; }
    void add_triangle(std::uint32_t place) {
        strip_.windows |= std::uint64_t{1} << (strip_.entry_count - 3);
        const auto& corners = corners_of(place);
        strip_.triangles[strip_.triangle_count++] = {place, static_cast<std::uint8_t>(number_of(corners, pivot_))};
    }

    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const Neighbours& neighbours_;
    Strip& strip_;
    std::uint32_t pivot_ = 0;
};

Strip write(const LatticeMesh& mesh, const BinaryTree& tree, const Neighbours& neighbours, const BinaryNode& node,
            const Cover& cover) {
    Strip strip;
    StripWriter writer(mesh, tree, neighbours, strip);
    std::array<std::uint32_t, most> places;
    for (unsigned i = 0; i < node.count; ++i) places[i] = node.first + cover.triangles[i];
    for (unsigned begin = 0; begin < node.count;) {
        const Set later = begin == 63 ? 0 : cover.starts >> (begin + 1);
        const unsigned end = later == 0 ? node.count : begin + 1 + lowest(later);
        writer.add_path(std::span(places).subspan(begin, end - begin));
        begin = end;
    }
    return strip;
}

}  // namespace

unsigned StripMaker::entries_of(const BinaryNode& node) const {
    const Cluster cluster(neighbours_, tree_, node);
    return entry_count(cluster, best_cover(cluster, Order::does_not_matter));
}

Strip StripMaker::make(const BinaryNode& node) const {
    const Cluster cluster(neighbours_, tree_, node);
    return write(mesh_, tree_, neighbours_, node, best_cover(cluster, Order::matters));
}

std::optional<Strip> StripMaker::make_predicted(const BinaryNode& node, unsigned most_attempts) const {
    namespace layout = format::predicted_strip;
    const Cluster cluster(neighbours_, tree_, node);
    std::optional<Strip> best;
    std::size_t fewest_bits = 0;
    const auto attempt = [&](unsigned start) {
        const Cover cover = cover_from(cluster, start);
        if (entry_count(cluster, cover) > layout::max_entries || cover.paths > layout::max_joints + 1) return;
        const Strip strip = write(mesh_, tree_, neighbours_, node, cover);
        const std::size_t bits = PredictedStrip(mesh_, strip).bits(offset_widths(node));
        if (best && bits >= fewest_bits) return;
        best = strip;
        fewest_bits = bits;
    };
    attempt(first_start(cluster));
    for (unsigned start = 0; start < std::min(most_attempts - 1, cluster.count); ++start) attempt(start);
    return best;
}

Strip StripMaker::make_leaf(const BinaryNode& node) const {
    if (!format::has_predicted_strips(profile_)) return make(node);
    return *make_predicted(node, predicted_writing_attempts);
}

}  // namespace espalier::baker
