// A ray of a batch: what it needs while others are on their way too. Included once per instruction set with lanes,
// inside its namespace, after ray_visitors.inl.

/// Where the answers go: closest hits, or whether there is any.
struct BatchAnswers {
    RayHit* hits;            ///< null when only asked whether there is any
    std::uint8_t* occluded;  ///< else null

    [[nodiscard]] bool any_will_do() const { return hits == nullptr; }
    [[nodiscard]] BatchAnswers from(std::size_t first) const {
        return any_will_do() ? BatchAnswers{nullptr, occluded + first} : BatchAnswers{hits + first, nullptr};
    }
    void miss(std::size_t number) const {
        if (any_will_do()) occluded[number] = 0;
        else hits[number] = no_hit;
    }
};

/// The closest hit, or the first that is found: one visitor for both, since twice as much code would be slower than a
/// branch that is always the same.
template <class Leaf>
struct BatchHit : ClosestHit<Leaf, Ray, const NoCounters> {
    bool any_will_do = false;

    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        for (auto candidates = ray_candidates(place, this->ray, leaf); candidates != 0; candidates &= candidates - 1) {
            decide(leaf, static_cast<unsigned>(std::countr_zero(candidates)));
            if (is_over()) return stop;
        }
        return keep_going;
    }
    template <class SomeLeaf>
    void decide(const SomeLeaf& leaf, unsigned slot) {
        if (!any_will_do) return ClosestHit<Leaf, Ray, const NoCounters>::decide(leaf, slot);
        if (!is_hit(leaf, slot, this->ray)) return;
        this->volume_bits = 1;  // of no meaning but that there is one
        this->limit_ = -1.0f;   // no key is as small
    }
    [[nodiscard]] bool is_over() const { return any_will_do && this->found(); }
};

template <class Leaf>
struct RayInBatch {
    PreparedRayIn<RayLanesOf<typename Leaf::Node>> prepared = {};
    RayHit best;
    BatchHit<Leaf> visitor = {{prepared.ray, prepared.lanes(), nullptr, no_counters, best}};

    /// Readies the ray for its walk. False when it can hit nothing.
    bool begin(const BlobData& blob, const Ray& world, bool any_will_do) {
        if (!prepare(blob, world, prepared)) return false;
        visitor.limit_ = window_limit(prepared.ray);
        visitor.volume_bits = 0;
        visitor.any_will_do = any_will_do;
        return true;
    }
    /// 1 for a hit, else 0.
    unsigned answer(const Ray& world, const BatchAnswers& answers, std::size_t number) const {
        if (!visitor.found()) {
            answers.miss(number);
            return 0;
        }
        if (answers.any_will_do()) {
            answers.occluded[number] = 1;
        } else {
            visitor.finish(world);
            answers.hits[number] = best;
        }
        return 1;
    }
};

/// A ray that takes turns with others: the closest hit.
template <class Leaf>
struct ClosestInTurns : RayInBatch<Leaf> {
    using Node = typename Leaf::Node;

    NearestFirst<PlaceOf<Leaf>, BatchHit<Leaf>> walk;

    bool begin(const BlobData& blob, const Ray& world) {
        walk.begin(0);
        return RayInBatch<Leaf>::begin(blob, world, false);
    }
    [[gnu::always_inline]] bool advance(const BlobData& blob, unsigned mask) {
        return walk.advance(blob, this->visitor, mask);
    }
};

/// The same: whether there is any hit.
template <class Leaf>
struct AnyInTurns {
    using Node = typename Leaf::Node;

    PreparedRayIn<RayLanesOf<Node>> prepared = {};
    AnyHit<Leaf> visitor = {prepared.ray, prepared.lanes()};
    StorageOrder<PlaceOf<Leaf>, AnyHit<Leaf>> walk;
    bool found;

    bool begin(const BlobData& blob, const Ray& world) {
        walk.begin();
        if (!prepare(blob, world, prepared)) return false;
        visitor.limit_ = window_limit(prepared.ray);
        return true;
    }
    [[gnu::always_inline]] bool advance(const BlobData& blob, unsigned mask) {
        const Step step = walk.advance(blob, visitor, mask);
        found = step == Step::was_stopped;
        return step == Step::goes_on;
    }
    unsigned answer(const Ray&, const BatchAnswers& answers, std::size_t number) const {
        answers.occluded[number] = found ? 1 : 0;
        return found ? 1 : 0;
    }
};
