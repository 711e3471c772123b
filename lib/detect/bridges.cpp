#include "detect/bridges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "core/statistics.hpp"
#include "detect/object_features.hpp"

namespace d2b::detect {
namespace {

// Chosen on 375 long objects of the places in docs/research/places.md, of which three are bridges.
constexpr double shortest_m = 30;
constexpr double least_slenderness = 6;     // length divided by mean width
constexpr double least_straightness = 0.7;  // distance of the ends divided by the length
constexpr double deck_slope = 0.17;         // of nine tenths of the deck
constexpr double end_height = 0.7;          // height of a ramp's end divided by the greatest height
constexpr double highest_ramp_m = 5;        // height of a ramp's end
constexpr double deck_fall = 0.5;           // most of a ramp's fall in height that may come from the deck
constexpr double bank_step_m = 1.5;         // a bank is lower than the deck by at most this
constexpr double lowest_bank_m = 2;         // lower surroundings are the ground itself
constexpr double viaduct_m = 250;
constexpr double viaduct_slenderness = 25;
constexpr double viaduct_straightness = 0.85;
constexpr double viaduct_slope = 0.6;  // cars and masts stand on it
constexpr double bridge_confidence = 0.05;

constexpr double slice_m = 3;
constexpr double beyond_m = 4;  // surroundings of an end

struct Cell {
    std::int32_t row = 0;
    std::int32_t col = 0;
};

/// Step to a neighbour: down, across or along a diagonal.
struct Step {
    std::int32_t down;
    std::int32_t across;
    std::size_t kind;
};
constexpr std::array<Step, 8> steps_to_neighbours{
    {{-1, -1, 2}, {-1, 0, 0}, {-1, 1, 2}, {0, -1, 1}, {0, 1, 1}, {1, -1, 2}, {1, 0, 0}, {1, 1, 2}}};

double median(std::vector<double>& values) {
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : upper_median(values);
}

/// Cells of an object, with the shortest paths between them that stay within it.
class ObjectCells {
  public:
    ObjectCells(const Regions& regions, Label label, const CellBox& box, const CellSize& cell)
        : box_(box), cell_(cell), index_(box.rows() + 2, box.cols() + 2) {
        for (std::int32_t r = box.first_row; r < box.end_row; ++r)
            for (const RegionRun& run : regions.row(r))
                if (run.label == label)
                    for (std::int32_t c = run.begin; c < run.end; ++c) {
                        cells_.push_back({r, c});
                        index_.at(r - box.first_row + 1, c - box.first_col + 1) =
                            static_cast<Label>(cells_.size());
                    }
    }

    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    [[nodiscard]] bool holds(std::int32_t r, std::int32_t c) const {
        return r >= box_.first_row && r < box_.end_row && c >= box_.first_col && c < box_.end_col &&
               number(r, c) != 0;
    }
    [[nodiscard]] double distance_m(std::size_t one, std::size_t other) const {
        return std::hypot((cells_[one].row - cells_[other].row) * cell_.down,
                          (cells_[one].col - cells_[other].col) * cell_.across);
    }
    /// Returns the lengths in m of the shortest paths to each cell, by Dijkstra's algorithm. Steps have three
    /// lengths, so a queue for each of them is sorted by itself, because paths are found in rising order.
    [[nodiscard]] std::vector<double> distances_from(std::size_t first) const {
        using Reached = std::pair<double, std::size_t>;
        const std::array<double, 3> lengths{cell_.down, cell_.across, std::hypot(cell_.down, cell_.across)};
        std::array<std::deque<Reached>, 3> open;
        std::vector<double> distances(cells_.size(), std::numeric_limits<double>::infinity());
        distances[first] = 0;
        open.front().emplace_back(0, first);
        const auto next_length = [](const std::deque<Reached>& queue) {
            return queue.empty() ? std::numeric_limits<double>::infinity() : queue.front().first;
        };
        while (true) {
            std::deque<Reached>& queue = *std::ranges::min_element(open, {}, next_length);
            if (queue.empty())
                return distances;
            const auto [distance, at] = queue.front();
            queue.pop_front();
            if (distance > distances[at])
                continue;
            for (const Step& step : steps_to_neighbours) {
                const Label next = number(cells_[at].row + step.down, cells_[at].col + step.across);
                const double there = distance + lengths[step.kind];
                if (next == 0 || there >= distances[next - 1])
                    continue;
                distances[next - 1] = there;
                open[step.kind].emplace_back(there, next - 1);
            }
        }
    }

