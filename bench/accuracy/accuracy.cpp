#include "accuracy.hpp"

#include "../../tests/oracle/surfaces.hpp"

namespace espalier::bench {

using namespace reference;

namespace {

/// A ray whose t is off by more has met another part of the surface, or grazes it. In steps.
constexpr double another_place = 8.0;

PointRay to_point_ray(const Ray& ray) { return {to_point(ray.origin), to_point(ray.direction)}; }

}  // namespace

std::vector<ReferenceHit> reference_hits(const DoubleTree& source, const std::vector<Ray>& rays) {
    std::vector<ReferenceHit> hits;
    hits.reserve(rays.size());
    for (const Ray& ray : rays) hits.push_back(source.closest_hit(to_point_ray(ray)));
    return hits;
}

void add_ray_accuracy(JsonObject& row, const Blob& blob, const DoubleTree& source, const std::vector<Ray>& rays,
                      const std::vector<ReferenceHit>& references, std::size_t points) {
    const double step = std::ldexp(1.0, blob.lattice().step_exponent);
    std::size_t hits = 0, missed = 0, extra = 0, elsewhere = 0, doubtful = 0;
    Distribution t_errors, normal_errors, point_errors;
    std::size_t point_count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ReferenceHit& reference = references[i];
        const RayHit hit = raycast(blob, rays[i]);
        const bool is_hit = bool(hit);
        doubtful += reference.is_doubtful;
        hits += reference.is_hit;
        missed += reference.is_hit && !is_hit;
        extra += !reference.is_hit && is_hit;
        if (!is_hit) continue;
        const PointRay ray = to_point_ray(rays[i]);
        const double t = static_cast<double>(hit.t);
        if (point_count < points) {
            ++point_count;
            const ReferenceNearest nearest =
                source.nearest(ray.origin + t * ray.direction, reference.is_hit ? reference.triangle : 0);
            point_errors.add(std::sqrt(nearest.squared_distance) / step);
        }
        if (!reference.is_hit) continue;
        const double t_error = std::abs(t - reference.t) * length(ray.direction) / step;
        elsewhere += t_error > another_place;
        t_errors.add(t_error);
        normal_errors.add(angle_between(to_point(hit.normal), normal_of(source.triangles()[reference.triangle])));
    }
    row.add("rays", rays.size());
    row.add("hits", hits);
    row.add("missed", missed);
    row.add("extra", extra);
    row.add("elsewhere", elsewhere);
    row.add("doubtful", doubtful);
    t_errors.add_to(row, "t_steps");
    normal_errors.add_to(row, "normal_degrees");
    row.add("points", point_count);
    point_errors.add_to(row, "point_steps");
}

namespace {

constexpr int finest = 12;   ///< accuracies go from 2^-finest of the largest side ...
constexpr int coarsest = 3;  ///< ... to 2^-coarsest

/// What the answers of one query at one accuracy are, beside those of the exact query.
struct Outcome {
    std::size_t exact_yes = 0;
    std::size_t false_yes = 0;
    std::size_t missed = 0;  ///< exact yes, approximate no: never
    QueryCounters counters;

    void add(bool exact, bool approximate) {
        exact_yes += exact;
        false_yes += approximate && !exact;
        missed += exact && !approximate;
    }
};

class Measurement {
public:
    Measurement(const JsonObject& head, const Blob& blob, const tests::Mesh& mesh, const DoubleTree& source,
                std::size_t questions)
        : head_(head), blob_(blob), questions_(questions) {
        const Vec3 low = blob.bounds().min, high = blob.bounds().max;
        const Vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
        extent_ = std::max({size.x, size.y, size.z});
        radius_ = 0.02f * std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
        tests::Random random(2026);
        // half as large again as the box: near the surface, inside and some way off
        const auto within = [&random](float from, float length) {
            return from + length * (1.5f * random.unit() - 0.25f);
        };
        for (std::size_t i = 0; i < questions; ++i) {
            const float x = within(low.x, size.x), y = within(low.y, size.y), z = within(low.z, size.z);
            points_.push_back({x, y, z});
        }
        rays_ = incoherent_rays(mesh, questions, 4711);
        for (const Vec3& point : points_)
            distances_.push_back(std::sqrt(source.nearest(to_point(point)).squared_distance));
    }

