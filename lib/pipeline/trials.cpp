#include "pipeline/trials.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "options/run_plan.hpp"

namespace d2b::pipeline {
namespace {

/// Source read into memory as a whole.
class CachedSource final : public DemSource {
  public:
    explicit CachedSource(DemSource& source) : source_(source), info_(source.info()) {
        constexpr std::int32_t least_rows = 64;
        const Window& window = info_.window;
        values_.resize(cells(window.rows));
        const std::int32_t step = std::max(least_rows, info_.block_rows);
        for (std::int32_t row = 0; row < window.rows; row += step) {
            const std::int32_t rows = std::min(step, window.rows - row);
            source.read({window.row + row, window.col, rows, window.cols},
                        std::span(values_).subspan(cells(row), cells(rows)));
        }
    }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(const Window& part, std::span<double> elevations) override {
        const auto left = static_cast<std::size_t>(part.col - info_.window.col);
        const auto cols = static_cast<std::size_t>(part.cols);
        auto to = elevations.begin();
        for (std::int32_t row = part.row; row < part.end_row(); ++row, to += part.cols)
            std::ranges::copy(std::span(values_).subspan(cells(row - info_.window.row) + left, cols), to);
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return source_.take_warnings(); }
    [[nodiscard]] std::int64_t cells_outside_range() const override { return source_.cells_outside_range(); }

  private:
    [[nodiscard]] std::size_t cells(std::int32_t rows) const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(info_.window.cols);
    }

    DemSource& source_;
    DemInfo info_;
    std::vector<double> values_;
};

class NullFeatureSink final : public FeatureSink {
  public:
    void begin(std::span<const LayerSpec> /*layers*/, const Provenance& /*provenance*/) override {}
    void add(std::size_t /*layer*/, const Feature& /*feature*/) override {}
    void finish() override {}
};

using OptionalSource = std::optional<CachedSource>;
void cache(DemSource* source, OptionalSource& cached) {
    if (source != nullptr)
        cached.emplace(*source);
}
DemSource* get(OptionalSource& cached) {
    return cached ? &*cached : nullptr;
}

template <typename T>
std::vector<T> values_or(const std::vector<T>& values, T standard) {
    return values.empty() ? std::vector{standard} : values;
}

std::vector<TrialValues> combinations(const SweepPlan& plan, const Options& options) {
    std::vector<TrialValues> all;
    for (const int lod : values_or(plan.lods, options.levels.lod))
        for (const double detail : values_or(plan.details, detail_of(options)))
            for (const int noise_factor : values_or(plan.noise_factors, options.filter.noise_factor))
                all.push_back({lod, noise_factor, detail});
    return all;
}

}  // namespace

std::vector<Trial> run_trials(const Options& options, const Sources& sources, const SweepPlan& plan,
                              const MakeView& make_view, const Callbacks& callbacks) {
    CachedSource dem(sources.dem);
    OptionalSource terrain;
    OptionalSource mask;
    OptionalSource ndvi;
    cache(sources.terrain, terrain);
    cache(sources.mask, mask);
    cache(sources.ndvi, ndvi);
    const std::vector<TrialValues> all = combinations(plan, options);
    std::vector<Trial> trials;
    std::set<std::string> warned;
    for (const TrialValues& values : all) {
        const auto start = std::chrono::steady_clock::now();
        Options tried = options;
        tried.levels.lod = values.lod;
        tried.levels.detail = values.detail;
        tried.filter.noise_factor = values.noise_factor;
        Callbacks of_trial = callbacks;
        of_trial.on_warning = [&](const std::string& text) {
            if (warned.insert(text).second && callbacks.on_warning)
                callbacks.on_warning(text);
        };
        of_trial.on_progress = [&, done = trials.size()](double share) {
            return !callbacks.on_progress || callbacks.on_progress((static_cast<double>(done) + share) /
                                                                   static_cast<double>(all.size()));
        };
        NullFeatureSink nothing;
        const std::unique_ptr<TrialView> view = make_view ? make_view(nothing, values) : nullptr;
        Sinks sinks{view ? view->features() : nothing};
        sinks.elevations = view ? &view->elevations() : nullptr;
        RunReport report =
            run(tried, {dem, get(terrain), get(mask), get(ndvi), sources.parcels}, sinks, of_trial);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        trials.push_back({values, std::move(report), took.count()});
    }
    return trials;
}

}  // namespace d2b::pipeline
