#include "detect/corrections.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <utility>

#include "detect/building_pieces.hpp"
#include "detect/divide_buildings.hpp"

namespace d2b::detect {
namespace {

/// Calls use(index) for the cells of a correction.
template <typename Use>
void for_correction_cells(const SceneCorrection& correction, std::int32_t cols, const Use& use) {
    for (const CellRun& run : correction.cells) {
        const std::size_t first = static_cast<std::size_t>(run.row) * static_cast<std::size_t>(cols);
        for (std::int32_t c = run.begin; c < run.end; ++c)
            use(first + static_cast<std::size_t>(c));
    }
}

bool is_area(const SceneCorrection& correction, CorrectionKind kind) {
    return correction.kind == kind && !correction.is_point;
}

bool is_point(const SceneCorrection& correction, CorrectionKind kind) {
    return correction.kind == kind && correction.is_point;
}

/// Gives cells to the buildings of polygons. Labels of polygons follow those of objects until they are
/// renumbered.
class BuildingMaker {
  public:
    BuildingMaker(const Scene& scene, double min_height, std::int64_t min_cells, Detection& detection)
        : scene_(scene),
          min_height_(static_cast<float>(min_height)),
          min_cells_(min_cells),
          detection_(detection),
          cells_(cells_by_object()),
          merged_(detection.objects.size() + 1),
          changed_(detection.objects.size() + 1) {}

    void add_area(const SceneCorrection& correction) {
        std::map<Label, std::int64_t> met;  // cells by object
        for_correction_cells(correction, scene_.surface.cols,
                             [&](std::size_t i) { ++met[detection_.labels.values[i]]; });
        std::vector<Label> whole;
        std::int64_t size = 0;
        for (const auto& [label, cells] : met)
            if (label != 0 && label <= found() && merged_[label] == 0 && 2 * cells >= cells_[label]) {
                whole.push_back(label);
                size += cells_[label];
            }
        std::vector<std::size_t> taken;
        for_correction_cells(correction, scene_.surface.cols, [&](std::size_t i) {
            const Label label = detection_.labels.values[i];
            const bool is_free =
                label == 0 ? scene_.height(i) > min_height_ : label <= found() && merged_[label] == 0;
            if (is_free && !std::ranges::binary_search(whole, label))
                taken.push_back(i);
        });
        if (size + std::ssize(taken) < min_cells_)
            return;
        detection_.objects.emplace_back();
        const auto own = static_cast<Label>(detection_.objects.size());
        confirm(own);
        for (const Label label : whole)
            merged_[label] = own;
        for (const std::size_t i : taken) {
            Label& label = detection_.labels.values[i];
            changed_[label] = label != 0;
            label = own;
        }
    }
    void add_point(const SceneCorrection& correction) {
        for_correction_cells(correction, scene_.surface.cols, [&](std::size_t i) {
            if (const Label label = label_of(i); label != 0)
                confirm(label);
        });
    }
    /// Makes an object of each connected piece of the changed cells, and drops pieces that are too small.
    void renumber(Executor& threads) {
        std::vector<Label> object_of;
        const Grid<Label> labels = changed_pieces(object_of, threads);
        std::vector<Label> order;  // labels by their first cells
        std::vector<std::int64_t> cells(object_of.size());
        for (const Label label : labels.values)
            if (label != 0 && ++cells[label] == 1)
                order.push_back(label);
        std::vector<Label> number(object_of.size());
        std::vector<DetectedObject> objects;
        for (const bool sure : {true, false}) {
            for (const Label label : order) {
                const Label object = object_of[label];
                const bool is_building =
                    object <= detection_.buildings || detection_.objects[object - 1].confirmed;
                if (is_building != sure)
                    continue;
                objects.push_back(detection_.objects[object - 1]);
                number[label] = static_cast<Label>(objects.size());
                objects.back().cells = cells[label];
                objects.back().whole = number[label];
            }
            if (sure)
                detection_.buildings = static_cast<Label>(objects.size());
        }
        for (std::size_t i = 0; i < labels.size(); ++i)
            detection_.labels.values[i] = number[labels.values[i]];
        detection_.objects = std::move(objects);
    }

