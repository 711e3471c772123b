#include "elevations/elevation_reader.hpp"

#include <algorithm>
#include <limits>

namespace d2b {
namespace {

constexpr std::int32_t usual_block_rows = 64;
constexpr std::int64_t most_points_a_band = 1 << 21;
// Points per thread. With fewer than three bands threads wait for each other if one takes longer than the
// next.
constexpr std::int64_t points_ahead = 1 << 21;

std::int32_t band_rows(std::int32_t block_rows, std::int32_t cols, std::int64_t points_a_band) {
    std::int32_t block = usual_block_rows;
    if (block_rows > block && std::int64_t{block_rows} * cols <= most_points_a_band)
        block = block_rows;
    const std::int64_t rows = points_a_band / cols / block * block;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(rows, block, std::max(block, 1 << 16)));
}

std::vector<BandShape> shapes_of(const Window& window, std::int32_t rows_a_band) {
    std::vector<BandShape> shapes;
    const std::int32_t end = window.row + window.rows;
    for (std::int32_t row = window.row; row < end;) {
        const std::int64_t border = (std::int64_t{row} / rows_a_band + 1) * rows_a_band;
        const auto next = static_cast<std::int32_t>(std::min<std::int64_t>(end, border));
        shapes.push_back({row, next - row, window.cols});
        row = next;
    }
    return shapes;
}

/// Returns the intersection of a band of whole rows and a window, in rows and columns of the band.
/// @param first_col first column of the band
Window within(const BandShape& band, std::int32_t first_col, const Window& window) {
    const std::int32_t first = std::max(band.first_row, window.row);
    const std::int32_t rows = std::min(band.first_row + band.rows, window.end_row()) - first;
    if (rows <= 0 || window.cols <= 0)
        return {};
    return {first - band.first_row, window.col - first_col, rows, window.cols};
}

/// Hides spikes from their band (as NaN) until the rows beyond it have been read.
class HiddenSpikes {
  public:
    HiddenSpikes(ElevationBand& band, const std::vector<Spike>& spikes) : band_(band), spikes_(spikes) {
        for (const Spike& spike : spikes_)
            at(spike) = std::numeric_limits<double>::quiet_NaN();
    }
    HiddenSpikes(const HiddenSpikes&) = delete;
    HiddenSpikes& operator=(const HiddenSpikes&) = delete;
    ~HiddenSpikes() {
        for (const Spike& spike : spikes_)
            at(spike) = spike.elevation;
    }

  private:
    [[nodiscard]] double& at(const Spike& spike) {
        return band_
            .elevations[static_cast<std::size_t>(spike.row) * static_cast<std::size_t>(band_.shape.cols) +
                        static_cast<std::size_t>(spike.col)];
    }

    ElevationBand& band_;
    const std::vector<Spike>& spikes_;
};

}  // namespace

ElevationReader::ElevationReader(DemSource& source, Context& context, const BandSize& size)
    : source_(source),
      context_(context),
      points_a_band_(size.points),
      cache_(source.info().window, size.keep_bytes) {
    const Window& window = source.info().window;
    const std::int32_t rows = band_rows(source.info().block_rows, std::max(window.cols, 1), size.points);
    ahead_ = static_cast<std::size_t>(
        std::clamp<std::int64_t>(points_ahead / (std::int64_t{rows} * std::max(window.cols, 1)), 3, 8));
    shapes_ = shapes_of(window, rows);
}

Window ElevationReader::whole(const BandShape& rows) const {
    return {rows.first_row, source_.info().window.col, rows.rows, rows.cols};
}

std::size_t ElevationReader::band_with(std::int32_t row) const {
    const auto found = std::ranges::lower_bound(
        shapes_, row, {}, [](const BandShape& shape) { return shape.first_row + (shape.rows - 1); });
    return static_cast<std::size_t>(found - shapes_.begin());
}

ElevationBand ElevationReader::get(const Window& part, std::vector<double>&& buffer, Tally& tally) {
    const StageClock clock(tally, Stage::read);
    const Window& window = source_.info().window;
    ElevationBand band{{part.row, part.rows, part.cols}, {}};
    if (cache_.complete()) {
        band.elevations = std::move(buffer);
        band.elevations.clear();
        band.elevations.reserve(band.shape.size());
    } else {
        band = read(part, std::move(buffer));
        apply_limits(band.elevations, rules_);
    }
    for (std::size_t i = band_with(part.row); i < shapes_.size() && shapes_[i].first_row < part.end_row();
         ++i) {
        const BandShape& kept = shapes_[i];
        const std::int32_t first = std::max(part.row, kept.first_row);
        const std::int32_t end = std::min(part.end_row(), kept.first_row + kept.rows);
        const Window here{first - kept.first_row, part.col - window.col, end - first, part.cols};
        if (cache_.complete())
            cache_.append(i, kept, here, band.elevations);
        if (decisions_)
            decisions_->apply(i, kept.cols, {part.row - kept.first_row, here.col, part.rows, part.cols},
                              band);
    }
    return band;
}

ElevationBand ElevationReader::read(const Window& part, std::vector<double>&& buffer) {
    ElevationBand band{{part.row, part.rows, part.cols}, std::move(buffer)};
    band.elevations.resize(band.shape.size());
    source_.read(part, band.elevations);
    return band;
}

/// Returns the halo. It lies within the band above, because only the first and the last band may have fewer
/// rows than the maximum halo.
ElevationBand ElevationReader::get_above(std::size_t i, std::int32_t halo, Tally& tally) {
    const BandShape& band = shapes_[i];
    const std::int32_t rows = std::min(halo, band.first_row - shapes_.front().first_row);
    const BandShape above{band.first_row - rows, rows, band.cols};
    return rows > 0 ? get(whole(above), {}, tally) : ElevationBand{above, {}};
}

