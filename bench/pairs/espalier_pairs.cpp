#include <stdexcept>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "pair_system.hpp"

namespace espalier::bench {
namespace {

class EspalierPairs final : public PairSystem {
public:
    EspalierPairs(const Mesh& mesh, Profile profile) {
        BakeOptions options;
        options.profile = profile;
        const MeshView view = mesh.view();
        auto baked = bake({&view, 1}, options);
        if (!baked) throw std::runtime_error(baked.message);
        bytes_ = std::move(baked.bytes);
        blob_ = open(bytes_);
        if (!blob_) throw std::runtime_error(mesh.name + ": what was baked does not open: " + describe(blob_.status()));
    }
    bool yes_no(const Transform& pose) override {
        const YesNo answer = overlaps(blob_, {blob_, pose}, WorkLimit::unlimited());
        check(answer.status());
        return answer.yes();
    }
    std::size_t all(const Transform& pose) override {
        std::size_t count = 0;
        check(for_each_contact(
            blob_, {blob_, pose}, [&](const PairContact&) { ++count; }, WorkLimit::unlimited()));
        return count;
    }
    double distance(const Transform& pose) override {
        const BlobDistance nearest = espalier::distance(blob_, {blob_, pose}, WorkLimit::unlimited());
        check(nearest.status);
        return static_cast<double>(nearest.distance);
    }

private:
    static void check(QueryStatus status) {
        if (status != QueryStatus::ok && status != QueryStatus::not_found) throw std::runtime_error(describe(status));
    }
    std::vector<std::byte> bytes_;
    Blob blob_;
};

}  // namespace

std::vector<PairMaker> espalier_pair_makers() {
    std::vector<PairMaker> makers;
    const auto add = [&](const char* name, Profile profile) {
        makers.push_back(
            {"espalier", name, [profile](const Mesh& mesh) { return std::make_unique<EspalierPairs>(mesh, profile); }});
    };
    add("fast", Profile::fast);
    add("balanced", Profile::balanced);
    return makers;
}

}  // namespace espalier::bench
