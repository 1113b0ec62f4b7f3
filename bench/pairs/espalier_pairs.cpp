#include <stdexcept>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "pair_system.hpp"

namespace espalier::bench {
namespace {

class EspalierPairs final : public PairSystem {
public:
    EspalierPairs(const Mesh& mesh, format::Profile profile) {
        BakeOptions options;
        options.profile = profile;
        const MeshView view = mesh.view();
        auto baked = bake({&view, 1}, options);
        if (!baked) throw std::runtime_error(baked.error().message);
        bytes_ = std::move(baked->blob);
        if (const Status status = open(bytes_, blob_); status != Status::ok)
            throw std::runtime_error(mesh.name + ": what was baked does not open: " + describe(status));
    }
    bool yes_no(const Placement& pose) override {
        bool answer = false;
        check(collides(blob_, blob_, pose, answer));
        return answer;
    }
    std::size_t all(const Placement& pose) override {
        std::size_t count = 0;
        check(for_each_contact(blob_, blob_, pose, [&](const TrianglePair&) { return ++count, keep_going; }));
        return count;
    }
    double distance(const Placement& pose) override {
        PairDistance nearest;
        bool found = false;
        check(minimum_distance(blob_, blob_, pose, __builtin_inff(), nearest, found));
        return static_cast<double>(nearest.distance);
    }

private:
    static void check(QueryStatus status) {
        if (status != QueryStatus::ok) throw std::runtime_error(describe(status));
    }
    std::vector<std::byte> bytes_;
    Blob blob_;
};

}  // namespace

std::vector<PairMaker> espalier_pair_makers() {
    std::vector<PairMaker> makers;
    const auto add = [&](const char* name, format::Profile profile) {
        makers.push_back(
            {"espalier", name, [profile](const Mesh& mesh) { return std::make_unique<EspalierPairs>(mesh, profile); }});
    };
    add("fast", format::Profile::fast);
    add("balanced", format::Profile::balanced);
    return makers;
}

}  // namespace espalier::bench