ElevationSurvey ElevationReader::survey(const ValidityRules& rules,
                                        const std::function<void(const ElevationBand&)>& done,
                                        const std::optional<Window>& of) {
    struct Seen {
        SuspiciousValues suspicious;
        ElevationStatistics statistics;
        std::vector<Spike> spikes;
    };
    const Window& window = source_.info().window;
    const Window counted = of.value_or(window);
    rules_ = rules;
    cache_.forget();
    decisions_.emplace(context_.make_spool());
    ElevationSurvey survey{{}, SuspiciousValues(rules), {}};
    SpikeSeams seams;
    std::size_t settled = 0;
    bool first = true;
    pass(
        [this](std::size_t i, Tally& tally) {
            const StageClock clock(tally, Stage::read);
            return read(whole(shapes_[i]), buffers_.take());
        },
        [&](std::size_t, ElevationBand& band, Tally& tally) {
            const StageClock clock(tally, Stage::levels);
            Seen seen{SuspiciousValues(rules), {}, {}};
            const Window part = within(band.shape, window.col, counted);
            const std::vector<ColumnRun> steep = filter_invalid(band, rules, seen.suspicious, part);
            seen.spikes = find_spikes(band, steep, rules.spikes);
            const HiddenSpikes withheld(band, seen.spikes);
            for (std::int32_t row = part.row; row < part.end_row(); ++row)
                seen.statistics.add(band.row(row).subspan(static_cast<std::size_t>(part.col),
                                                          static_cast<std::size_t>(part.cols)));
            return seen;
        },
        [&](const ElevationBand& band, Seen seen) {
            survey.statistics.merge(seen.statistics);
            survey.suspicious.merge(seen.suspicious);
            const std::vector<Spike> before = seams.add(band, std::move(seen.spikes));
            if (!std::exchange(first, false))
                decide_spikes(before, shapes_[settled++].first_row, counted, survey);
            if (!of)
                survey.border.add_rows(band.shape.rows, [&](std::int32_t i) { return band.row(i); });
            done(band);
        });
    decide_spikes(seams.finish(), settled < shapes_.size() ? shapes_[settled].first_row : 0, counted, survey);
    remove_spikes();
    return survey;
}

void ElevationReader::decide_spikes(const std::vector<Spike>& spikes, std::int32_t first_row,
                                    const Window& counted, ElevationSurvey& survey) {
    const Window& window = source_.info().window;
    CellDecisions::Cells cells;
    for (const Spike& spike : spikes) {
        const std::size_t index =
            static_cast<std::size_t>(spike.row) * static_cast<std::size_t>(window.cols) +
            static_cast<std::size_t>(spike.col);
        const bool counts = counted.holds(first_row + spike.row, window.col + spike.col);
        if (!spike.stands_alone() && spike.above(rules_.spikes.invalid_above)) {
            if (counts)
                survey.suspicious.spikes.add(spike.elevation);
            cells.invalid.push_back(index);
            continue;
        }
        if (counts)
            survey.statistics.add(spike.elevation);
        if (!spike.stands_alone() && spike.above(rules_.spikes.not_roof_above)) {
            survey.suspicious.spires += counts ? 1 : 0;
            cells.spires.push_back(index);
        }
    }
    decisions_->append(cells);
}

/// Applies the decisions to the kept elevations, because these are lent unchanged.
void ElevationReader::remove_spikes() {
    for (std::size_t i = 0; cache_.complete() && i < shapes_.size(); ++i)
        cache_.set_invalid(i, shapes_[i], decisions_->invalid(i));
}

MetreGrid ElevationReader::lend(const Window& part) {
    return part == source_.info().window ? cache_.lend() : MetreGrid{};
}

void ElevationReader::for_each(const std::function<void(const ElevationBand&)>& use) {
    for_each([](const ElevationBand&, Tally&) { return 0; },
             [&](const ElevationBand& band, int) { use(band); });
}

void ElevationReader::for_part(const Window& part, const std::function<void(const ElevationBand&)>& use) {
    const std::int32_t rows = band_rows(source_.info().block_rows, std::max(part.cols, 1), points_a_band_);
    const std::vector<BandShape> pieces = shapes_of(part, rows);
    std::vector<Tally> tallies(pieces.size());
    const Merger merger{tallies, context_.report};
    context_.threads->for_each(pieces.size(), [&](std::size_t i) {
        ElevationBand band =
            get({pieces[i].first_row, part.col, pieces[i].rows, part.cols}, buffers_.take(), tallies[i]);
        use(band);
        buffers_.give(std::move(band.elevations));
    });
    buffers_.clear();
}

void ElevationReader::read_part(const Window& part, std::span<double> elevations) {
    for_part(part, [&](const ElevationBand& band) {
        const auto first = std::ptrdiff_t{band.shape.first_row - part.row} * part.cols;
        std::ranges::copy(band.elevations, elevations.begin() + first);
    });
}

std::int64_t most_cells_of(const std::vector<double>& values, ElevationReader& reader) {
    if (values.empty())
        return 0;
    std::vector<std::int64_t> cells(values.size(), 0);
    reader.for_each(
        [&](const ElevationBand& band, Tally&) {
            std::vector<std::int64_t> counts(values.size());
            std::ranges::transform(values, counts.begin(),
                                   [&](double value) { return std::ranges::count(band.elevations, value); });
            return counts;
        },
        [&](const ElevationBand&, const std::vector<std::int64_t>& counts) {
            std::ranges::transform(cells, counts, cells.begin(), std::plus<>());
        });
    return std::ranges::max(cells);
}

}  // namespace d2b
