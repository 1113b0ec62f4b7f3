#include "measure.hpp"

#include <cstdlib>

#include "system.hpp"

namespace espalier::bench {

namespace {

/// How far the answers of two systems are the same.
struct Agreement {
    std::size_t disagreeing = 0;    ///< one says hit, the other miss
    std::size_t t_disagreeing = 0;  ///< both hit, but further apart than rounding explains
};

/// `max_error` is how far the surface of `own` may be from that of `reference`. `size` is the largest coordinate that
/// took part in the computation, which sets the unit of its rounding.
Agreement compare(const std::vector<Ray>& rays, const std::vector<Hit>& reference, const std::vector<Hit>& own,
                  double max_error, double size) {
    // 32 half units in the last place of a coordinate: what a few float32 operations lose.
    const double rounding = 0x1p-19 * size;
    Agreement agreement;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (reference[i].found != own[i].found) ++agreement.disagreeing;
        if (!reference[i].found || !own[i].found) continue;
        // Measured across the surface: along a ray that grazes it, a small distance becomes a long one. Embree's
        // normals are not of length 1, ours and the ray's are.
        const Vec3 normal = reference[i].normal;
        const double length = std::sqrt(static_cast<double>(tests::dot(normal, normal)));
        const double slope =
            length > 0.0 ? std::abs(static_cast<double>(tests::dot(normal, rays[i].direction))) / length : 1.0;
        const double apart = std::abs(static_cast<double>(own[i].t) - static_cast<double>(reference[i].t));
        // Not "apart * slope > ...": a NaN disagrees.
        if (!(apart * slope <= max_error + rounding)) ++agreement.t_disagreeing;
    }
    return agreement;
}

/// Counts rays to which a system's any-hit query says something else than its closest-hit query.
std::size_t contradictions(const std::vector<Hit>& closest, const std::vector<std::uint8_t>& any) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < closest.size(); ++i) count += closest[i].found != (any[i] != 0);
    return count;
}

/// One system's seconds and answers.
struct Run {
    std::unique_ptr<System> system;
    std::vector<double> build, coherent, incoherent, any;
    std::vector<Hit> hits;
    std::vector<std::uint8_t> answers;
};

Speed speed(const std::vector<double>& own, const std::vector<double>* reference, std::size_t rays) {
    Speed result;
    if (own.empty()) return result;
    result.mrays = static_cast<double>(rays) / spread(own).median * 1e-6;
    if (reference != nullptr) result.ratio = ratio(*reference, own);
    return result;
}

void build_all(const Mesh& mesh, const std::vector<Maker>& makers, unsigned times, std::vector<Run>& runs) {
    makers.front().make(mesh);  // the process's first build pays for loading libraries and first touches of memory
    for (unsigned round = 0; round < times; ++round)
        for (std::size_t s = 0; s < makers.size(); ++s) {
            runs[s].system.reset();
            runs[s].system = makers[s].make(mesh);
            runs[s].build.push_back(runs[s].system->build_seconds());
        }
}

void ask_all(const std::vector<Ray>& coherent, const std::vector<Ray>& incoherent, unsigned repetitions,
             std::vector<Run>& runs) {
    std::vector<Hit> view(coherent.size());
    for (unsigned repetition = 0; repetition < repetitions; ++repetition) {
        for (Run& run : runs)
            if (run.system->has_closest()) {
                const Stopwatch watch;
                run.system->closest(coherent, true, view);
                run.coherent.push_back(watch.seconds());
            }
        for (Run& run : runs)
            if (run.system->has_closest()) {
                run.hits.resize(incoherent.size());
                const Stopwatch watch;
                run.system->closest(incoherent, false, run.hits);
                run.incoherent.push_back(watch.seconds());
            }
        for (Run& run : runs)
            if (run.system->has_any()) {
                run.answers.resize(incoherent.size());
                const Stopwatch watch;
                run.system->any(incoherent, run.answers);
                run.any.push_back(watch.seconds());
            }
    }
}

/// The largest coordinate of anything on the way from a ray's origin through the mesh.
double largest_coordinate(const Mesh& mesh) {
    const BoundingSphere sphere = bounding_sphere(mesh);
    const Vec3 c = sphere.center;
    return static_cast<double>(std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) + 2.4f * sphere.radius);
}

std::optional<double> load_average() {
    double load = 0.0;
    return getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

std::optional<Lattice> in_own_units(std::optional<Lattice> lattice, double scale) {
    if (lattice) lattice = {lattice->step / scale, lattice->extent / scale, lattice->max_error / scale};
    return lattice;
}

}  // namespace

MeshResult measure(const std::string& path, const std::vector<Maker>& makers, const Options& options) {
    Mesh mesh = tests::read_mesh(path);
    const double scale = bring_to_common_size(mesh);
    std::vector<Run> runs(makers.size());
    build_all(mesh, makers, options.builds, runs);
    const std::vector<Ray> coherent = coherent_rays(mesh);
    const std::vector<Ray> incoherent = incoherent_rays(mesh, options.incoherent, options.seed);
    ask_all(coherent, incoherent, options.repetitions, runs);

    const Run* reference = nullptr;
    for (std::size_t s = 0; s < makers.size(); ++s)
        if (is_reference(makers[s])) reference = &runs[s];
    const double size = largest_coordinate(mesh);
    const auto per_triangle = [&mesh](std::size_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(mesh.triangles.size());
    };
    MeshResult result{mesh.name, mesh.triangles.size(), load_average(), {}};
    for (std::size_t s = 0; s < makers.size(); ++s) {
        const Run& run = runs[s];
        const std::optional<Lattice> lattice = run.system->lattice();
        Row row;
        row.system = makers[s].name;
        row.profile = makers[s].profile;
        row.version = makers[s].version;
        row.bytes_per_triangle = per_triangle(run.system->bytes());
        row.bytes_per_triangle_with_ids = per_triangle(run.system->bytes_with_ids());
        if (const auto bytes = run.system->bytes_at_20_bits()) row.bytes_per_triangle_20_bits = per_triangle(*bytes);
        row.lattice = in_own_units(lattice, scale);
        row.incoherent =
            speed(run.incoherent, reference != nullptr ? &reference->incoherent : nullptr, incoherent.size());
        row.coherent = speed(run.coherent, reference != nullptr ? &reference->coherent : nullptr, coherent.size());
        row.any = speed(run.any, reference != nullptr ? &reference->any : nullptr, incoherent.size());
        if (reference != nullptr) row.build_ratio = ratio(reference->build, run.build);
        row.build_seconds = spread(run.build).median;
        if (run.system->has_closest()) {
            const auto hit = [](const Hit& h) { return h.found; };
            row.hit_fraction = static_cast<double>(std::count_if(run.hits.begin(), run.hits.end(), hit)) /
                               static_cast<double>(incoherent.size());
            if (run.system->has_any()) row.any_contradictions = contradictions(run.hits, run.answers);
        }
        if (reference != nullptr && run.system->has_closest()) {
            const Agreement agreement =
                compare(incoherent, reference->hits, run.hits, lattice ? lattice->max_error : 0.0, size);
            row.disagreeing = agreement.disagreeing;
            row.t_disagreeing = agreement.t_disagreeing;
        }
        result.rows.push_back(std::move(row));
    }
    return result;
}

}  // namespace espalier::bench
