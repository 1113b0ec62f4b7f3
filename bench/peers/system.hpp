// A system under measurement: built on one mesh, then asked for many rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <espalier/ray.hpp>

#include "../rays.hpp"

namespace espalier::bench {

struct Hit {
    bool found = false;
    float t = 0.0f, u = 0.0f, v = 0.0f;
    Vec3 normal;
    std::uint32_t id = 0;
};

class System {
public:
    System() = default;
    System(const System&) = delete;
    System& operator=(const System&) = delete;
    virtual ~System() = default;
    [[nodiscard]] virtual const char* name() const = 0;
    [[nodiscard]] virtual const char* profile() const = 0;
    /// Everything that a query reads: tree, vertices, indices.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
    [[nodiscard]] virtual double build_seconds() const = 0;
    /// `coherent`: neighbouring rays are alike, and the system may be told so.
    virtual void closest(const std::vector<Ray>& rays, bool coherent, std::vector<Hit>& hits) = 0;
    virtual std::size_t any(const std::vector<Ray>& rays) = 0;
};

std::unique_ptr<System> make_espalier(const Mesh& mesh, unsigned bits, unsigned effort);
#if defined(ESPALIER_BENCH_EMBREE)
enum class EmbreeMode { fast, compact, robust, compact_robust };
std::unique_ptr<System> make_embree(const Mesh& mesh, EmbreeMode mode);
#endif

/// The reference first: Embree's default where it is installed, else Espalier itself.
std::vector<std::unique_ptr<System>> make_systems(const Mesh& mesh, unsigned bits, unsigned effort,
                                                  bool reference_only);

}  // namespace espalier::bench
