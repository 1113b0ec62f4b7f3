// The interface of a system that queries a mesh together with a second one of the same kind, in many poses.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

class PairSystem {
public:
    virtual ~PairSystem() = default;
    [[nodiscard]] virtual bool has_yes_no() const { return true; }
    [[nodiscard]] virtual bool has_all() const { return true; }
    [[nodiscard]] virtual bool has_distance() const { return true; }
    virtual bool yes_no(const Transform& pose) = 0;
    /// How many pairs, or contacts where the system says contacts.
    virtual std::size_t all(const Transform& pose) = 0;
    virtual double distance(const Transform& pose) = 0;
};

struct PairMaker {
    std::string system;
    std::string profile;
    std::function<std::unique_ptr<PairSystem>(const Mesh&)> make;
};

std::vector<PairMaker> espalier_pair_makers();
std::vector<PairMaker> fcl_pair_makers();
std::vector<PairMaker> ode_pair_makers();

}  // namespace espalier::bench
