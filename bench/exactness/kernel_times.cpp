#include "kernels.hpp"

namespace espalier::bench {
namespace {

/// Triangles of the tree that a ray is tested against, without a walk: all of the leaves on its way, or its hit alone.
struct Tests {
    std::vector<std::uint32_t> triangles;
    std::vector<std::size_t> ends;  ///< of each ray
};

Tests tests_in_leaves(const AabbTree& tree, const Blob& blob, const std::vector<Ray>& rays) {
    const Watertight kernel(tree, blob);
    RayWalk walk(tree);
    RayWork work;
    Tests tests;
    for (const Ray& ray : rays) {
        Watertight::Prepared prepared;
        Watertight::prepare(ray, prepared);
        const auto test_leaf = [&](const AabbNode& leaf, double& nearest) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                tests.triangles.push_back(i);
                nearest = std::min(nearest, static_cast<double>(kernel.test(prepared, i)));
            }
        };
        walk.walk(ray, work, test_leaf, [](std::uint32_t) {});
        tests.ends.push_back(tests.triangles.size());
    }
    return tests;
}

/// Returns the tests that are hits.
Tests hits_among(const Tests& tests, const AabbTree& tree, const Blob& blob, const std::vector<Ray>& rays) {
    const Integers kernel(tree, blob);
    Tests hits;
    std::size_t next = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Integers::Prepared prepared;
        if (!kernel.prepare(rays[i], prepared)) throw std::runtime_error("a ray is refused");
        for (; next < tests.ends[i]; ++next)
            if (kernel.test(prepared, tests.triangles[next]) < std::numeric_limits<float>::infinity())
                hits.triangles.push_back(tests.triangles[next]);
        hits.ends.push_back(hits.triangles.size());
    }
    return hits;
}

/// Each call returns nanoseconds: for a ray that is prepared, for a test, for a ray through the tree.
class KernelTimer {
public:
    KernelTimer() = default;
    KernelTimer(const KernelTimer&) = delete;
    KernelTimer& operator=(const KernelTimer&) = delete;
    virtual ~KernelTimer() = default;
    virtual double prepare() = 0;
    virtual double test(const Tests& tests) = 0;
    virtual double ray() = 0;
};

template <class Kernel>
class TimerOf final : public KernelTimer {
public:
    TimerOf(const AabbTree& tree, const Blob& blob, const std::vector<Ray>& rays)
        : walk_(tree), kernel_(tree, blob), rays_(rays), prepared_(rays.size()) {}

    double prepare() override {
        const Stopwatch watch;
        for (std::size_t i = 0; i < rays_.size(); ++i) kernel_.prepare(rays_[i], prepared_[i]);
        return nanoseconds(watch, rays_.size());
    }
    double test(const Tests& tests) override {
        const Stopwatch watch;
        std::size_t next = 0;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < tests.ends.size(); ++i)
            for (; next < tests.ends[i]; ++next)
                least = std::min(least, kernel_.test(prepared_[i], tests.triangles[next]));
        const double time = nanoseconds(watch, tests.triangles.size());
        kept_ = least;
        return time;
    }
    double ray() override {
        const Stopwatch watch;
        float sum = 0.0f;
        for (const Ray& ray : rays_) {
            const float t = closest_hit(walk_, kernel_, ray);
            sum += t < std::numeric_limits<float>::infinity() ? t : 0.0f;
        }
        const double time = nanoseconds(watch, rays_.size());
        kept_ = sum;
        return time;
    }

private:
    static double nanoseconds(const Stopwatch& watch, std::size_t count) {
        return 1e9 * watch.seconds() / static_cast<double>(std::max<std::size_t>(count, 1));
    }

    RayWalk walk_;
    Kernel kernel_;
    const std::vector<Ray>& rays_;
    std::vector<typename Kernel::Prepared> prepared_;
    volatile float kept_ = 0.0f;  // so that no loop is left out
};

struct Measured {
    std::size_t number;
    std::string name;
    std::unique_ptr<KernelTimer> timer;
    std::vector<double> prepare, test, hit, ray;
};

/// Adds how many triangles a ray of the blob's own query tests in float, and how many of them in integers.
void add_filter_counts(JsonObject& row, const Blob& blob, const std::vector<Ray>& rays) {
    QueryCounters counters;
    for (const Ray& ray : rays) static_cast<void>(raycast(blob, ray, counters));
    const auto count = static_cast<double>(rays.size());
    row.add("filtered_per_ray", static_cast<double>(counters.triangles) / count, 3);
    row.add("decided_per_ray", static_cast<double>(counters.candidates) / count, 3);
}

}  // namespace

void print_kernel_times(const SnappedMesh& snapped, const ExactnessOptions& options) {
    const std::vector<Ray> rays = incoherent_rays(snapped.mesh, options.rays, seed);
    const TreeAndBlob built = build_tree_and_blob(snapped.mesh, options.leaf_triangles);
    const AabbTree& tree = built.tree;
    const Blob& blob = built.baked.blob;
    const Tests tests = tests_in_leaves(tree, blob, rays);
    const Tests hits = hits_among(tests, tree, blob, rays);
    std::vector<Measured> kernels;
    const auto add = [&]<class Kernel>(const char* name) {
        kernels.push_back({kernels.size(), name, std::make_unique<TimerOf<Kernel>>(tree, blob, rays), {}, {}, {}, {}});
    };
    add.operator()<MollerTrumbore<float>>("Möller–Trumbore in float");
    add.operator()<MollerTrumbore<double>>("Möller–Trumbore in double");
    add.operator()<Watertight>("watertight in float");
    add.operator()<Integers>("integers");
    for (std::size_t round = 0; round < options.rounds; ++round) {
        // Another one is first in each round.
        std::rotate(kernels.begin(), kernels.begin() + 1, kernels.end());
        for (Measured& kernel : kernels) kernel.prepare.push_back(kernel.timer->prepare());
        for (Measured& kernel : kernels) kernel.test.push_back(kernel.timer->test(tests));
        for (Measured& kernel : kernels) kernel.hit.push_back(kernel.timer->test(hits));
        for (Measured& kernel : kernels) kernel.ray.push_back(kernel.timer->ray());
    }
    std::ranges::sort(kernels, {}, &Measured::number);
    for (const Measured& kernel : kernels) {
        JsonObject row = guide_row("kernels", snapped.mesh.name, snapped.mesh.triangles.size());
        row.add("kernel", kernel.name);
        row.add("rays", rays.size());
        row.add("tests_per_ray", static_cast<double>(tests.triangles.size()) / static_cast<double>(rays.size()), 2);
        row.add("prepare_ns", median_of(kernel.prepare), 2);
        row.add("test_ns", median_of(kernel.test), 2);
        row.add("hit_ns", median_of(kernel.hit), 2);
        row.add("ray_ns", median_of(kernel.ray), 1);
        add_filter_counts(row, blob, rays);
        row.add("rounds", options.rounds);
        row.print();
    }
}

}  // namespace espalier::bench