    void print_all() {
        for (int k = finest; k >= coarsest; --k) {
            const float accuracy = std::ldexp(extent_, -k);
            spheres(k, accuracy);
            boxes(k, accuracy);
            rays(k, accuracy);
            distances(k, accuracy);
            std::fflush(stdout);
        }
    }

private:
    void spheres(int k, float accuracy) {
        Outcome outcome;
        QueryCounters exact_work;
        Distribution gaps;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Sphere sphere = {points_[i], radius_};
            const bool exact = overlaps(blob_, sphere, Accuracy{0.0f}, &exact_work).yes();
            const bool approximate = overlaps(blob_, sphere, Accuracy{accuracy}, &outcome.counters).yes();
            outcome.add(exact, approximate);
            if (approximate && !exact)
                gaps.add((distances_[i] - static_cast<double>(radius_)) / static_cast<double>(accuracy));
        }
        JsonObject row = row_of("sphere", k, outcome, exact_work);
        gaps.add_to(row, "error_accuracies");
        row.print();
    }

    void boxes(int k, float accuracy) {
        std::vector<Box> boxes;
        for (const Vec3& p : points_)
            boxes.push_back(
                {{p.x - radius_, p.y - radius_, p.z - radius_}, {p.x + radius_, p.y + radius_, p.z + radius_}});
        yes_or_no("box", k, accuracy, boxes, [this](const Box& box, float within, QueryCounters& counters) {
            return overlaps(blob_, box, Accuracy{within}, &counters).yes();
        });
    }

    void rays(int k, float accuracy) {
        yes_or_no("ray", k, accuracy, rays_, [this](const Ray& ray, float within, QueryCounters& counters) {
            return occluded(blob_, ray, Accuracy{within}, &counters).yes();
        });
    }

    template <class Shape, class Ask>
    void yes_or_no(const char* query, int k, float accuracy, const std::vector<Shape>& shapes, Ask ask) {
        Outcome outcome;
        QueryCounters exact_work;
        for (const Shape& shape : shapes) {
            const bool exact = ask(shape, 0.0f, exact_work);
            outcome.add(exact, ask(shape, accuracy, outcome.counters));
        }
        row_of(query, k, outcome, exact_work).print();
    }

    /// The error is that of the middle of the bounds against the source.
    void distances(int k, float accuracy) {
        Outcome outcome;
        QueryCounters exact_work;
        Distribution errors, widths;
        constexpr float anywhere = std::numeric_limits<float>::infinity();
        const double allowed = static_cast<double>(blob_.max_error());
        for (std::size_t i = 0; i < points_.size(); ++i) {
            outcome.exact_yes += bool(distance_bounds(blob_, points_[i], anywhere, Accuracy{}, &exact_work));
            const Result<DistanceBounds> bounds =
                distance_bounds(blob_, points_[i], anywhere, Accuracy{accuracy}, &outcome.counters);
            const double lower = static_cast<double>(bounds->lower), upper = static_cast<double>(bounds->upper);
            outcome.missed += distances_[i] < lower - allowed || distances_[i] > upper + allowed;
            errors.add(std::abs(0.5 * (lower + upper) - distances_[i]) / static_cast<double>(accuracy));
            widths.add((upper - lower) / static_cast<double>(accuracy));
        }
        JsonObject row = row_of("distance", k, outcome, exact_work);
        errors.add_to(row, "error_accuracies");
        widths.add_to(row, "width_accuracies");
        row.print();
    }

    [[nodiscard]] JsonObject row_of(const char* query, int k, const Outcome& outcome,
                                    const QueryCounters& exact_work) const {
        const auto each = [this](std::uint64_t count) { return digits_of(per(count, questions_), 4); };
        JsonObject row = head_;
        row.add("query", query);
        row.add_raw("accuracy_exponent", std::to_string(-k));
        row.add("questions", questions_);
        row.add("exact_yes", outcome.exact_yes);
        row.add("false_yes", outcome.false_yes);
        row.add("missed", outcome.missed);
        row.add_raw("nodes", each(outcome.counters.nodes));
        row.add_raw("triangles", each(outcome.counters.triangles));
        row.add_raw("exact_nodes", each(exact_work.nodes));
        row.add_raw("exact_triangles", each(exact_work.triangles));
        return row;
    }

    const JsonObject& head_;
    const Blob& blob_;
    std::size_t questions_;
    float extent_ = 0.0f;
    float radius_ = 0.0f;
    std::vector<Vec3> points_;
    std::vector<Ray> rays_;
    std::vector<double> distances_;
};

}  // namespace

void print_approximate_accuracy(const JsonObject& head, const Blob& blob, const tests::Mesh& mesh,
                                const DoubleTree& source, std::size_t questions) {
    Measurement(head, blob, mesh, source, questions).print_all();
}

}  // namespace espalier::bench
