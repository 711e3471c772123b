#include <limits>

#include <gtest/gtest.h>

#include "core/byte_stream.hpp"

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

}  // namespace
}  // namespace d2b
