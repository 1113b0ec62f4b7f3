// The pair of triangles that is least apart, as a search keeps it: what is known of it so far.
#include <runtime/pairs/queries.hpp>

namespace espalier::detail {

namespace {

/// To a length of a hair less than 1, so that rounding never makes anything seem farther apart. False for length 0.
ESPALIER_SHARED_CODE bool shorten(float* axis) {
    const float longest = maximum(absolute(axis[0]), maximum(absolute(axis[1]), absolute(axis[2])));
    if (!(longest > 0.0f)) return false;
    for (int k = 0; k < 3; ++k) axis[k] = axis[k] / longest;
    const float length = square_root(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int k = 0; k < 3; ++k) axis[k] = axis[k] / length * (1.0f - 0x1p-18f);
    return true;
}

}  // namespace

float gap_between(const LatticeTriangle& a, const LatticeTriangle& b) {
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const Span ours = span_of(a, k), theirs = span_of(b, k);
        const std::int32_t above = theirs.low - ours.high, below = ours.low - theirs.high;
        const std::int32_t gap = above > below ? above : below;
        const float length = gap > 0 ? static_cast<float>(gap) : 0.0f;
        sum += length * length;
    }
    return sum;
}

Visit LeastDistance::take(const LatticeTriangle& a, const LatticeTriangle& b, const TrianglePair& references) {
    if (gap_between(a, b) > limit()) return Visit::next;
    TriangleDistance distance;
    find_distance_if_apart(a, b, distance);
    if (found && distance.squared > best.distance.squared) return Visit::next;
    if (is_within_radius(a, b, distance, radius)) {
        const TrianglePair pair = owners(frame, references);
        if (found && distance.squared == best.distance.squared && best.pair < pair) return Visit::next;
        best.distance = distance;
        best.a = a;
        best.b = b;
        best.pair = pair;
        found = true;
        lower_limit(distance.squared * distance_slack);
    } else {
        if (!surveys || distance.squared > limit_of_survey) return Visit::next;
        limit_of_survey = distance.squared * distance_slack;
    }
    set_axes(a, b, distance);
    return is_done() ? Visit::stop : Visit::next;
}

/// The first leads from one closest point to the other. Points that round to one place tell none, whatever pairs came
/// before: which ones did depends on the number of lanes.
ESPALIER_SHARED_CODE void LeastDistance::set_axes(const LatticeTriangle& a, const LatticeTriangle& b,
                                                  const TriangleDistance& distance) {
    float(&own)[3][3] = axes[0].at;
    const auto [x, y, z] =
        point_of(b, distance.on_b.u, distance.on_b.v) - point_of(a, distance.on_a.u, distance.on_a.v);
    own[0][0] = x;
    own[0][1] = y;
    own[0][2] = z;
    if (!shorten(own[0])) {
        axes[0] = axes[1] = PairAxes{};
        return;
    }
    int least = 0;
    for (int k = 1; k < 3; ++k) least = absolute(own[0][k]) < absolute(own[0][least]) ? k : least;
    const int next = least == 2 ? 0 : least + 1, last = least == 0 ? 2 : least - 1;
    own[1][least] = 0.0f;
    own[1][next] = own[0][last];
    own[1][last] = -own[0][next];
    shorten(own[1]);
    for (int k = 0; k < 3; ++k) {
        const int k1 = k == 2 ? 0 : k + 1, k2 = k == 0 ? 2 : k - 1;
        own[2][k] = own[0][k1] * own[1][k2] - own[0][k2] * own[1][k1];
    }
    shorten(own[2]);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const auto& turned = frame.sides[0].axis[k];
            axes[1].at[i][k] = turned[0] * own[i][0] + turned[1] * own[i][1] + turned[2] * own[i][2];
        }
}

}  // namespace espalier::detail
