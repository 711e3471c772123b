#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "core/undeclared_nodata.hpp"

namespace d2b {

inline constexpr std::size_t max_candidates = 8;

/// Differences along the boundary between a value and its neighbours.
struct Contour {
    std::int64_t steps = 0;
    std::int64_t similar = 0;  ///< neighbours that differ by less than a step

    [[nodiscard]] std::int64_t length() const { return steps + similar; }
    void add(double difference, double step) { ++(std::abs(difference) >= step ? steps : similar); }
    void merge(const Contour& other) {
        steps += other.steps;
        similar += other.similar;
    }
    [[nodiscard]] bool is_step(double most) const {
        return static_cast<double>(similar) <= most * static_cast<double>(length());
    }
};

/// Number of cells on a line away from a candidate among which a step is looked for, because cubic resampling
/// overshoots, so that the nearest ones may be close to the candidate.
inline constexpr std::size_t compared_cells = 3;

/// Returns the larger difference.
inline double larger(double one, double other) {
    return std::abs(other) > std::abs(one) ? other : one;
}

/// Returns the largest step on a line from a cell over its neighbour to the cells behind.
/// @param ends true for a cell that ends the line if it lies behind the neighbour
template <typename Ends>
double largest_step(std::span<const double> cells, std::size_t from, std::size_t neighbour,
                    const Ends& ends) {
    const bool right = neighbour > from;
    double step = cells[neighbour] - cells[from];
    for (std::size_t i = 1; i < compared_cells && !ends(neighbour); ++i) {
        from = neighbour;
        if (right ? from + 1 == cells.size() : from == 0)
            break;
        neighbour = right ? from + 1 : from - 1;
        if (ends(neighbour))
            break;
        step = larger(step, cells[neighbour] - cells[from]);
    }
    return step;
}

/// Connected cells (4-neighbours) of one candidate value, of none, or without a value.
struct Region {
    std::uint8_t of = 0;   ///< number of the candidate, from 1; 0: any other value; or that of missing cells
    bool at_edge = false;  ///< of the raster, or of missing cells that reach it
    std::int64_t cells = 0;  ///< valid cells
    Contour contour;         ///< boundary towards candidates, if this is not a candidate itself

    void merge(const Region& other) {
        at_edge = at_edge || other.at_edge;
        cells += other.cells;
        contour.merge(other.contour);
    }
};

/// Differences between neighbours, because a surface that was rounded to large steps has hardly any other
/// difference than its step.
class Differences {
  public:
    void add(double difference, double step);
    void merge(const Differences& other, std::int64_t sign);
    /// Returns the step of a surface that was rounded to at least `step`. 0: it was not.
    [[nodiscard]] double rounding() const;

  private:
    static constexpr double unit = 1e-4;  // of a difference, because floats are slightly off
    static constexpr double largest = 1e9;
    static constexpr std::size_t many = 4096;

    std::int64_t small_ = 0;                      ///< less than the step
    std::map<std::int64_t, std::int64_t> large_;  ///< pairs by difference; not all if these are many
};

/// Values found, and candidates that are elevations. Those are listed only if no land was found, because they
/// may be the land: the ground in whole metres, or level ground.
struct Verdict {
    UndeclaredNodata found;
    std::vector<double> elevations;
    double rounding = 0;  ///< step to which the other values were rounded; 0: less than that of the rules
};

/// Connected components of equal values, fed row by row from first to last.
class ValueRegions {
  public:
    ValueRegions(const std::vector<double>& candidates, double step)
        : candidates_(candidates),
          step_(step),
          beside_others_(candidates.size() + 1),
          differences_(candidates.size() + 1) {}

    void add(std::span<const double> values);
    /// @param min_breadth see UndeclaredNodataRules
    [[nodiscard]] Verdict finish(double min_breadth);

  private:
    struct Run {
        std::size_t begin;
        std::size_t end;
        std::uint32_t region;
    };
    /// Cells of a row, with their classes and regions.
    struct Row {
        std::vector<double> values;
        std::vector<std::uint8_t> classes;
        std::vector<std::uint32_t> regions;
    };
    /// Cells along a row or a column.
    struct Line {
        std::span<const double> values;
        std::span<const std::uint8_t> classes;
        std::span<const std::uint32_t> regions;
    };
    [[nodiscard]] std::uint8_t class_of(double value) const;
    void add_runs(Row& row);
    void join_rows();
    void add_differences(const Row& row);
    void add_difference(std::uint8_t of_one, std::uint8_t of_other, double difference);
    void add_contact(const Line& line, std::size_t first);
    void add_touch(std::uint32_t one, std::uint32_t other);
    void add_contacts_below(std::size_t row);
    /// Returns the candidate that is land because hardly any other value occurs: a flat terrain model. 0:
    /// none.
    [[nodiscard]] std::uint8_t level_land() const;
    [[nodiscard]] bool surrounds_land(std::uint8_t level, double min_breadth) const;
    /// Returns the candidates that are elevations if they do not surround land.
    [[nodiscard]] std::vector<double> elevations() const;
    /// Returns the step to which all values but a candidate were rounded. 0: less than that of the rules.
    [[nodiscard]] double rounding_beside(std::size_t candidate) const;
    /// Merges the regions of a candidate that reach the edge.
    [[nodiscard]] Region at_edge(std::size_t candidate) const;
    /// @param all regions of a candidate that reach the edge
    [[nodiscard]] bool may_be_nodata(const Region& all) const;
    /// Returns true if all other cells have one value as well, and are fewer: these are a hole in level land.
    [[nodiscard]] bool is_larger_than_constant(std::int64_t cells) const {
        return lowest_other_ == highest_other_ && 2 * cells > valid_;
    }

    const std::vector<double>& candidates_;
    double step_;
    std::int64_t valid_ = 0;
    double lowest_other_ =
        std::numeric_limits<double>::infinity();  ///< of cells that have no candidate's value
    double highest_other_ = -std::numeric_limits<double>::infinity();
    std::vector<std::int64_t> beside_others_;  ///< contacts with cells of no candidate, by its number
    std::vector<Differences> differences_;     ///< of pairs with a candidate by its number, and [0] of all
    DisjointSets sets_;
    std::vector<Region> regions_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touches_;  ///< candidates and missing cells
    std::vector<Run> above_;
    std::vector<Run> runs_;
    std::deque<Row> rows_;  ///< the last ones: those on both sides of a boundary that are compared
};

}  // namespace d2b