  private:
    /// Returns one plus the index of a cell, or 0 if a cell of the box or next to it is outside of the
    /// object.
    [[nodiscard]] Label number(std::int32_t r, std::int32_t c) const {
        return index_.at(r - box_.first_row + 1, c - box_.first_col + 1);
    }

    CellBox box_;
    CellSize cell_;
    std::vector<Cell> cells_;
    Grid<Label> index_;  ///< of the box and the cells next to it
};

std::size_t farthest(const std::vector<double>& distances) {
    return static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
}

/// Part of an object between two distances from one of its ends.
struct Slice {
    std::vector<std::size_t> cells;
    double elevation = 0;  ///< median of the surface in m
    double height = 0;     ///< median height above the terrain in m
};

/// Profile of an object from end to end.
class Profile {
  public:
    Profile(const Scene& scene, const ObjectCells& object) : scene_(scene), object_(object) {
        const std::size_t one_end = farthest(object.distances_from(0));
        const std::vector<double> distances = object.distances_from(one_end);
        const std::size_t other_end = farthest(distances);
        length_ = distances[other_end];
        straightness_ = length_ > 0 ? object.distance_m(one_end, other_end) / length_ : 0;
        const double width = std::max(slice_m, 1.5 * std::max(scene.cell.down, scene.cell.across));
        slices_.resize(std::max<std::size_t>(2, static_cast<std::size_t>(length_ / width)));
        const auto count = static_cast<double>(slices_.size());
        for (std::size_t i = 0; i < distances.size(); ++i)
            slices_[std::min(slices_.size() - 1, static_cast<std::size_t>(distances[i] / length_ * count))]
                .cells.push_back(i);
        for (Slice& slice : slices_)
            measure(slice);
    }

    [[nodiscard]] bool is_bridge() const {
        return length_ >= shortest_m && slenderness() >= least_slenderness &&
               straightness_ >= least_straightness &&
               (is_viaduct() || (is_even(deck_slope) && is_grounded(slices_.front(), slices_[1]) &&
                                 is_grounded(slices_.back(), slices_[slices_.size() - 2])));
    }

  private:
    /// Position in m.
    struct Point {
        double x = 0;
        double y = 0;
    };

