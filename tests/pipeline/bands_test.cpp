#include <cstdio>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "pipeline/tall_blocks.hpp"

namespace d2b {
namespace {

using test::MemorySink;
using test::MemorySource;

std::string exact(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%a ", value);
    return text.data();
}

void add_ring(std::string& text, const WorldRing& ring) {
    for (const Position& position : ring)
        text += exact(position.x) + exact(position.y);
    text += "| ";
}

/// All that was written, to the last bit.
std::string text_of(const MemorySink& sink) {
    std::string text;
    for (const auto& layer : sink.features)
        for (const Feature& feature : layer) {
            text += "\nfeature " + exact(feature.z);
            for (const FieldValue& value : feature.values)
                if (const auto* number = std::get_if<double>(&value))
                    text += exact(*number);
                else if (const auto* whole = std::get_if<std::int64_t>(&value))
                    text += std::to_string(*whole) + " ";
                else if (const auto* word = std::get_if<std::string>(&value))
                    text += *word + " ";
            for (const WorldPolygon& part : feature.parts) {
                add_ring(text, part.exterior);
                for (const WorldRing& ring : part.interiors)
                    add_ring(text, ring);
            }
        }
    return text;
}

struct Case {
    Preset preset;
    TraceMode mode;
    std::optional<double> interval;  ///< of levels, in place of the preset's
    double detail = 0;
};

class Bands : public testing::TestWithParam<Case> {
  protected:
    /// @param first_row of the window: the first band ends at row 64
    static std::string result(std::int32_t first_row, int threads, const BandSize& size) {
        MemorySource source = test::tall_blocks();
        source.edit().window.row = first_row;
        source.edit().window.rows -= first_row;
        Options options = test::of_preset(GetParam().preset, threads);
        options.trace.mode = GetParam().mode;
        options.levels.interval = GetParam().interval;
        options.levels.detail = GetParam().detail;
        MemorySink sink;
        run(options, {source}, {sink}, {}, size);
        return text_of(sink);
    }
};

TEST_P(Bands, TheirNumberDoesNotShow) {
    for (const std::int32_t first_row : {0, 62, 63}) {
        const std::string whole = result(first_row, 1, {});
        EXPECT_GT(whole.size(), 10000U);
        for (const int threads : {1, 2, 16})
            for (const std::size_t room : {std::size_t{0}, std::size_t{1} << 30})
                EXPECT_TRUE(result(first_row, threads, {0, room}) == whole)
                    << first_row << " " << threads << " " << room;
    }
}

INSTANTIATE_TEST_SUITE_P(, Bands,
                         testing::Values(Case{Preset::thesis, TraceMode::points, {}},
                                         Case{Preset::thesis, TraceMode::points, 0.04},  // counts of 16 bits
                                         Case{Preset::thesis, TraceMode::cells, {}},
                                         Case{Preset::buildings, TraceMode::points, {}},
                                         Case{Preset::buildings, TraceMode::cells, {}},
                                         Case{Preset::buildings, TraceMode::cells, {}, 1}));

}  // namespace
}  // namespace d2b
