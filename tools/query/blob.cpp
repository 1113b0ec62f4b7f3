// What a blob holds: its bounds, triangles and nodes, and how its surface bends.
#include "base/choices.hpp"
#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

const Choices<EdgeKind> edge_choices{
    {"flat", EdgeKind::flat}, {"convex", EdgeKind::convex}, {"concave", EdgeKind::concave}, {"open", EdgeKind::open}};

Answer ask_bounds(QueryCall& call) {
    const Blob& blob = call.blob();
    Answer answer(call);
    Record& record = answer.record.title("bounds");
    record.add("box", Box{blob.bounds_min(), blob.bounds_max()});
    if (Sphere sphere; bounding_sphere(blob, sphere)) {
        Record inner(record.as_json());
        record.add("sphere", inner.add("center", sphere.center).add("radius", sphere.radius));
    }
    if (OrientedBox box; oriented_bounds(blob, box)) {
        Record inner(record.as_json());
        inner.add("center", box.center).add("half_axes", box.half_axes);
        record.add("oriented_box", inner);
    }
    if (KDop k_dop; k_dop_bounds(blob, k_dop)) {
        std::vector<Record> slabs;
        for (unsigned i = 0; i < KDop::count; ++i) {
            Record& slab = slabs.emplace_back(record.as_json());
            slab.title(text("along ", shortest(KDop::directions[i]), ": ", k_dop.lo[i], " to ", k_dop.hi[i]));
            slab.add_silently("direction", json_point(KDop::directions[i]));
            slab.add_silently("min", json_number(k_dop.lo[i])).add_silently("max", json_number(k_dop.hi[i]));
        }
        record.add("k_dop", slabs);
    }
    return answer;
}

Answer ask_lattice(QueryCall& call) {
    const Lattice lattice = lattice_of(call.blob());
    Answer answer(call);
    const std::int32_t* extent = lattice.extent;
    answer.record.title(text("lattice of ", extent[0], " x ", extent[1], " x ", extent[2], " steps"));
    answer.record.add_silently("extent", Json::array({extent[0], extent[1], extent[2]}));
    answer.record.add("origin", lattice.origin).add("step", call.blob().step());
    answer.record.add_silently("step_exponent", lattice.step_exponent);
    return answer;
}

Answer ask_steps(QueryCall& call) {
    Steps steps;
    Answer answer(call, to_steps(lattice_of(call.blob()), call.next_vector(), steps));
    answer.record.title(text("steps ", steps.x, ' ', steps.y, ' ', steps.z));
    answer.record.add_silently("steps", Json::array({steps.x, steps.y, steps.z}));
    answer.record.add("point", to_world(lattice_of(call.blob()), steps));
    return answer;
}

void add_corners(Record& record, const Corners& corners) {
    record.add("a", corners.a).add("b", corners.b).add("c", corners.c);
}

Answer ask_show(QueryCall& call) {
    const Triangle triangle = call.next_triangle();
    Answer answer(call);
    answer.record.triangle(call.blob(), triangle);
    if (Corners corners; triangle_corners(call.blob(), triangle, corners)) add_corners(answer.record, corners);
    if (EdgeKinds kinds; edge_kinds(call.blob(), triangle, kinds)) {
        answer.record.add("edge_ab", name_in(edge_choices, kinds.ab)).add("edge_bc", name_in(edge_choices, kinds.bc));
        answer.record.add("edge_ca", name_in(edge_choices, kinds.ca));
    }
    return answer;
}

Feature feature_named(const std::string& name) {
    std::string names;
    for (const auto& choice : feature_choices) {
        if (name == choice.first) return choice.second;
        names += (names.empty() ? "" : ", ") + choice.first;
    }
    throw CommandError(ExitCode::usage, text("feature: '", printable(name), "' is none of ", names, '.'));
}

Answer ask_contact(QueryCall& call) {
    Contact contact;
    contact.triangle = call.next_triangle();
    contact.feature = feature_named(call.next_name());
    contact.normal = call.next_vector();
    Answer answer(call);
    if (!call.blob().has_edge_flags()) {
        throw CommandError(ExitCode::unsupported, text("'", printable(call.options().blob),
                                                       "' carries no edge flags: bake it with --edge-flags."));
    }
    Vec3 normal = contact.normal;
    answer.yes_or_no("on_inner_edge", is_on_inner_edge(call.blob(), contact, normal), "on an inner edge",
                     "not on an inner edge");
    answer.record.add("normal", normal);
    return answer;
}

Answer ask_triangles(QueryCall& call) {
    const QueryArguments& options = call.options();
    Answer answer(call);
    std::uint32_t next = 0;
    for_each_triangle(call.blob(), [&](Triangle triangle, const Corners& corners) {
        if (triangle.index < options.from) return keep_going;
        if (options.limit && answer.list.size() == *options.limit) {
            answer.status = QueryStatus::output_full;
            next = triangle.index;
            return stop;
        }
        add_corners(answer.list.emplace_back(options.json).triangle(call.blob(), triangle), corners);
        return keep_going;
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
        const std::string box = text(", box ", shortest(child.box.min), " to ", shortest(child.box.max));
        if (child.is_leaf) {
            made.title(text(indent, counted(child.count, "triangle"), " from ", child.first.index, box));
            made.add_silently("first", child.first.index).add_silently("triangles", child.count);
        } else {
            made.title(text(indent, "node ", child.node, box)).add_silently("node", child.node);
        }
        made.add_silently("box", json_box(child.box));
    }
    return record.add("children", children);
}

Answer ask_tree(QueryCall& call) {
    Answer answer(call);
    for_each_node(call.blob(), [&](const TreeNode& node) {
        answer.list.push_back(node_record(call, node));
        return node.depth < call.options().depth ? NodeVisit::descend : NodeVisit::skip;
    });
    return answer.counted_list("nodes", "node");
}

}  // namespace

QueryKinds blob_kinds() {
    constexpr const char* family = "What the blob holds";
    return {
        {family, "bounds", "The bounds of the whole asset, those that the blob carries", {}, 0, ask_bounds},
        {family,
         "lattice",
         "Where the lattice begins, its step, and how many steps the asset is long",
         {},
         0,
         ask_lattice},
        {family,
         "steps",
         "The lattice point nearest to a point of the world, in whole steps",
         {point_word("point")},
         0,
         ask_steps},
        {family,
         "show",
         "One triangle: its corners, its source, how the surface bends at its edges",
         {index_word("triangle")},
         0,
         ask_show},
        {family,
         "contact",
         "Whether a contact is on an inner edge, and the normal that it should have",
         {index_word("triangle"), name_word("feature"), vector_word("normal")},
         0,
         ask_contact},
        {family, "triangles", "All triangles with their corners", {}, option_limit | option_from, ask_triangles},
        {family,
         "tree",
         "The nodes of the tree with the boxes of their children, parents first",
         {},
         option_depth,
         ask_tree},
    };
}

}  // namespace espalier::tools
