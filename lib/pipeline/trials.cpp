#include "pipeline/trials.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <deque>
#include <set>
#include <utility>
#include <variant>

#include "elevations/unblended_source.hpp"
#include "options/option_table.hpp"

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

/// Keeps a hash of the features (FNV-1a) instead of the features.
class DigestSink final : public FeatureSink {
  public:
    void begin(std::span<const LayerSpec> /*layers*/, const Provenance& /*provenance*/) override {}
    void add(std::size_t layer, const Feature& feature) override {
        mix(layer);
        for (const FieldValue& value : feature.values)
            std::visit([this](const auto& held) { mix_value(held); }, value);
        for (const WorldPolygon& part : feature.parts) {
            mix_ring(part.exterior);
            for (const WorldRing& ring : part.interiors)
                mix_ring(ring);
        }
    }
    void finish() override {}

    [[nodiscard]] std::uint64_t digest() const { return hash_; }

  private:
    void mix(std::uint64_t number) {
        for (unsigned shift = 0; shift < 64; shift += 8) {
            hash_ ^= number >> shift & 0xFFU;
            hash_ *= 0x100000001b3U;
        }
    }
    void mix_value(std::monostate /*none*/) { mix(0); }
    void mix_value(std::int64_t number) { mix(static_cast<std::uint64_t>(number)); }
    void mix_value(double number) { mix(std::bit_cast<std::uint64_t>(number)); }
    void mix_value(const std::string& text) {
        for (const char letter : text)
            mix(static_cast<unsigned char>(letter));
    }
    void mix_ring(const WorldRing& ring) {
        mix(ring.size());
        for (const Position& position : ring) {
            mix_value(position.x);
            mix_value(position.y);
        }
    }

    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

Options trial_options(const Options& options, const SweepPlan& plan, const std::vector<std::string>& values) {
    Request trial{options, {}};
    for (std::size_t i = 0; i < values.size(); ++i)
        apply_option(*find_option(plan.options[i].name), trial, std::span(&values[i], 1));
    return std::move(trial.options);
}

/// Returns the index of the first value from which on the option's values give the same features, whatever
/// the values of the other options. @param stride distance between trials of successive values
/// @param count number of values
std::size_t first_saturated(const std::vector<Trial>& trials, std::size_t stride, std::size_t count) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const std::size_t value = i / stride % count;
        const std::size_t last = i + (count - 1 - value) * stride;
        if (trials[i].digest != trials[last].digest)
            first = std::max(first, value + 1);
    }
    return first;
}

}  // namespace

std::vector<Trial> run_trials(const Options& options, const Sources& sources, const SweepPlan& plan,
                              const MakeView& make_view, const Callbacks& callbacks) {
    CachedSource dem(sources.dem);
    Sources cached = with_dem(sources, dem);
    std::deque<CachedSource> others;
    for (DemSource** source : {&cached.terrain, &cached.mask, &cached.ndvi, &cached.exclusion})
        if (*source != nullptr)
            *source = &others.emplace_back(**source);
    const std::vector<std::vector<std::string>> all = sweep_values(plan);
    std::vector<Trial> trials;
    std::set<std::string> warned;
    for (const std::vector<std::string>& values : all) {
        const auto start = std::chrono::steady_clock::now();
        const Options tried = trial_options(options, plan, values);
        Callbacks of_trial = callbacks;
        of_trial.on_warning = [&](const std::string& text) {
            if (warned.insert(text).second && callbacks.on_warning)
                callbacks.on_warning(text);
        };
        of_trial.on_progress = [&, done = trials.size()](double share) {
            return !callbacks.on_progress || callbacks.on_progress((static_cast<double>(done) + share) /
                                                                   static_cast<double>(all.size()));
        };
        DigestSink discarded;
        const std::unique_ptr<TrialView> view = make_view ? make_view(discarded, values) : nullptr;
        Sinks sinks{view ? view->features() : discarded};
        sinks.elevations = view ? &view->elevations() : nullptr;
        RunReport report = run(tried, cached, sinks, of_trial);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        trials.push_back({values, std::move(report), took.count(), discarded.digest()});
    }
    return trials;
}

std::vector<Saturation> saturations(const SweepPlan& plan, const std::vector<Trial>& trials) {
    std::vector<Saturation> found;
    std::size_t stride = trials.size();
    for (const SweptOption& option : plan.options) {
        stride /= option.values.size();
        const std::size_t first = first_saturated(trials, stride, option.values.size());
        if (first + 1 < option.values.size())
            found.push_back({option.name, option.values[first], option.values.back()});
    }
    return found;
}

}  // namespace d2b::pipeline
