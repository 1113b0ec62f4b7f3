#include "hausdorff.hpp"

#include <queue>

namespace espalier::reference {

namespace {

constexpr double close_enough = 1.001;

struct Piece {
    PointTriangle corners;
    std::uint32_t nearest;  ///< a triangle near it
    double upper;
    friend bool operator<(const Piece& a, const Piece& b) { return a.upper < b.upper; }
};

class Search {
public:
    Search(const DoubleTree& to) : to_(to) {}

    [[nodiscard]] OneWayDistance result() const { return result_; }
    [[nodiscard]] bool is_settled(double upper) const { return upper <= result_.lower * close_enough; }

    /// Looks at the middle, and at the corners only as long as the piece may still hold the farthest point: most
    /// triangles of a mesh are settled by the one triangle that is nearest to their middle.
    Piece look_at(const PointTriangle& corners, std::uint32_t guess) {
        ++result_.pieces;
        const std::uint32_t of_middle = look_at((1.0 / 3.0) * (corners[0] + corners[1] + corners[2]), guess);
        Piece piece{corners, of_middle, farthest_corner(corners, of_middle)};
        for (const Point& corner : corners) {
            if (is_settled(piece.upper)) break;
            piece.nearest = look_at(corner, piece.nearest);
            piece.upper = std::min(piece.upper, farthest_corner(corners, piece.nearest));
        }
        return piece;
    }

private:
    std::uint32_t look_at(Point point, std::uint32_t guess) {
        const ReferenceNearest nearest = to_.nearest(point, guess);
        result_.lower = std::max(result_.lower, std::sqrt(nearest.squared_distance));
        return nearest.triangle;
    }

    [[nodiscard]] double farthest_corner(const PointTriangle& corners, std::uint32_t triangle) const {
        double squared = 0.0;
        for (const Point& corner : corners)
            squared = std::max(squared, squared_distance(corner, to_.triangles()[triangle]));
        return std::sqrt(squared);
    }

    const DoubleTree& to_;
    OneWayDistance result_;
};

/// In two, through the middle of the longest side: pieces stay as round as the triangle was.
std::array<PointTriangle, 2> halves(const PointTriangle& t) {
    unsigned longest = 0;
    double most = -1.0;
    for (unsigned k = 0; k < 3; ++k) {
        const Point side = t[(k + 1) % 3] - t[k];
        if (dot(side, side) > most) {
            most = dot(side, side);
            longest = k;
        }
    }
    const Point a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
    const Point middle = 0.5 * (a + b);
    return {{{a, middle, c}, {middle, b, c}}};
}

}  // namespace

OneWayDistance one_way_distance(const DoubleTree& from, const DoubleTree& to, std::size_t most_pieces) {
    Search search(to);
    std::priority_queue<Piece> open;
    std::uint32_t guess = 0;
    for (const PointTriangle& triangle : from.triangles()) {
        Piece piece = search.look_at(triangle, guess);
        guess = piece.nearest;
        if (!search.is_settled(piece.upper)) open.push(piece);
    }
    const std::size_t end = search.result().pieces + most_pieces;
    while (!open.empty() && !search.is_settled(open.top().upper) && search.result().pieces < end) {
        const Piece piece = open.top();
        open.pop();
        for (const PointTriangle& half : halves(piece.corners)) {
            Piece smaller = search.look_at(half, piece.nearest);
            smaller.upper = std::min(smaller.upper, piece.upper);
            if (!search.is_settled(smaller.upper)) open.push(smaller);
        }
    }
    OneWayDistance result = search.result();
    result.upper = result.lower * close_enough;
    if (!open.empty()) result.upper = std::max(result.upper, open.top().upper);
    return result;
}

}  // namespace espalier::reference
