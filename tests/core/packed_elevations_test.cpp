#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/byte_stream.hpp"
#include "core/statistics.hpp"

namespace d2b {
namespace {

ByteReader read_again(const ByteWriter& writer) {
    return ByteReader({writer.bytes().begin(), writer.bytes().end()});
}

TEST(Varints, AreReadAsTheyWereWritten) {
    const std::vector<std::uint64_t> values{
        0, 1, 127, 128, 16383, 16384, 1ULL << 40U, std::numeric_limits<std::uint64_t>::max()};
    ByteWriter writer;
    for (const std::uint64_t value : values)
        writer.put_varint(value);
    EXPECT_EQ(writer.bytes().size(), 1U + 1 + 1 + 2 + 2 + 3 + 6 + 10);
    ByteReader reader = read_again(writer);
    for (const std::uint64_t value : values)
        EXPECT_EQ(reader.take_varint(), value);
    EXPECT_THROW((void)reader.take_varint(), CorruptRecord);
}

TEST(Varints, ThatAreTooLargeOrEndlessAreBroken) {
    ByteWriter writer;
    writer.put_varint(300);
    EXPECT_THROW((void)read_again(writer).take_varint(299), CorruptRecord);
    EXPECT_EQ(read_again(writer).take_varint(300), 300);
    const std::vector<std::byte> endless(11, std::byte{0xff});
    EXPECT_THROW((void)ByteReader(endless).take_varint(), CorruptRecord);
}

TEST(PackedElevations, TakeHalfTheRoomWhereNothingIsLost) {
    const double nan = std::nan("");
    for (const auto& [elevations, bytes] :
         {std::pair{std::vector<double>{}, 1U}, std::pair{std::vector<double>{1.5, -3, nan, 0.25}, 1U + 16},
          std::pair{std::vector<double>{1.5, 0.1}, 1U + 16}}) {
        ByteWriter writer;
        put_elevations(elevations, writer);
        EXPECT_EQ(writer.bytes().size(), bytes);
        ByteReader reader = read_again(writer);
        const std::vector<double> again = take_elevations(reader);
        ASSERT_EQ(again.size(), elevations.size());
        for (std::size_t i = 0; i < again.size(); ++i)
            EXPECT_TRUE(again[i] == elevations[i] || (std::isnan(again[i]) && std::isnan(elevations[i])));
        EXPECT_EQ(reader.left(), 0U);
        std::vector<double> room(elevations.size() + 1, 7);
        ByteReader into = read_again(writer);
        EXPECT_EQ(take_elevations(into, room), elevations.size());
        EXPECT_EQ(room.back(), 7);
        EXPECT_TRUE(elevations.empty() || room.front() == elevations.front());
        if (!elevations.empty()) {
            ByteReader too_many = read_again(writer);
            EXPECT_THROW((void)take_elevations(too_many, std::span(room).first(elevations.size() - 1)),
                         CorruptRecord);
        }
    }
    ByteWriter cut;
    cut.put_varint(2 * 5 + 1);
    cut.put(1.0F);
    ByteReader reader = read_again(cut);
    EXPECT_THROW((void)take_elevations(reader), CorruptRecord);
}

/// @return what its percentiles are when it has been read again
std::vector<double> percentiles_again(const ElevationSample& sample, const ElevationRange& range) {
    ByteWriter writer;
    sample.save(writer);
    ByteReader reader = read_again(writer);
    const ElevationSample again = ElevationSample::load(reader);
    EXPECT_EQ(reader.left(), 0U);
    EXPECT_EQ(again.size(), sample.size());
    return again.percentiles({0.1, 0.5, 0.99, 1}, range);
}

TEST(ElevationSamples, AreReadAsTheyWereWritten) {
    const ElevationRange range{-10, 400};
    ElevationSample sample;
    for (int i = 0; i < 200000; ++i) {
        sample.add(-10 + 410.0 * ((i * 7919) % 200003) / 200003, range);
        if (i == 1000 || i == 199999) {
            EXPECT_EQ(percentiles_again(sample, range), sample.percentiles({0.1, 0.5, 0.99, 1}, range));
        }
    }
}

}  // namespace
}  // namespace d2b
