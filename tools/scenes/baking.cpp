#include "baking.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>

#include <baker/base/origin_choice.hpp>
#include <import/base/placement.hpp>

#include "bake/baking.hpp"
#include "base/vectors.hpp"
#include "plan.hpp"

namespace espalier::tools {

namespace {

/// The share of a tolerance that placing may take; the meshes have the rest.
constexpr double placing_share = 0.25;

double largest_placing_error(const Resolution& resolution) {
    if (resolution.kind() == Resolution::Kind::tolerance) return placing_share * resolution.value();
    return std::numeric_limits<double>::infinity();
}

/// The tolerance of a mesh with which all its instances keep that of the scene.
Resolution resolution_of(const Variant& variant, const Resolution& resolution) {
    if (resolution.kind() != Resolution::Kind::tolerance) return resolution;
    double least = std::numeric_limits<double>::infinity();
    for (const VariantUse& use : variant.uses)
        least = std::min(least, (resolution.value() - use.fitted.error) / double(use.fitted.transform.scale));
    return Resolution::tolerance(least * (1.0 - 0x1p-22));  // the error in world units is rounded up to float32
}

bool has_equal_corners(const ImportedMesh& mesh, const TriangleVertices& triangle) {
    const auto are_equal = [&mesh](std::uint32_t a, std::uint32_t b) {
        return a == b || mesh.positions[a] == mesh.positions[b];
    };
    const auto [a, b, c] = triangle;
    return std::max({a, b, c}) < mesh.positions.size() && (are_equal(a, b) || are_equal(b, c) || are_equal(c, a));
}

/// Returns how many triangles, at all places, have two corners in one point of their mesh: they had no surface to lose.
/// Those that a place flattens had one.
std::uint64_t count_equal_corners(const ImportResult& imported) {
    std::vector<std::uint64_t> of_mesh;
    for (const ImportedMesh& mesh : imported.meshes) {
        of_mesh.push_back(static_cast<std::uint64_t>(
            std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                          [&mesh](const TriangleVertices& triangle) { return has_equal_corners(mesh, triangle); })));
    }
    std::uint64_t sum = 0;
    for (const ImportedPlace& place : imported.places) sum += of_mesh[place.mesh];
    return sum;
}

BakeOptions with_origin(BakeOptions options, const std::optional<Vec3d>& origin) {
    options.origin = origin;
    return options;
}

/// Bakes one mesh after the other and collects their instances.
class SceneBaker {
public:
    SceneBaker(const ImportResult& imported, Instancing instancing, const BakeOptions& options)
        : imported_(imported),
          instancing_(instancing),
          options_(with_origin(options, Vec3d{})),
          origin_(options.origin.value_or(Vec3d{})),
          plan_(plan_scene(imported, instancing, largest_placing_error(options.resolution))) {
        std::uint32_t meshes = 0;
        for (const ImportedFile& file : imported.files)
            first_user_.push_back(std::exchange(meshes, meshes + file.meshes));
        if (origin_ == Vec3d{}) return;
        for (Variant& variant : plan_.meshes) count_from_middle(variant);
    }

    SceneBake bake() {
        std::vector<Baked> kept, small;
        for (Variant& variant : plan_.meshes) {
            Baked baked = bake_variant(variant);
            (is_worth_it(baked) ? kept : small).push_back(std::move(baked));
        }
        if (is_worth_merging(small)) {
            for (const Baked& baked : small)
                for (const VariantUse& use : baked.variant->uses) plan_.merged.push_back(use.place);
        } else {
            std::move(small.begin(), small.end(), std::back_inserter(kept));
            std::sort(kept.begin(), kept.end(), [](const Baked& a, const Baked& b) {
                return a.variant->uses.front().place < b.variant->uses.front().place;
            });
        }
        std::sort(plan_.merged.begin(), plan_.merged.end());
        if (!plan_.merged.empty()) add_merged();
        std::vector<std::pair<const VariantUse*, std::uint32_t>> uses;  // of a mesh
        for (Baked& baked : kept) {
            const std::uint32_t mesh =
                add_mesh(words_for_place(imported_, place_of(*baked.variant)), baked.variant->uses.size(),
                         baked.variant->uses.size(), std::move(baked.result));
            if (is_empty(mesh)) continue;
            for (const VariantUse& use : baked.variant->uses) uses.emplace_back(&use, mesh);
        }
        std::sort(uses.begin(), uses.end(),
                  [](const auto& a, const auto& b) { return a.first->place < b.first->place; });
        for (const auto& [use, mesh] : uses) add_instance(*use, mesh);
        return joined();
    }

private:
    struct Baked {
        const Variant* variant;
        BakeResult result;
    };

