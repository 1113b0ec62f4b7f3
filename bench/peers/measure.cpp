#include "measure.hpp"

#include <cstdlib>
#include <thread>

#include "../../tools/base/choices.hpp"
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

void add_length(JsonObject& row, const char* name, std::optional<double> value) {
    row.add_raw(name, value ? digits_of(*value, 6) : "null");
}

/// Nothing where there is no such query, or no reference to take a ratio to; above 1 is faster.
void add_ratio(JsonObject& row, const std::string& name, const std::vector<double>& own,
               const std::vector<double>* reference) {
    const bool is_known = reference != nullptr && !own.empty();
    const Spread found = is_known ? ratio(*reference, own) : Spread{};
    row.add_raw(name + "_ratio", is_known ? decimal(found.median, 3) : "null");
    row.add_raw(name + "_spread", is_known ? json_list({decimal(found.low, 3), decimal(found.high, 3)}) : "null");
}

/// What all rows about a mesh begin with, behind the name of the system.
void add_conditions(JsonObject& row, const Mesh& mesh, const Options& options, std::optional<double> load) {
    row.add("mesh", mesh.name);
    row.add("triangles", mesh.triangles.size());
    row.add("bits", std::size_t{options.bake.bits});
    row.add("effort", tools::name_in(tools::effort_choices, options.bake.effort));
    row.add("builder", tools::name_in(tools::builder_choices, options.bake.builder));
    row.add("rays", options.incoherent);
    row.add("seed", std::size_t{options.seed});
    row.add("repetitions", std::size_t{options.repetitions});
    row.add("builds", std::size_t{options.builds});
    add_machine(row);
    row.add("processors", std::size_t{std::thread::hardware_concurrency()});
    row.add("load", load, 2);
}

}  // namespace

void measure(const std::string& path, const std::vector<Maker>& makers, const Options& options) {
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
    // The machine's load average of a minute, at the end; a quiet one has about 1: us.
    const std::optional<double> load = load_average();
    const double size = largest_coordinate(mesh);
    const auto per_triangle = [&mesh](std::size_t bytes) { return per(bytes, mesh.triangles.size()); };
    for (std::size_t s = 0; s < makers.size(); ++s) {
        const Run& run = runs[s];
        const std::optional<Lattice> lattice = run.system->lattice();
        const auto bytes_at_20_bits = run.system->bytes_at_20_bits();
        JsonObject row;
        row.add("system", makers[s].name);
        row.add("profile", makers[s].profile);
        row.add("version", makers[s].version);
        add_conditions(row, mesh, options, load);
        row.add("bytes_per_triangle", per_triangle(run.system->bytes()), 3);
        row.add("bytes_per_triangle_20_bits",
                bytes_at_20_bits ? std::optional(per_triangle(*bytes_at_20_bits)) : std::nullopt, 3);
        row.add("bytes_per_triangle_with_ids", per_triangle(run.system->bytes_with_ids()), 3);
        // In the mesh's own units.
        add_length(row, "step", lattice ? std::optional(lattice->step / scale) : std::nullopt);
        add_length(row, "extent", lattice ? std::optional(lattice->extent / scale) : std::nullopt);
        add_length(row, "max_error", lattice ? std::optional(lattice->max_error / scale) : std::nullopt);
        for (const auto& [name, seconds] : {std::pair("incoherent", &Run::incoherent),
                                            {"coherent", &Run::coherent},
                                            {"any", &Run::any},
                                            {"build", &Run::build}})
            add_ratio(row, name, run.*seconds, reference != nullptr ? &(reference->*seconds) : nullptr);
        const auto add_mrays = [&](const char* name, const std::vector<double>& own, std::size_t rays) {
            row.add(name, own.empty() ? std::nullopt : std::optional(static_cast<double>(rays) / median_of(own) * 1e-6),
                    3);
        };
        add_mrays("incoherent_mrays", run.incoherent, incoherent.size());
        add_mrays("coherent_mrays", run.coherent, coherent.size());
        add_mrays("any_mrays", run.any, incoherent.size());
        row.add("build_seconds", median_of(run.build), 4);
        const bool has_hits = run.system->has_closest();
        const auto hits = static_cast<std::size_t>(std::ranges::count_if(run.hits, &Hit::found));
        row.add("hit_fraction", has_hits ? std::optional(per(hits, incoherent.size())) : std::nullopt, 4);
        std::optional<Agreement> agreement;
        if (reference != nullptr && has_hits)
            agreement = compare(incoherent, reference->hits, run.hits, lattice ? lattice->max_error : 0.0, size);
        row.add("disagreeing", agreement ? std::optional(agreement->disagreeing) : std::nullopt);
        row.add("t_disagreeing", agreement ? std::optional(agreement->t_disagreeing) : std::nullopt);
        // The system's any-hit query against its closest-hit query.
        row.add("any_contradictions", has_hits && run.system->has_any()
                                          ? std::optional(contradictions(run.hits, run.answers))
                                          : std::nullopt);
        row.print();
    }
    std::fflush(stdout);
}

}  // namespace espalier::bench
