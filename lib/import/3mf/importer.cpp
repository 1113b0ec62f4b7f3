#include <import/base/importers.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <import/3mf/package.hpp>
#include <import/base/error.hpp>
#include <import/base/mesh_collector.hpp>

namespace espalier::importer {

namespace {

/// Beyond what blobs and scenes can hold, and far from overflow when as many as a file can list are added.
constexpr std::uint64_t too_many = std::uint64_t{1} << 32;

/// A chain of objects of which each only contains the next has this many at most in files that are not made to cost
/// time. The placements of a longer one are combined once, not at each place.
constexpr std::size_t longest_plain_chain = 16;

/// An object of the package in another one or in the build, by its number.
struct Child {
    std::size_t object;
    Placement placement;
};

/// Where the chain below an object ends.
struct ChainEnd {
    Child end;
    std::size_t length;
};

/// What an object makes at each place.
struct Weight {
    std::uint64_t meshes = 0;
    std::uint64_t triangles = 0;

    void add(const Weight& other) {
        meshes = std::min(too_many, meshes + other.meshes);
        triangles = std::min(too_many, triangles + other.triangles);
    }
};

/// Places the meshes of a package as its build does.
class Placer {
public:
    Placer(ThreeMfPackage package, const ImportOptions& options, ImportedFile& file, ImportResult& imported)
        : package_(std::move(package)), file_(file), meshes_(options, file, imported) {}

    void read() {
        children_.resize(package_.objects.size());
        weights_.resize(package_.objects.size());
        states_.assign(package_.objects.size(), State::unseen);
        imported_.assign(package_.objects.size(), std::nullopt);
        chains_.assign(package_.objects.size(), {});
        std::vector<Child> items;
        Weight all;
        for (const ThreeMfUse& item : package_.items) {
            items.push_back({number_of(item, [&] { return words_for_item(items.size()); }), item.placement});
            weigh(items.back().object);
            all.add(weights_[items.back().object]);
        }
        const std::string words = text('\'', printable(file_.path), "', build");
        if (meshes_.keeps_places()) {
            meshes_.require_places(all.meshes, words);
        } else {
            meshes_.require_copies(all.meshes - std::min(all.meshes, package_.objects.size()), words);
            meshes_.require_room(all.triangles, words);
        }
        for (const Child& item : items) place(item);
        warn();
    }

private:
    enum class State : std::uint8_t { unseen, open, done };

    [[nodiscard]] std::string words_for_item(std::size_t item) const {
        return text('\'', printable(file_.path), "', build item ", item);
    }
    [[nodiscard]] static std::string words_for_component(const ThreeMfObject& object, std::size_t component) {
        return text(object.words, ", component ", component);
    }

    /// `describe` returns the words that name the use in messages.
    template <class Describe>
    [[nodiscard]] std::size_t number_of(const ThreeMfUse& use, const Describe& describe) const {
        const auto found = package_.numbers.find({use.model, use.id});
        if (found != package_.numbers.end()) return found->second;
        throw_error(ImportStatus::invalid_input, describe(), ": it names object ", use.id, ", which ",
                    printable(package_.models[use.model]), " does not have. Export it again.");
    }

    /// Finds the components of an object and of those in it, and what all of them make: a file of a hundred objects can
    /// place a mesh 2^100 times. Keeps an own stack: how deep a file nests is not ours to choose.
    void weigh(std::size_t top) {
        std::vector<std::pair<std::size_t, std::size_t>> open = {{top, 0}};  // and the component that is next
        while (!open.empty()) {
            auto& [number, next] = open.back();
            const ThreeMfObject& object = package_.objects[number];
            if (next == 0 && states_[number] == State::done) {
                open.pop_back();
                continue;
            }
            states_[number] = State::open;
            if (next < object.components.size()) {
                const std::size_t component = next++;
                const ThreeMfUse& use = object.components[component];
                const auto describe = [&] { return words_for_component(object, component); };
                const std::size_t child = number_of(use, describe);
                if (states_[child] == State::open) {
                    throw_error(ImportStatus::invalid_input, describe(), ": object ", use.id,
                                " contains itself. The file is broken; export it again.");
                }
                children_[number].push_back({child, use.placement});
                if (states_[child] == State::unseen) open.emplace_back(child, 0);
                continue;
            }
            states_[number] = State::done;
            if (object.is_other) {
                others_.push_back(number);
            } else {
                weights_[number] = {object.triangles.empty() ? 0u : 1u, object.triangles.size()};
                for (const Child& child : children_[number]) weights_[number].add(weights_[child.object]);
            }
            std::erase_if(children_[number], [&](const Child& child) { return weights_[child.object].meshes == 0; });
            chains_[number] = chain_of(number);
            open.pop_back();
        }
    }

