// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/refine_plan.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace d2b::mesh {
namespace {

constexpr std::int32_t not_known = -3;
/// Part of a step. Triangles without a longer edge are not divided, because between edges that meet at a very
/// small angle CGAL divides them without end, until their corners lie on one line.
constexpr double shortest_divided = 1.0 / 64;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using InfoFace = CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel>;
using ConstrainedFace = CGAL::Constrained_triangulation_face_base_2<Kernel, InfoFace>;
using DelaunayFace = CGAL::Constrained_Delaunay_triangulation_face_base_2<Kernel, ConstrainedFace>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel, DelaunayFace>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

std::array<Position, 3> corners_of(const Face& face) {
    std::array<Position, 3> corners{};
    for (int i = 0; i < 3; ++i)
        corners[static_cast<std::size_t>(i)] = {face->vertex(i)->point().x(), face->vertex(i)->point().y()};
    return corners;
}

/// Criteria that CGAL applies to each triangle; names are those of its concept MeshingCriteria_2.
class Criteria {
  public:
    struct Quality {
        double too_long = 0;  // more than 1: has to be divided, whatever becomes of angles
        double sine2 = 1;     // of the smallest angle, squared

        bool operator<(const Quality& other) const {
            const bool coarse = too_long > 1;
            if (coarse != (other.too_long > 1))
                return coarse;
            return coarse ? too_long > other.too_long : sine2 < other.sine2;
        }
    };
    class Is_bad {
      public:
        Is_bad(const RefineRules& rules, double bound) : rules_(&rules), bound_(bound) {}
        CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
            if (quality.too_long > 1)
                return CGAL::Mesh_2::IMPERATIVELY_BAD;
            return quality.sine2 < bound_ ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
        }
        CGAL::Mesh_2::Face_badness operator()(const Face& face, Quality& quality) const;

      private:
        const RefineRules* rules_;
        double bound_;
    };

    Criteria(const RefineRules& rules, double angle) : rules_(&rules) {
        // Asks for a little more, because corners are rounded in the end; an eighth is the sure limit.
        const double sine = std::sin(angle * std::numbers::pi / 180);
        constexpr double sure = 0.125;
        bound_ = angle <= sure_angle ? std::min(sure, sine * sine * 1.0003) : sine * sine * 1.0003;
    }
    [[nodiscard]] Is_bad is_bad_object() const { return {*rules_, bound_}; }

  private:
    const RefineRules* rules_;
    double bound_ = 0;
};

CGAL::Mesh_2::Face_badness Criteria::Is_bad::operator()(const Face& face, Quality& quality) const {
    const std::array<Position, 3> at = corners_of(face);
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Position& a = at[i];
        const Position& b = at[(i + 1) % 3];
        squares[i] = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    }
    std::ranges::sort(squares);
    if (squares[2] < shortest_divided * shortest_divided) {
        quality = {};
        return CGAL::Mesh_2::NOT_BAD;
    }
    const double twice_area =
        (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x);
    quality.sine2 = twice_area * twice_area / (squares[1] * squares[2]);
    quality.too_long = rules_->max_edge > 0 ? squares[2] / (rules_->max_edge * rules_->max_edge) : 0;
    if (quality.too_long <= 1 && rules_->too_coarse && rules_->too_coarse(at))
        quality.too_long = 1 + squares[2];
    return operator()(quality);
}

using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

[[noreturn]] void refuse(const Vertex& near) {
    throw PlanFault({near->point().x(), near->point().y()});
}

class PlanRefiner {
  public:
    explicit PlanRefiner(const PlanDrawing& drawing) : drawing_(drawing) {}

    [[nodiscard]] PlanMesh refine(const RefineRules& rules);

  private:
    void insert_nodes();
    void insert_edges();
    void label_faces();
    [[nodiscard]] Face left_face(const Vertex& from, const Vertex& to);
    void seed(const Face& face, std::int32_t region, std::vector<Face>& front);
    void mark_domain();
    [[nodiscard]] PlanMesh take();

    const PlanDrawing& drawing_;
    Triangulation cdt_;
    std::vector<Vertex> vertices_;
};

void PlanRefiner::insert_nodes() {
    // Neighbours one after the other, so that each is found from the last one.
    struct Node {
        Kernel::Point_2 at;
        std::uint32_t index = 0;
    };
    struct Traits {
        using Point_2 [[maybe_unused]] = Node;
        struct Less_x_2 {
            bool operator()(const Node& a, const Node& b) const { return a.at.x() < b.at.x(); }
        };
        struct Less_y_2 {
            bool operator()(const Node& a, const Node& b) const { return a.at.y() < b.at.y(); }
        };
        [[nodiscard]] static Less_x_2 less_x_2_object() { return {}; }
        [[nodiscard]] static Less_y_2 less_y_2_object() { return {}; }
    };
    std::vector<Node> nodes;
    for (const Position& at : drawing_.nodes)
        nodes.push_back({{at.x, at.y}, static_cast<std::uint32_t>(nodes.size())});
    CGAL::hilbert_sort(nodes.begin(), nodes.end(), Traits());
    vertices_.resize(nodes.size());
    Face near;
    for (const Node& node : nodes) {
        const Vertex vertex = cdt_.insert(node.at, near);
        vertices_[node.index] = vertex;
        near = vertex->face();
    }
}