  private:
    [[nodiscard]] std::vector<std::int64_t> cells_by_object() const {
        std::vector<std::int64_t> cells(detection_.objects.size() + 1);
        for (const Label label : detection_.labels.values)
            ++cells[label];
        return cells;
    }
    /// Number of objects that detection has found.
    [[nodiscard]] std::size_t found() const { return merged_.size() - 1; }
    [[nodiscard]] Label label_of(std::size_t cell) const {
        const Label label = detection_.labels.values[cell];
        return label <= found() && merged_[label] != 0 ? merged_[label] : label;
    }
    /// Labels the connected pieces of the changed cells after the other objects; 0 where one is too small.
    /// @param[out] object_of object of each label
    [[nodiscard]] Grid<Label> changed_pieces(std::vector<Label>& object_of, Executor& threads) const {
        const auto count = static_cast<Label>(detection_.objects.size());
        Mask in_changed(detection_.labels.rows, detection_.labels.cols);
        for (std::size_t i = 0; i < in_changed.size(); ++i) {
            const Label label = label_of(i);
            in_changed.values[i] = label != 0 && has_changed(label) ? 1 : 0;
        }
        const Regions pieces = joined_regions(
            in_changed, [&](std::size_t i, std::size_t j) { return label_of(i) == label_of(j); }, threads);
        const Grid<Label> piece = piece_grid(pieces, threads);
        object_of.assign(count + pieces.cells.size(), 0);
        for (Label label = 1; label <= count; ++label)
            object_of[label] = label;
        Grid<Label> labels(in_changed.rows, in_changed.cols);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            Label label = label_of(i);
            if (in_changed.values[i] != 0) {
                const Label object = label;
                label = pieces.cells[piece.values[i]] < min_cells_ ? 0 : count + piece.values[i];
                object_of[label] = label == 0 ? 0 : object;
            }
            labels.values[i] = label;
        }
        return labels;
    }
    /// True for a polygon, and for an object that has lost cells to one.
    [[nodiscard]] bool has_changed(Label label) const { return label > found() || changed_[label]; }
    void confirm(Label label) {
        DetectedObject& object = detection_.objects[label - 1];
        object.confirmed = true;
        object.confidence = 1;
    }

    const Scene& scene_;
    float min_height_;
    std::int64_t min_cells_;
    Detection& detection_;
    std::vector<std::int64_t> cells_;  ///< by label of an object that was found
    std::vector<Label> merged_;        ///< label of the polygon that takes an object whole; 0: none
    std::vector<bool> changed_;        ///< by label of an object that was found: it has lost cells
};

/// Returns the object with most cells of each piece; the first one wins ties.
std::vector<Label> main_objects(const Regions& pieces, const Grid<Label>& objects) {
    std::vector<std::map<Label, std::int64_t>> shared(pieces.cells.size());
    for_runs(pieces, [&](std::int32_t r, const RegionRun& run) {
        for (std::int32_t c = run.begin; c < run.end; ++c)
            ++shared[run.label][objects.at(r, c)];
    });
    std::vector<Label> most(pieces.cells.size());
    for (std::size_t piece = 1; piece < most.size(); ++piece)
        if (!shared[piece].empty())
            most[piece] = std::ranges::max_element(shared[piece], {}, [](const auto& entry) {
                              return entry.second;
                          })->first;
    return most;
}

/// Cells of an object.
struct CountedCells {
    std::int64_t all = 0;
    std::int64_t inside = 0;  ///< those in a mask
};

/// @return by label - 1
std::vector<CountedCells> count_cells(const Detection& detection, const Mask& mask, Executor& threads) {
    std::vector<CountedCells> counts(detection.objects.size());
    const Grid<Label>& labels = detection.labels;
    for_rows(threads, labels.rows, labels.cols, [&](std::int32_t r) {
        const auto in_mask = mask.row(r).begin();
        for_equal_runs(labels.row(r), [&](std::int32_t begin, std::int32_t end, Label label) {
            CountedCells& object = counts[label - 1];
            const std::int64_t inside = std::count(in_mask + begin, in_mask + end, std::uint8_t{1});
            std::atomic_ref(object.all).fetch_add(end - begin, std::memory_order_relaxed);
            std::atomic_ref(object.inside).fetch_add(inside, std::memory_order_relaxed);
        });
    });
    return counts;
}

}  // namespace