    /// Those of the components are known.
    [[nodiscard]] ChainEnd chain_of(std::size_t number) const {
        const std::vector<Child>& children = children_[number];
        if (children.size() != 1 || !package_.objects[number].triangles.empty()) return {{number, {}}, 0};
        const ChainEnd& below = chains_[children[0].object];
        return {{below.end.object, combine(children[0].placement, below.end.placement)}, below.length + 1};
    }

    void place(const Child& item) {
        if (weights_[item.object].meshes == 0) return;
        std::vector<Child> waiting = {{item.object, combine(meshes_.asset_placement(), item.placement)}};
        while (!waiting.empty()) {
            Child next = waiting.back();
            waiting.pop_back();
            if (const ChainEnd& chain = chains_[next.object]; chain.length > longest_plain_chain)
                next = {chain.end.object, combine(next.placement, chain.end.placement)};
            if (!package_.objects[next.object].triangles.empty()) add_mesh(next);
            const std::vector<Child>& children = children_[next.object];
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                waiting.push_back({child->object, combine(next.placement, child->placement)});
        }
    }

    void add_mesh(const Child& placed) {
        const ThreeMfObject& object = package_.objects[placed.object];
        std::optional<std::uint32_t>& known = imported_[placed.object];
        ImportedMesh mesh = meshes_.begin(object.name, known ? 0 : object.triangles.size());
        if (known) return meshes_.add_place(*known, mesh, placed.placement);
        const Placement applied = meshes_.applied(placed.placement);
        mesh.positions.reserve(object.positions.size());
        for (const Vec3d& position : object.positions) mesh.positions.push_back(applied(position));
        mesh.triangles = object.triangles;
        mesh.materials = object.materials;
        // A mirrored mesh must keep its front outside: its corners run the other way.
        if (applied.mirrors())
            for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
        const std::uint32_t index = meshes_.add(std::move(mesh), placed.placement);
        if (meshes_.keeps_places()) known = index;
    }

    void warn() {
        if (!others_.empty()) {
            add_warning(
                file_, "object_left_out",
                text(package_.objects[others_.front()].words,
                     ": the build places an object of type 'other', which is no part of the model: a slicer's "
                     "modifier, for example. It was left out",
                     others_.size() > 1 ? text(", and so were ", others_.size() - 1, " more.") : std::string(".")));
        }
        std::size_t unused = 0, first = 0;
        for (std::size_t i = package_.objects.size(); i-- > 0;) {
            if (states_[i] != State::unseen || package_.objects[i].triangles.empty()) continue;
            first = i;
            ++unused;
        }
        if (unused == 0) return;
        add_warning(file_, "unused_mesh",
                    text(package_.objects[first].words, ": the build does not place the mesh, and it is left out.",
                         unused > 1 ? text(" The file has ", unused, " such meshes.") : "",
                         " Add it to the build to bake it."));
    }

    ThreeMfPackage package_;
    ImportedFile& file_;
    MeshCollector meshes_;
    std::vector<std::vector<Child>> children_;            // of each object, those with meshes
    std::vector<Weight> weights_;                         // of each object, with its components
    std::vector<ChainEnd> chains_;                        // of each object
    std::vector<State> states_;                           // of each object
    std::vector<std::optional<std::uint32_t>> imported_;  // the mesh that an object's places share
    std::vector<std::size_t> others_;
};

}  // namespace

void import_3mf(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    ImportedFile file;
    file.path = path;
    file.opened.push_back(path);
    file.format = "3MF";
    ThreeMfPackage package = read_3mf_package(options, file);
    set_materials(file, package.materials);
    file.metres_per_unit = options.metres_per_unit.value_or(package.metres_per_unit);
    file.unit_origin = options.metres_per_unit ? "--unit"
                       : package.unit.empty()  ? "3MF, whose default is the millimetre"
                                               : text("3MF unit ", package.unit);
    Placer(std::move(package), options, file, imported).read();
    imported.files.push_back(std::move(file));
}

}  // namespace espalier::importer
