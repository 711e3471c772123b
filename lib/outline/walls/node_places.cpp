#include "outline/walls/node_places.hpp"

namespace d2b {

FinePoint NodePlaces::at(std::uint32_t node) const {
    const WallGraph::Node& n = graph_.nodes[node];
    return n.owner == WallGraph::nobody ? fine(n.at)
                                        : states_[n.owner].course.node(n.place).value_or(fine(n.at));
}

double NodePlaces::displaced(std::uint32_t node) const {
    return length(shape_.from_fine(at(node), graph_.nodes[node].at));
}

FinePoint NodePlaces::land(std::uint32_t node, const std::optional<Line>& wall) {
    const WallGraph::Node& n = graph_.nodes[node];
    if (n.owner != WallGraph::nobody)
        states_[n.owner].course.place(n.place, wall);
    return at(node);
}

/// Supporting line of the last wall of a chain, relative to the first point of the chain on which it ends.
std::optional<Line> NodePlaces::wall_at_end(std::uint32_t c, bool last) const {
    const Chain& chain = graph_.chains[c];
    const ChainWalls& walls = states_[c].chain->walls();
    const std::uint32_t owner = graph_.nodes[chain.end_node(last)].owner;
    const std::size_t step = last ? chain.node_steps.back() - 1 : 0;
    if (owner == WallGraph::nobody || walls.empty() || states_[c].form.at(step) != Form::walls)
        return {};
    const WallPiece piece = walls.piece(last ? walls.size() - 1 : 0);
    if (piece.circle)
        return {};
    const LatticePoint origin = graph_.chains[owner].trace.front();
    return Line{shape_.from_fine(fine(chain.trace.front()), origin) + piece.line.through, piece.line.along};
}

std::optional<ChainEnds> NodePlaces::land_ends(std::uint32_t c) {
    const Chain& chain = graph_.chains[c];
    if (chain.closed)
        return {};
    return ChainEnds{land(chain.end_node(false), wall_at_end(c, false)),
                     land(chain.end_node(true), wall_at_end(c, true))};
}

}  // namespace d2b