    [[nodiscard]] const ImportedPlace& place_of(const Variant& variant) const {
        return imported_.places[variant.uses.front().place];
    }
    /// Lets a mesh that lies far from its own origin count from its middle, which its instances then place.
    void count_from_middle(Variant& variant) const {
        ImportResult mesh;
        mesh.meshes.push_back(placed_mesh(imported_, place_of(variant), variant.placement));
        const Vec3d middle = origin_of(mesh, with_origin(options_, std::nullopt));
        if (middle == Vec3d{}) return;
        std::vector<VariantUse> uses = variant.uses;
        for (VariantUse& use : uses) {
            const espalier::Transform& transform = use.fitted.transform;
            const Vec3d to = use.fitted.offset + double(transform.scale) * turned(transform.rotation, middle);
            const FittedTransform moved = fit_translation({to.x, to.y, to.z});
            use.fitted.error +=
                moved.error + 0x1p-50 * (length_of(use.fitted.offset) + double(transform.scale) * length_of(middle));
            use.fitted.offset = moved.offset;
            use.fitted.transform.translation = moved.transform.translation;
            if (!(use.fitted.error <= largest_placing_error(options_.resolution))) return;
        }
        variant.uses = std::move(uses);
        variant.placement.offset[0] -= middle.x;
        variant.placement.offset[1] -= middle.y;
        variant.placement.offset[2] -= middle.z;
    }

    [[nodiscard]] bool is_empty(std::uint32_t mesh) const { return scene_.meshes[mesh].baked.tree.triangles == 0; }

    BakeResult bake_views(std::span<const MeshView> views, const Resolution& resolution) {
        BakeOptions options = options_;
        options.resolution = resolution;
        const double parts = static_cast<double>(plan_.meshes.size()) + 1.0;
        if (options_.progress) {
            options.progress = [this, parts](const char* stage, double done) {
                options_.progress(stage, (static_cast<double>(done_) + done) / parts);
            };
        }
        BakeResult result = bake_or_throw(views, imported_, options);
        ++done_;
        return result;
    }

    Baked bake_variant(const Variant& variant) {
        const ImportedMesh mesh = placed_mesh(imported_, place_of(variant), variant.placement);
        const MeshView view{{}, mesh.triangles, mesh.materials, mesh.file, mesh.mesh, mesh.name, mesh.positions};
        return {&variant, bake_views({&view, 1}, resolution_of(variant, options_.resolution))};
    }

    /// Returns how many bytes more the mesh takes as instances than as a part of another blob.
    [[nodiscard]] static double bytes_lost(const Baked& baked) {
        const Blob blob = opened(baked.result);
        const std::uint64_t instances = baked.variant->uses.size();
        return bytes_as_instances(blob, instances) -
               static_cast<double>(instances) * bytes_as_part(baked.result.bytes, blob);
    }

    [[nodiscard]] bool is_worth_it(const Baked& baked) const {
        return instancing_ == Instancing::all || bytes_lost(baked) < 0.0;
    }

    /// Returns whether meshes that lose bytes as instances lose more than a blob for them alone would take; there may
    /// be one already.
    [[nodiscard]] bool is_worth_merging(const std::vector<Baked>& small) const {
        double lost = 0.0;
        for (const Baked& baked : small) lost += bytes_lost(baked);
        return !plan_.merged.empty() || lost > bytes_of_merging();
    }

    void add_merged() {
        std::uint64_t triangles = 0;
        for (const std::uint32_t place : plan_.merged) {
            triangles += imported_.meshes[imported_.places[place].mesh].triangles.size();
            if (triangles <= format::max_triangles) continue;
            throw_error(ExitCode::unsupported, words_for_place(imported_, imported_.places[place]),
                        ": with it more than ", format::max_triangles,
                        " triangles are merged, the most a blob can hold. Give --instances all, or bake the "
                        "files in parts.");
        }
        ImportResult merged;
        for (const std::uint32_t place : plan_.merged)
            merged.meshes.push_back(placed_mesh(imported_, imported_.places[place], imported_.places[place].placement));
        // Where float32 is too coarse for them they count from a translation, which it holds.
        const Vec3 origin = importer::to_float32(origin_of(merged, with_origin(options_, std::nullopt)));
        for (ImportedMesh& each : merged.meshes)
            for (Vec3d& position : each.positions) position = position - importer::to_float64(origin);
        const std::uint32_t mesh =
            add_mesh({}, 1, plan_.merged.size(), bake_views(merged.views(), options_.resolution));
        if (is_empty(mesh)) return;
        note_error(scene_.meshes[mesh].baked.lattice.max_error, 0.0);
        Instance instance;
        instance.transform.translation = origin;
        instance.mesh = mesh;
        instance.user = no_user;
        instances_.push_back(instance);
        translations_.push_back(importer::to_float64(origin) + origin_);
        scene_.places.emplace_back();
    }