void PlanRefiner::insert_edges() {
    for (const surface::PartitionEdge& edge : drawing_.edges)
        try {
            cdt_.insert_constraint(vertices_[edge.from], vertices_[edge.to]);
        } catch (const Triangulation::Intersection_of_constraints_exception&) {
            refuse(vertices_[edge.from]);
        }
}

/// Face on the left of the first piece of the way between two nodes of an edge.
Face PlanRefiner::left_face(const Vertex& from, const Vertex& to) {
    const auto dx = to->point().x() - from->point().x();
    const auto dy = to->point().y() - from->point().y();
    Face best;
    double nearest = -2;
    Triangulation::Edge_circulator edge = cdt_.incident_edges(from);
    const Triangulation::Edge_circulator first = edge;
    do {
        const auto& [face, i] = *edge;
        if (cdt_.is_infinite(edge) || !cdt_.is_constrained(*edge))
            continue;
        const bool leaves = face->vertex(Triangulation::ccw(i)) == from;
        const Vertex other = face->vertex(leaves ? Triangulation::cw(i) : Triangulation::ccw(i));
        const double ex = other->point().x() - from->point().x();
        const double ey = other->point().y() - from->point().y();
        const double cosine = (ex * dx + ey * dy) / (std::hypot(ex, ey) * std::hypot(dx, dy));
        if (cosine > nearest) {
            nearest = cosine;
            best = leaves ? face : face->neighbor(i);
        }
    } while (++edge != first);
    return best;
}

void PlanRefiner::seed(const Face& face, std::int32_t region, std::vector<Face>& front) {
    if (face->info() == not_known) {
        face->info() = region;
        front.push_back(face);
    } else if (face->info() != region) {
        refuse(face->vertex(cdt_.is_infinite(face->vertex(0)) ? 1 : 0));
    }
}

/// Each face takes the region that the edges around it say, and all have to say the same.
void PlanRefiner::label_faces() {
    for (const Face& face : cdt_.all_face_handles())
        face->info() = not_known;
    const std::int32_t outside = drawing_.with_ground ? beyond : surface::open_ground;
    std::vector<Face> front;
    seed(cdt_.infinite_face(), outside, front);
    for (const surface::PartitionEdge& edge : drawing_.edges) {
        seed(left_face(vertices_[edge.from], vertices_[edge.to]), edge.left, front);
        seed(left_face(vertices_[edge.to], vertices_[edge.from]), edge.right, front);
    }
    while (!front.empty()) {
        const Face face = front.back();
        front.pop_back();
        for (int i = 0; i < 3; ++i)
            if (!face->is_constrained(i))
                seed(face->neighbor(i), face->info(), front);
    }
}

void PlanRefiner::mark_domain() {
    for (const Face& face : cdt_.all_face_handles())
        face->set_in_domain(
            !cdt_.is_infinite(face) &&
            (face->info() >= 0 || (drawing_.with_ground && face->info() == surface::open_ground)));
}

PlanMesh PlanRefiner::refine(const RefineRules& rules) {
    insert_nodes();
    insert_edges();
    if (cdt_.dimension() < 2)
        return {};
    label_faces();
    mark_domain();
    Mesher mesher(cdt_, Criteria(rules, std::min(rules.min_angle, sure_angle)));
    mesher.init(true);
    mesher.refine_mesh();
    if (rules.min_angle > sure_angle) {
        mesher.set_criteria(Criteria(rules, rules.min_angle));
        const std::size_t most = cdt_.number_of_vertices() * most_points_a_point;
        while (cdt_.number_of_vertices() < most && mesher.step_by_step_refine_mesh()) {
        }
    }
    label_faces();
    return take();
}

PlanMesh PlanRefiner::take() {
    std::vector<Vertex> vertices;
    for (const Vertex vertex : cdt_.finite_vertex_handles())
        vertices.push_back(vertex);
    std::ranges::sort(vertices, [](const Vertex& a, const Vertex& b) { return a->point() < b->point(); });
    PlanMesh mesh;
    for (const Vertex& vertex : vertices) {
        vertex->info() = static_cast<std::uint32_t>(mesh.nodes.size());
        mesh.nodes.push_back({vertex->point().x(), vertex->point().y()});
    }
    for (const Face face : cdt_.finite_face_handles()) {
        if (face->info() < 0 && !(drawing_.with_ground && face->info() == surface::open_ground))
            continue;
        PlanTriangle& triangle = mesh.triangles.emplace_back();
        triangle.region = face->info();
        for (int i = 0; i < 3; ++i)
            triangle.nodes[static_cast<std::size_t>(i)] = face->vertex(i)->info();
        std::rotate(triangle.nodes.begin(), std::ranges::min_element(triangle.nodes), triangle.nodes.end());
    }
    std::ranges::sort(mesh.triangles, {}, &PlanTriangle::nodes);
    return mesh;
}

}  // namespace

PlanMesh refine_plan(const PlanDrawing& drawing, const RefineRules& rules) {
    return PlanRefiner(drawing).refine(rules);
}

}  // namespace d2b::mesh