    /// Returns the length divided by the mean width.
    [[nodiscard]] double slenderness() const {
        return length_ * length_ / (static_cast<double>(object_.cells().size()) * scene_.cell_area());
    }
    void measure(Slice& slice) const {
        std::vector<double> elevations;
        std::vector<double> heights;
        for (const std::size_t i : slice.cells) {
            const Cell& at = object_.cells()[i];
            const auto z = static_cast<double>(scene_.surface.at(at.row, at.col));
            if (std::isnan(z))
                continue;
            elevations.push_back(z);
            heights.push_back(z - static_cast<double>(scene_.terrain.at(at.row, at.col)));
        }
        slice.elevation = median(elevations);
        slice.height = median(heights);
    }
    /// Both ends are low compared with the highest slice, unlike those of a very long building.
    [[nodiscard]] bool is_viaduct() const {
        return length_ >= viaduct_m && slenderness() >= viaduct_slenderness &&
               straightness_ >= viaduct_straightness && is_even(viaduct_slope) &&
               std::max(slices_.front().height, slices_.back().height) <= end_height * highest().height;
    }
    [[nodiscard]] const Slice& highest() const {
        return *std::ranges::max_element(slices_, {}, &Slice::height);
    }
    /// Slices without valid heights are NaN, for which comparisons are false.
    [[nodiscard]] bool is_even(double slope) const {
        const double most = slope * length_ / static_cast<double>(slices_.size());
        std::size_t even = 0;
        for (std::size_t i = 1; i < slices_.size(); ++i)
            if (std::abs(slices_[i].elevation - slices_[i - 1].elevation) <= most)
                ++even;
        return 10 * even >= 9 * (slices_.size() - 1);
    }
    /// @param inner the slice next to an end
    [[nodiscard]] bool is_grounded(const Slice& end, const Slice& inner) const {
        return is_ramp(end) || meets_bank(end, inner);
    }
    /// True if the terrain rises to the deck. The ends of a roof are low if they are lower parts of the
    /// building.
    [[nodiscard]] bool is_ramp(const Slice& end) const {
        const Slice& top = highest();
        return end.height <= highest_ramp_m && end.height <= end_height * top.height &&
               std::abs(top.elevation - end.elevation) <= deck_fall * (top.height - end.height);
    }
    [[nodiscard]] bool meets_bank(const Slice& end, const Slice& inner) const {
        const double bank = height_beyond(end, inner);
        return bank >= lowest_bank_m &&
               bank >= std::min(end.height, slices_[slices_.size() / 2].height) - bank_step_m;
    }
    /// Returns the median height of the cells beyond an end.
    [[nodiscard]] double height_beyond(const Slice& end, const Slice& inner) const {
        const Point from = centroid(inner);
        const Point to = centroid(end);
        const auto along = [&](std::int32_t r, std::int32_t c) {
            return r * scene_.cell.down * (to.y - from.y) + c * scene_.cell.across * (to.x - from.x);
        };
        double last = -std::numeric_limits<double>::infinity();
        for (const std::size_t i : end.cells)
            last = std::max(last, along(object_.cells()[i].row, object_.cells()[i].col));
        const auto down = static_cast<std::int32_t>(std::ceil(beyond_m / scene_.cell.down));
        const auto across = static_cast<std::int32_t>(std::ceil(beyond_m / scene_.cell.across));
        const MetreGrid& surface = scene_.surface;
        std::vector<double> heights;
        for (const std::size_t i : end.cells) {
            const Cell& at = object_.cells()[i];
            for (std::int32_t r = std::max(at.row - down, 0); r <= std::min(at.row + down, surface.rows - 1);
                 ++r)
                for (std::int32_t c = std::max(at.col - across, 0);
                     c <= std::min(at.col + across, surface.cols - 1); ++c) {
                    const float z = surface.at(r, c);
                    if (along(r, c) > last && !object_.holds(r, c) && !std::isnan(z))
                        heights.push_back(static_cast<double>(z - scene_.terrain.at(r, c)));
                }
        }
        return median(heights);
    }
    /// Returns the mean of the cells in m.
    [[nodiscard]] Point centroid(const Slice& slice) const {
        Point sum;
        for (const std::size_t i : slice.cells) {
            sum.x += object_.cells()[i].col * scene_.cell.across;
            sum.y += object_.cells()[i].row * scene_.cell.down;
        }
        const auto count = static_cast<double>(slice.cells.size());
        return {sum.x / count, sum.y / count};
    }

    const Scene& scene_;
    const ObjectCells& object_;
    double length_ = 0;
    double straightness_ = 0;
    std::vector<Slice> slices_;
};

}  // namespace

void doubt_bridges(const Scene& scene, const Regions& regions, std::span<DetectedObject> objects,
                   Executor& threads) {
    std::vector<ShapeMoments> forms(objects.size());
    for_runs_by_label(threads, regions,
                      [&](std::int32_t r, const RegionRun& run) { forms[run.label - 1].add(r, run); });
    const std::vector<CellBox> boxes = bounding_boxes(regions);
    // A bent strip of the least straightness and slenderness has half the variance of a straight one.
    const auto is_elongated = [&](Label label) {
        const CellBox& box = boxes[label];
        const double area = static_cast<double>(regions.cells[label]) * scene.cell_area();
        return std::hypot(box.rows() * scene.cell.down, box.cols() * scene.cell.across) >=
                   least_straightness * shortest_m &&
               12 * forms[label - 1].largest_variance(scene.cell) >= least_slenderness / 2 * area;
    };
    std::vector<Label> candidates;
    for (Label label = 1; label <= objects.size(); ++label)
        if (objects[label - 1].confidence > bridge_confidence && is_elongated(label))
            candidates.push_back(label);
    threads.for_each(candidates.size(), [&](std::size_t i) {
        const Label label = candidates[i];
        const ObjectCells object(regions, label, boxes[label], scene.cell);
        if (!Profile(scene, object).is_bridge())
            return;
        objects[label - 1].confidence = bridge_confidence;
        objects[label - 1].doubt = CounterEvidence::bridge;
    });
}

}  // namespace d2b::detect
