#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outline/wall_course.hpp"

namespace d2b {

struct WallOptions {
    Walls walls = Walls::automatic;
    double tolerance = 1.5;  ///< cells
    CellShape shape;
};

/// Draws the chains of a graph, those of low rank first; what ends on a chain ends on its drawn form.
class WallDrawing {
  public:
    enum class Form : std::uint8_t {
        fitted,
        joined,  ///< as traced, with ends on the drawn form of the chains that it ends on
        traced   ///< as traced; then the chains that it ends on are as well
    };

    WallDrawing(const WallGraph& graph, const std::vector<Contour>& contours, const WallOptions& options);

    /// Draws the chains of the parts that are named; asks for other forms where a chain cannot have its own.
    void draw(const std::vector<bool>& parts);

    [[nodiscard]] Form form(std::uint32_t chain) const { return states_[chain].form; }
    /// Whether a chain has been asked for another form since it was drawn.
    [[nodiscard]] bool stale(std::uint32_t chain) const {
        return states_[chain].form != states_[chain].drawn;
    }
    [[nodiscard]] const Course& course(std::uint32_t chain) const { return states_[chain].course; }
    /// The next simpler form of a chain, and of those that need one with it. @return false: it is traced
    /// already
    bool simplify(std::uint32_t chain);
    /// A wall of a chain.
    struct Wall {
        std::uint32_t chain;
        std::size_t piece;
        friend auto operator<=>(const Wall&, const Wall&) = default;
    };
    /// The walls of a fitted chain that stand along one of its arcs for the most part, and may still be
    /// moved.
    [[nodiscard]] std::vector<Wall> walls_along(std::uint32_t chain, std::size_t arc) const;
    [[nodiscard]] double length(Wall wall) const;
    /// Moves a wall to the left of its chain when that is drawn next.
    void shift(Wall wall, double cells);
    [[nodiscard]] FinePoint place(std::uint32_t node) const;

  private:
    struct State {
        Form form = Form::fitted;
        Form drawn = Form::fitted;
        std::size_t tried = 0;                ///< prices of walls
        std::vector<WallPiece> pieces;        ///< found when the chain is first drawn
        std::vector<double> shift;            ///< of each, in cells
        std::vector<int> shifts;              ///< how often that has been changed
        std::vector<std::size_t> node_steps;  ///< at which arcs begin, and the last one ends
        double direction = 0;
        Course course;
    };
    void draw_chain(std::uint32_t chain);
    [[nodiscard]] bool fit(std::uint32_t chain, const WallSamples& samples);
    [[nodiscard]] bool plan(std::uint32_t chain, const WallSamples& samples, double price);
    [[nodiscard]] bool join_walls(std::uint32_t chain, const WallSamples& samples);
    [[nodiscard]] double reference_direction(std::uint32_t chain, const WallSamples& samples) const;
    [[nodiscard]] FinePoint land(std::uint32_t node, const std::optional<Line>& wall);
    [[nodiscard]] std::optional<ChainEnds> land_ends(const Chain& chain,
                                                     const std::vector<WallPiece>& pieces);
    [[nodiscard]] DrawnChain as_traced(const Chain& chain, const WallSamples& samples);

    const WallGraph& graph_;
    const std::vector<Contour>& contours_;
    WallOptions options_;
    std::vector<State> states_;
    std::vector<bool> plain_;  ///< nodes that stay nearest to their trace
};

}  // namespace d2b
