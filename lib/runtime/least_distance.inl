// The pair of triangles that is least apart, as it is looked for: what is known of it so far. Included once per
// instruction set, inside its namespace, after pair_nodes.inl and pair_beam.inl.

/// The squared distance of two triangles' boxes.
inline float gap_between(const LatticeTriangle& a, const LatticeTriangle& b) {
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

/// The pair that is least apart; of equal ones the lowest, but the first that touches. Or any pair within the radius.
struct LeastDistance {
    const PairFrame& frame;
    FoundTriangles& best;
    float radius;  ///< steps of the grid
    bool any;      ///< whether any pair within the radius is as good
    /// While looking first where the meshes may be near each other: of two leaves only the most promising pair is
    /// visited, which need not be within the radius to tell the direction.
    bool surveys = true;
    bool found = false;
    float limit_ = radius * radius * distance_slack;
    float survey_limit_ = infinity;
    PairAxes axes_[2] = {};  ///< in either tree's frame

    [[nodiscard]] bool is_done() const { return found && (any || best.distance.squared == 0.0f); }
    /// For triangles.
    [[nodiscard]] float limit() const { return surveys ? survey_limit_ : limit_; }
    void lower_limit(float limit) {
        survey_limit_ = minimum(limit, survey_limit_);
        limit_ = minimum(limit, limit_);
    }
    [[nodiscard]] const PairAxes& axes(unsigned side) const { return axes_[side]; }
    template <class Pair>
    [[gnu::noinline]] Visit visit_pair(const LatticeTriangle& a, const LatticeTriangle& b, Pair pair) {
        if (gap_between(a, b) > limit()) return keep_going;
        TriangleDistance distance;
        find_distance_if_apart(a, b, distance);
        if (found && distance.squared > best.distance.squared) return keep_going;
        if (is_within_radius(a, b, distance, radius)) {
            const TrianglePair these = pair();
            if (found && distance.squared == best.distance.squared && best.pair < these) return keep_going;
            best.distance = distance;
            best.a = a;
            best.b = b;
            best.pair = these;
            found = true;
            lower_limit(distance.squared * distance_slack);
        } else {
            if (!surveys || distance.squared > survey_limit_) return keep_going;
            survey_limit_ = distance.squared * distance_slack;
        }
        set_axes(a, b, distance);
        return is_done() ? stop : keep_going;
    }

private:
    /// The first leads from one closest point to the other. Points that round to one place tell none, whatever pairs
    /// came before: which ones did depends on the number of lanes.
    ESPALIER_SHARED_CODE void set_axes(const LatticeTriangle& a, const LatticeTriangle& b,
                                       const TriangleDistance& distance) {
        float(&axes)[3][3] = axes_[0].at;
        float on_a[3], on_b[3];
        point_of(a, distance.on_a[0], distance.on_a[1], on_a);
        point_of(b, distance.on_b[0], distance.on_b[1], on_b);
        for (int k = 0; k < 3; ++k) axes[0][k] = on_b[k] - on_a[k];
        if (!shorten(axes[0])) {
            axes_[0] = axes_[1] = PairAxes{};
            return;
        }
        int least = 0;
        for (int k = 1; k < 3; ++k) least = absolute(axes[0][k]) < absolute(axes[0][least]) ? k : least;
        const int next = least == 2 ? 0 : least + 1, last = least == 0 ? 2 : least - 1;
        axes[1][least] = 0.0f;
        axes[1][next] = axes[0][last];
        axes[1][last] = -axes[0][next];
        shorten(axes[1]);
        for (int k = 0; k < 3; ++k) {
            const int k1 = k == 2 ? 0 : k + 1, k2 = k == 0 ? 2 : k - 1;
            axes[2][k] = axes[0][k1] * axes[1][k2] - axes[0][k2] * axes[1][k1];
        }
        shorten(axes[2]);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                const auto& turned = frame.sides[1].axis[k];
                axes_[1].at[i][k] = turned[0] * axes[i][0] + turned[1] * axes[i][1] + turned[2] * axes[i][2];
            }
    }
    /// To a length of a hair less than 1, so that rounding never makes anything seem farther apart. False for length 0.
    ESPALIER_SHARED_CODE static bool shorten(float* axis) {
        const float longest = maximum(absolute(axis[0]), maximum(absolute(axis[1]), absolute(axis[2])));
        if (!(longest > 0.0f)) return false;
        for (int k = 0; k < 3; ++k) axis[k] = axis[k] / longest;
        const float length = square_root(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        for (int k = 0; k < 3; ++k) axis[k] = axis[k] / length * (1.0f - 0x1p-18f);
        return true;
    }
};

/// The search of a visitor that is a LeastDistance too: a first look, then the walk.
template <class Visitor>
inline QueryStatus search_nearest(const PairFrame& frame, Visitor& visitor, LeastDistance& least, std::uint64_t& work) {
    QueryStatus status = QueryStatus::ok;
    const auto goes_on = [&] { return status == QueryStatus::ok && !least.is_done(); };
    // The narrow one is for those whom nearly any pair satisfies.
    for (const unsigned width : {1u, Beam::most_width})
        if (goes_on()) status = visit_promising(frame, visitor, width, work);
    least.surveys = false;
    if (goes_on()) status = traverse_pair(frame, visitor, work);
    if (least.found && least.best.distance.squared == 0.0f)
        least.best.distance = distance_between(least.best.a, least.best.b);  // and where
    return status;
}
