// The questions that both sides answer, as plain floats (side.h): the same for every commit and every run.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

struct QuestionSet {
    std::string name;  ///< of the row: "closest_hit_incoherent"
    std::string kind;  ///< of the call (side.h): "closest_hit"
    std::size_t floats = 0;
    std::size_t count = 0;
    std::vector<float> numbers;  ///< `floats` for each of `count`
};

/// The names of all rows, in the order in which they are measured.
std::vector<std::string> question_names();

/// Returns whether a sphere touches the mesh.
using TouchesSphere = std::function<bool(Vec3 center, float radius)>;

/// Returns the set of that name, one of question_names(). Poses are placed so that `collides` is true of about half;
/// short and long sweeps start where nothing touches a sphere around the shape.
QuestionSet make_questions(const std::string& name, const Mesh& mesh,
                           const std::function<bool(const Transform&)>& collides, const TouchesSphere& touches);

/// The floats of one placement, as the kinds of pairs take them.
std::vector<float> numbers_of(const Transform& pose);

}  // namespace espalier::bench
