// What a blob holds: its bounds, triangles and nodes, and how its surface bends.
#include <cmath>

#include <import/base/numbers.hpp>

#include "base/choices.hpp"
#include "base/vectors.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

const Choices<EdgeKind> edge_choices{{"flat", EdgeKind::flat},
                                     {"convex", EdgeKind::convex},
                                     {"concave", EdgeKind::concave},
                                     {"boundary", EdgeKind::boundary}};

Answer bounds_answer(QueryCall& call) {
    const Blob& blob = call.blob();
    Answer answer(call);
    Record& record = answer.record.title("bounds");
    if (call.scene() != nullptr) {
        record.add("box", call.in_source(call.scene()->bounds()));
        return answer;
    }
    record.add("box", call.in_source(blob.bounds()));
    if (const Result<Sphere> sphere = bounding_sphere(blob)) {
        Record inner(record.as_json());
        record.add("sphere", inner.add("center", call.in_source(sphere->center)).add("radius", sphere->radius));
    }
    if (const Result<OrientedBox> box = oriented_bounds(blob)) {
        Record inner(record.as_json());
        inner.add("center", call.in_source(box->center)).add("half_axes", box->half_axes);
        record.add("oriented_box", inner);
    }
    if (const Result<KDop> k_dop = k_dop_bounds(blob)) {
        std::vector<Record> slabs;
        for (unsigned i = 0; i < KDop::count; ++i) {
            const Vec3& along = KDop::directions[i];
            const double zero = dot(to_float64(along), call.origin());
            Record& slab = slabs.emplace_back(record.as_json());
            slab.title(text("along ", shortest(along), ": ", words_in_source(k_dop->lo[i], zero), " to ",
                            words_in_source(k_dop->hi[i], zero)));
            slab.add_silently("direction", json_point(along));
            slab.add_silently("min", json_in_source(k_dop->lo[i], zero));
            slab.add_silently("max", json_in_source(k_dop->hi[i], zero));
        }
        record.add("k_dop", slabs);
    }
    return answer;
}

Answer lattice_answer(QueryCall& call) {
    const Lattice lattice = call.blob().lattice();
    Answer answer(call);
    const std::int32_t* extent = lattice.extent;
    answer.record.title(text("lattice of ", extent[0], " x ", extent[1], " x ", extent[2], " steps"));
    answer.record.add_silently("extent", Json::array({extent[0], extent[1], extent[2]}));
    answer.record.add("origin", call.in_source(lattice.origin)).add("step", std::ldexp(1.0f, lattice.step_exponent));
    answer.record.add_silently("step_exponent", lattice.step_exponent);
    return answer;
}

Answer steps_answer(QueryCall& call) {
    const Result<LatticePoint> nearest = to_lattice(call.blob().lattice(), call.next<Vec3>());
    Answer answer(call, nearest.status);
    answer.record.title(text("steps ", nearest->x, ' ', nearest->y, ' ', nearest->z));
    answer.record.add_silently("steps", Json::array({nearest->x, nearest->y, nearest->z}));
    answer.record.add("point", call.in_source(to_local(call.blob().lattice(), *nearest)));
    return answer;
}

void add_corners(Record& record, const QueryCall& call, const Triangle& corners) {
    record.add("a", call.in_source(corners.a)).add("b", call.in_source(corners.b));
    record.add("c", call.in_source(corners.c));
}

Answer show_answer(QueryCall& call) {
    const TriangleId triangle = call.next_triangle();
    Answer answer(call);
    answer.record.triangle(call.blob(), triangle);
    if (const auto corners = triangle_at(call.blob(), triangle)) add_corners(answer.record, call, *corners);
    if (const Result<EdgeKinds> kinds = edge_kinds(call.blob(), triangle)) {
        answer.record.add("edge_ab", name_in(edge_choices, kinds->ab)).add("edge_bc", name_in(edge_choices, kinds->bc));
        answer.record.add("edge_ca", name_in(edge_choices, kinds->ca));
    }
    return answer;
}