void confirm_buildings(const Scene& scene, double min_height, std::int64_t min_cells, Detection& detection,
                       Executor& threads) {
    if (std::ranges::find(scene.corrections, CorrectionKind::building, &SceneCorrection::kind) ==
        scene.corrections.end())
        return;
    BuildingMaker maker(scene, min_height, min_cells, detection);
    for (const SceneCorrection& correction : scene.corrections)
        if (is_area(correction, CorrectionKind::building))
            maker.add_area(correction);
    for (const SceneCorrection& correction : scene.corrections)
        if (is_point(correction, CorrectionKind::building))
            maker.add_point(correction);
    maker.renumber(threads);
}

void cut_by_corrections(const Scene& scene, double width_m, std::int64_t min_cells, Detection& detection,
                        Executor& threads) {
    ParcelGrid lines;
    for (const SceneCorrection& correction : scene.corrections)
        for (const CellCut& cut : correction.cuts) {
            if (lines.size() == 0)
                lines = ParcelGrid(scene.surface.rows, scene.surface.cols);
            ParcelCell& cell = lines.at(cut.row, cut.col);
            (cut.below ? cell.cut_below : cell.cut_right) = true;
        }
    if (lines.size() == 0)
        return;
    const Grid<Label> before = detection.labels;
    const Label buildings = detection.buildings;
    const Regions pieces = divide_along(scene, lines, width_m, min_cells, detection, threads);
    const std::vector<Label> objects = main_objects(pieces, detection.labels);
    const Grid<Label> piece = piece_grid(pieces, threads);
    const auto separates = [&](const CellCut& cut) {
        const std::int32_t row = cut.row + (cut.below ? 1 : 0);
        const std::int32_t col = cut.col + (cut.below ? 0 : 1);
        if (row >= before.rows || col >= before.cols)
            return false;
        const Label label = before.at(cut.row, cut.col);
        return label != 0 && label <= buildings && label == before.at(row, col) &&
               objects[piece.at(cut.row, cut.col)] != objects[piece.at(row, col)];
    };
    for (const SceneCorrection& correction : scene.corrections)
        if (std::ranges::any_of(correction.cuts, separates))
            detection.effective_cuts.push_back(correction.index);
}

void mark_left_out(const Mask& where, LeftOut reason, Detection& detection, Executor& threads) {
    const std::vector<CountedCells> counts = count_cells(detection, where, threads);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        DetectedObject& object = detection.objects[i];
        const bool is_decided = object.confirmed || object.left_out == LeftOut::denied;
        if (counts[i].inside > 0 && 2 * counts[i].inside >= counts[i].all &&
            (reason == LeftOut::denied || !is_decided))
            object.left_out = reason;
    }
}

void mark_denied(const Scene& scene, Detection& detection, Executor& threads) {
    Mask areas;
    for (const SceneCorrection& correction : scene.corrections) {
        if (is_area(correction, CorrectionKind::no_building) && areas.size() == 0)
            areas = Mask(scene.surface.rows, scene.surface.cols);
        if (is_area(correction, CorrectionKind::no_building))
            for_correction_cells(correction, areas.cols, [&](std::size_t i) { areas.values[i] = 1; });
        if (is_point(correction, CorrectionKind::no_building))
            for_correction_cells(correction, scene.surface.cols, [&](std::size_t i) {
                if (const Label label = detection.labels.values[i]; label != 0)
                    detection.objects[label - 1].left_out = LeftOut::denied;
            });
    }
    if (areas.size() > 0)
        mark_left_out(areas, LeftOut::denied, detection, threads);
}

std::vector<std::size_t> effective_corrections(const Scene& scene, const Detection& detection,
                                               const Window& own) {
    const auto has_effect = [&](const SceneCorrection& correction) {
        return std::ranges::any_of(correction.cells, [&](const CellRun& run) {
            if (run.row < own.row || run.row >= own.end_row())
                return false;
            for (std::int32_t c = std::max(run.begin, own.col); c < std::min(run.end, own.end_col()); ++c) {
                const Label label = detection.labels.at(run.row, c);
                if (label == 0)
                    continue;
                const DetectedObject& object = detection.objects[label - 1];
                if (correction.kind == CorrectionKind::building ? object.confirmed
                                                                : object.left_out == LeftOut::denied)
                    return true;
            }
            return false;
        });
    };
    std::vector<std::size_t> effective = detection.effective_cuts;
    for (const SceneCorrection& correction : scene.corrections)
        if (has_effect(correction))
            effective.push_back(correction.index);
    return effective;
}

}  // namespace d2b::detect
