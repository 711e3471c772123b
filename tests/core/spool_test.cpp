#include "dem2buildings/spool.hpp"

#include <gtest/gtest.h>

#include "core/byte_stream.hpp"
#include "support/spool_checks.hpp"

namespace d2b {
namespace {

TEST(MemorySpool, GivesBackWhatWasAppended) {
    MemorySpool spool;
    test::expect_gives_back(spool, 5'000'000);
}

TEST(MemorySpool, IsThereForSeveralThreads) {
    MemorySpool spool;
    test::expect_serves_threads(spool);
}

TEST(ByteRecord, ValuesComeBackInTheirOrder) {
    MemorySpool spool;
    ByteWriter writer;
    writer.put(std::int32_t{-7});
    writer.put(0.1);
    writer.put_bytes(std::as_bytes(std::span("abc", 3)));
    writer.put(std::uint8_t{255});
    spool.append(std::as_bytes(std::span("before", 6)));
    const SpoolEntry entry = append(spool, writer);
    EXPECT_EQ(entry.begin, 6U);
    EXPECT_EQ(entry.size, 4U + 8 + 3 + 1);
    ByteReader reader(spool, entry);
    EXPECT_EQ(reader.take<std::int32_t>(), -7);
    EXPECT_EQ(reader.take<double>(), 0.1);
    EXPECT_EQ(std::to_integer<char>(reader.take_bytes(3)[1]), 'b');
    EXPECT_EQ(reader.take<std::uint8_t>(), 255);
}

}  // namespace
}  // namespace d2b