Feature feature_named(const std::string& name) {
    for (const auto& choice : feature_choices)
        if (name == choice.first) return choice.second;
    throw_error(ExitCode::usage, "feature: '", printable(name), "' is none of ",
                listed(feature_choices, ", ", &Choices<Feature>::value_type::first), '.');
}

Answer contact_answer(QueryCall& call) {
    const TriangleId triangle = call.next_triangle();
    const Feature feature = feature_named(call.next<std::string>());
    const Vec3 normal = call.next<Vec3>();
    Answer answer(call);
    if (!call.blob().has_edge_flags()) {
        throw QueryRefusal{QueryStatus::no_data, text("'", printable(call.options().blob),
                                                      "' stores no edge flags; bake it with --flat-angle")};
    }
    const Vec3 fixed = fix_internal_edge_normal(call.blob(), triangle, feature, normal);
    answer.yes_or_no("fixed", fixed != normal, "fixed, on an internal edge", "unchanged");
    answer.record.add("normal", fixed);
    return answer;
}

Answer triangles_answer(QueryCall& call) {
    const QueryArguments& options = call.options();
    Answer answer(call);
    std::uint32_t next = 0;
    (void)for_each_triangle(call.blob(), [&](TriangleId triangle, const Triangle& corners) {
        if (triangle.index < options.from) return Visit::next;
        if (options.limit && answer.list.size() == *options.limit) {
            answer.status = QueryStatus::output_full;
            next = triangle.index;
            return Visit::stop;
        }
        add_corners(answer.add().triangle(call.blob(), triangle), call, corners);
        return Visit::next;
    });
    return answer.counted_list("triangles", "triangle", &next);
}

Record node_record(const QueryCall& call, const TreeNode& node) {
    const bool as_json = call.options().json;
    const std::string indent(2 * std::size_t{node.depth - 1}, ' ');
    Record record(as_json);
    record.title(text(indent, "node ", node.number)).add_silently("node", node.number);
    record.add_silently("depth", node.depth);
    std::vector<Record> children;
    for (unsigned i = 0; i < node.child_count; ++i) {
        const TreeChild& child = node.children[i];
        Record& made = children.emplace_back(as_json);
        const SourceBox around = call.in_source(child.box);
        const std::string box = text(", box ", words_for_point(around.min), " to ", words_for_point(around.max));
        if (child.is_leaf) {
            made.title(text(indent, counted(child.count, "triangle"), " from ", child.first.index, box));
            made.add_silently("first", child.first.index).add_silently("triangles", child.count);
        } else {
            made.title(text(indent, "node ", child.node, box)).add_silently("node", child.node);
        }
        made.add_silently("box", json_box(around));
    }
    return record.add("children", children);
}

Answer tree_answer(QueryCall& call) {
    Answer answer(call);
    (void)for_each_node(call.blob(), [&](const TreeNode& node) {
        answer.list.push_back(node_record(call, node));
        return node.depth < call.options().depth ? NodeVisit::descend : NodeVisit::skip;
    });
    return answer.counted_list("nodes", "node");
}

}  // namespace

QueryKinds blob_kinds() {
    constexpr QueryFamily family{"What the blob holds"};
    return {
        family("bounds", "The bounds of the whole asset, those that it carries", {}, 0, bounds_answer, 0),
        family("lattice", "Where the lattice begins, its step, and how many steps the asset is long", {}, 0,
               lattice_answer),
        family("to-lattice", "The lattice point nearest to a point of the blob's space, in whole steps",
               {point_word("point")}, 0, steps_answer),
        family("show", "One triangle: its corners, its source, how the surface bends at its edges", {triangle_word()},
               0, show_answer),
        family("fix-internal-edge-normal", "The normal to use for a contact: on an internal edge that of the triangle",
               {triangle_word(),
                name_word("feature", "where the contact is: face, edge_ab, edge_bc, edge_ca, vertex_a, _b or _c"),
                vector_word("normal")},
               0, contact_answer),
        family("triangles", "All triangles with their corners", {}, option_limit | option_from, triangles_answer),
        family("tree", "The nodes of the tree with the boxes of their children, parents first", {}, option_depth,
               tree_answer),
    };
}

}  // namespace espalier::tools
