// The time of a refit. Systems take turns within each pose. A turn begins with a refit to the pose before, which is not
// measured: it brings the tree back into the cache, where those of the other systems were.

#include "../selected.hpp"
#include "box_tree.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

RefitMakers all_makers(unsigned bits) {
    RefitMakers makers = espalier_refit_makers(bits);
    const auto append = [&](RefitMakers more) {
        for (RefitMaker& maker : more) makers.push_back(std::move(maker));
    };
#ifdef ESPALIER_BENCH_EMBREE
    append(embree_refit_makers());
#endif
#ifdef ESPALIER_BENCH_BULLET
    append(bullet_refit_makers());
#endif
#ifdef ESPALIER_BENCH_FCL
    append(fcl_refit_makers());
#endif
    append(textbook_refit_makers());
    return makers;
}

/// A system and the seconds of its refits, a number for each round.
struct Run {
    const RefitMaker* maker;
    std::unique_ptr<RefitSystem> system;
    std::vector<double> seconds;
    std::size_t lost_poses = 0;
};

void check(Run& run, const TimedPose& pose, const MotionSubject& subject) {
    const Box& range = subject.range();
    const float rounding =
        0.001f * std::max({range.max.x - range.min.x, range.max.y - range.min.y, range.max.z - range.min.z});
    const auto is_inside = [&](const TriangleVertices& triangle) {
        return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
            return run.system->contains(pose.positions[vertex], rounding);
        });
    };
    const std::vector<TriangleVertices>& triangles = subject.rest().triangles;
    if (std::all_of(triangles.begin(), triangles.end(), is_inside)) return;
    const bool is_flat = pose.motion == Motion::collapse && pose.time == 1.0;
    if (!is_flat || !run.maker->may_lose_flat_poses)
        throw std::runtime_error(subject.rest().name + ": " + run.maker->name() + " lost a position of " +
                                 name_of(pose.motion));
    ++run.lost_poses;
}

void take_turn(Run& run, const std::vector<Vec3>& before, const TimedPose& pose) {
    run.system->set_positions(before);
    run.system->refit();
    run.system->set_positions(pose.positions);
    const ProcessorTime time;
    run.system->refit();
    run.seconds.back() += time.seconds();
}

void print(const MotionSubject& subject, const Run& run, const Run& reference) {
    std::vector<double> nanoseconds, ratios;
    const double refits = static_cast<double>(subject.poses().size()) * subject.triangles();
    for (std::size_t round = 0; round < run.seconds.size(); ++round) {
        nanoseconds.push_back(1e9 * run.seconds[round] / refits);
        ratios.push_back(run.seconds[round] / reference.seconds[round]);
    }
    JsonObject row = subject.row("refit");
    row.add("system", run.maker->system);
    row.add("profile", run.maker->profile);
    row.add("version", run.maker->version);
    row.add("poses", subject.poses().size());
    add_spread(row, "ns_per_triangle", nanoseconds, 3);
    add_spread(row, "times_espalier", ratios, 3);
    row.add("lost_poses", run.lost_poses);
    row.add("bytes", run.system->bytes());
    if (const auto work = run.system->work()) {
        row.add("moving_bytes", work->moving_bytes);
        row.add("source_bytes", work->source_bytes);
        row.add("still_bytes", work->still_bytes);
        row.add("step", work->step, 9);
    }
    row.print();
}

}  // namespace

void measure_refits(const MotionSubject& subject) {
    RefitMakers makers = all_makers(subject.options().bits);
    select(
        makers, subject.options().only,
        [](const RefitMaker& maker, const std::string& word) { return maker.name().starts_with(word); },
        [](const RefitMaker& maker) { return maker.system == "espalier"; },
        [](const RefitMaker& maker) { return maker.name(); });
    std::vector<Run> runs;
    for (const RefitMaker& maker : makers) runs.push_back({&maker, maker.make(subject.rest(), subject.range()), {}});
    for (std::size_t round = 0; round < subject.options().rounds; ++round) {
        for (Run& run : runs) run.seconds.push_back(0.0);
        for (std::size_t i = 0; i < subject.poses().size(); ++i) {
            const TimedPose& pose = subject.poses()[i];
            const std::vector<Vec3>& before = i == 0 ? subject.rest().positions : subject.poses()[i - 1].positions;
            for (std::size_t turn = 0; turn < runs.size(); ++turn) {
                Run& run = runs[(turn + i + round) % runs.size()];
                take_turn(run, before, pose);
                if (round == 0) check(run, pose, subject);
            }
        }
    }
    for (const Run& run : runs) print(subject, run, runs.front());
    std::fflush(stdout);
}

namespace {

class EspalierRefit final : public RefitSystem {
public:
    EspalierRefit(const Mesh& mesh, const Box& range, unsigned bits)
        : RefitSystem(mesh), deformable_(mesh, {.range = range, .bits = bits}) {}
    void refit() override { deformable_.move(mesh_.positions); }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        return is_within(point, deformable_.blob().bounds(), rounding);
    }
    /// The positions are the caller's: queries read the blob alone.
    [[nodiscard]] std::size_t bytes() const override {
        return deformable_.work().moving_bytes + deformable_.work().source_bytes + deformable_.work().still_bytes;
    }
    [[nodiscard]] std::optional<RefitWork> work() const override { return deformable_.work(); }

private:
    DeformableMesh deformable_;
};

}  // namespace

RefitMakers espalier_refit_makers(unsigned bits) {
    return {
        {"espalier", std::to_string(bits) + " bits", ESPALIER_BENCH_VERSION,
         [bits](const Mesh& mesh, const Box& range) { return std::make_unique<EspalierRefit>(mesh, range, bits); }}};
}

namespace {

template <class BoxKind>
class TextbookRefit final : public RefitSystem {
public:
    using Renew = void (*)(const BoxTreeShape&, std::span<const Vec3>, std::span<BoxKind>);
    TextbookRefit(const Mesh& mesh, Renew renew)
        : RefitSystem(mesh),
          shape_(build_box_tree(mesh.triangles, mesh.positions)),
          boxes_(shape_.nodes.size()),
          renew_(renew) {}
    void refit() override { renew_(shape_, mesh_.positions, boxes_); }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        return boxes_.front().contains(point, rounding);
    }
    [[nodiscard]] std::size_t bytes() const override {
        return boxes_.size() * (sizeof(BoxKind) + sizeof(BoxTreeShape::Node)) + mesh_.positions.size() * sizeof(Vec3) +
               shape_.triangles.size() * sizeof(TriangleVertices);
    }

private:
    BoxTreeShape shape_;
    std::vector<BoxKind> boxes_;
    Renew renew_;
};

template <class BoxKind>
RefitMaker maker(const char* profile, typename TextbookRefit<BoxKind>::Renew renew) {
    return {"textbook", profile, ESPALIER_BENCH_VERSION,
            [renew](const Mesh& mesh, const Box&) { return std::make_unique<TextbookRefit<BoxKind>>(mesh, renew); }};
}

}  // namespace

RefitMakers textbook_refit_makers() { return {maker<Aabb>("aabb", refit_aabbs), maker<Obb>("obb anew", fit_obbs)}; }

}  // namespace espalier::bench
