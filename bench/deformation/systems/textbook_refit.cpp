#include <algorithm>

#include "../box_tree.hpp"
#include "../refit_system.hpp"

namespace espalier::bench {
namespace {

template <class BoxKind>
class TextbookRefit final : public RefitSystem {
public:
    using Renew = void (*)(const BoxTreeShape&, std::span<const Vec3>, std::span<BoxKind>);
    TextbookRefit(const Mesh& mesh, Renew renew)
        : positions_(mesh.positions),
          shape_(build_box_tree(mesh.triangles, mesh.positions)),
          boxes_(shape_.nodes.size()),
          renew_(renew) {}
    void set_positions(const std::vector<Vec3>& positions) override {
        std::copy(positions.begin(), positions.end(), positions_.begin());
    }
    void refit() override { renew_(shape_, positions_, boxes_); }
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const override {
        return boxes_.front().contains(point, rounding);
    }
    [[nodiscard]] std::size_t bytes() const override {
        return boxes_.size() * (sizeof(BoxKind) + sizeof(BoxTreeShape::Node)) + positions_.size() * sizeof(Vec3) +
               shape_.triangles.size() * sizeof(TriangleVertices);
    }

private:
    std::vector<Vec3> positions_;
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