    std::uint32_t add_mesh(std::string name, std::uint64_t instances, std::uint64_t places, BakeResult baked) {
        const bool is_without = baked.report.tree.triangles == 0;
        total_.add(baked.report, name, instances);
        scene_.meshes.push_back({std::move(name), is_without ? 0 : instances, places, std::move(baked.report)});
        blobs_.push_back(std::move(baked.bytes));
        return static_cast<std::uint32_t>(blobs_.size() - 1);
    }

    void add_instance(const VariantUse& use, std::uint32_t mesh) {
        const ImportedPlace& place = imported_.places[use.place];
        Instance instance;
        instance.transform = use.fitted.transform;
        instance.mesh = mesh;
        instance.user = first_user_[place.file] + place.number;
        instances_.push_back(instance);
        translations_.push_back(use.fitted.offset + origin_);
        scene_.places.emplace_back(use.place);
        note_error(scene_.meshes[mesh].baked.lattice.max_error * double(use.fitted.transform.scale), use.fitted.error);
    }

    void note_error(double of_mesh, double of_placing) {
        of_placing += 0x1p-52 * length_of(origin_);  // sums with it are rounded to float64
        scene_.placing_error = std::max(scene_.placing_error, of_placing);
        scene_.max_error = std::max(scene_.max_error, of_mesh + of_placing);
    }

    SceneBake joined() {
        const std::vector<std::span<const std::byte>> blobs(blobs_.begin(), blobs_.end());
        SceneBakeOptions placed;
        placed.origin = origin_;
        if (origin_ != Vec3d{}) placed.translations = translations_;
        SceneBakeResult result = bake_scene(blobs, instances_, placed);
        if (!result) {
            const bool is_ours = result.status == BakeStatus::internal || result.status == BakeStatus::invalid_mesh;
            throw_error(is_ours ? ExitCode::internal : ExitCode::unsupported,
                        "the scene cannot be made: " + result.message + ". Nothing was written.");
        }
        scene_.bytes = std::move(result.bytes);
        scene_.report = result.report;
        scene_.total = total_.report();
        std::ranges::copy(result.report.warnings, std::back_inserter(scene_.total.warnings));
        Findings& findings = scene_.total.findings;
        findings.equal_corners = std::min(findings.zero_area.count, count_equal_corners(imported_));
        return std::move(scene_);
    }

    const ImportResult& imported_;
    Instancing instancing_;
    BakeOptions options_;  // of the meshes, which have no origin of their own
    Vec3d origin_;
    ScenePlan plan_;
    SceneBake scene_;
    ReportTotal total_;
    std::vector<std::uint32_t> first_user_;  ///< of each file
    std::vector<std::vector<std::byte>> blobs_;
    std::vector<Instance> instances_;
    std::vector<Vec3d> translations_;  // in the source
    std::size_t done_ = 0;
};

}  // namespace

Vec3d move_to_origin(ImportResult& imported, const BakeOptions& options) {
    Vec3d origin = options.origin.value_or(Vec3d{});
    if (!options.origin) {
        bool is_needed = false;
        PointBox all;
        for (const ImportedPlace& place : imported.places) {
            const PointBox box = box_at(imported.meshes[place.mesh], place.placement);
            if (imported.meshes[place.mesh].triangles.empty() || box.low[0] > box.high[0]) continue;
            ImportResult corners;
            ImportedMesh& mesh = corners.meshes.emplace_back();
            mesh.positions = {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}};
            mesh.triangles = {{0, 1, 0}};
            is_needed = is_needed || origin_of(corners, options) != Vec3d{};
            for (const Vec3d& corner : mesh.positions) all.add(corner);
        }
        const double side = std::max({all.high[0] - all.low[0], all.high[1] - all.low[1], all.high[2] - all.low[2]});
        if (is_needed && side <= double(std::numeric_limits<float>::max()))  // else no origin helps
            origin = baker::origin_near_middle({all.low[0], all.low[1], all.low[2]},
                                               {all.high[0], all.high[1], all.high[2]}, baker::power_above(side));
    }
    if (origin == Vec3d{}) return origin;
    for (ImportedPlace& place : imported.places) {
        place.placement.offset[0] -= origin.x;
        place.placement.offset[1] -= origin.y;
        place.placement.offset[2] -= origin.z;
    }
    return origin;
}

SceneBake bake_scene_or_throw(const ImportResult& imported, Instancing instancing, const BakeOptions& options) {
    return SceneBaker(imported, instancing, options).bake();
}

}  // namespace espalier::tools
