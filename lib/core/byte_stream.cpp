#include "core/byte_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace d2b {
namespace {

bool is_float(double elevation) {
    return static_cast<double>(static_cast<float>(elevation)) == elevation || std::isnan(elevation);
}

/// Header of a list: the number of elevations and their type.
class ListHeader {
  public:
    explicit ListHeader(ByteReader& reader) : reader_(reader), size_(reader.take_varint()) {
        if (size_ / 2 > reader.left() / (is_narrow() ? sizeof(float) : sizeof(double)))
            throw CorruptRecord("more is announced than there is");
    }
    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(size_ / 2); }
    void take(std::span<double> to) {
        if (is_narrow())
            take_as<float>(to);
        else
            take_as<double>(to);
    }

  private:
    [[nodiscard]] bool is_narrow() const { return size_ % 2 == 1; }
    template <typename Number>
    void take_as(std::span<double> to) {
        const std::span<const std::byte> bytes = reader_.take_bytes(to.size() * sizeof(Number));
        for (std::size_t i = 0; i < to.size(); ++i) {
            Number number{};
            std::memcpy(&number, bytes.data() + i * sizeof(Number), sizeof(Number));
            to[i] = static_cast<double>(number);
        }
    }

    ByteReader& reader_;
    std::uint64_t size_;
};

}  // namespace

void put_elevations(std::span<const double> elevations, ByteWriter& writer) {
    const bool narrow = std::ranges::all_of(elevations, is_float);
    writer.put_varint(2 * elevations.size() + (narrow ? 1 : 0));
    if (!narrow)
        return writer.put_bytes(std::as_bytes(elevations));
    for (const double elevation : elevations)
        writer.put(static_cast<float>(elevation));
}

std::vector<double> take_elevations(ByteReader& reader) {
    ListHeader announced(reader);
    std::vector<double> elevations(announced.count());
    announced.take(elevations);
    return elevations;
}

std::size_t take_elevations(ByteReader& reader, std::span<double> to) {
    ListHeader announced(reader);
    if (announced.count() > to.size())
        throw CorruptRecord("there are more elevations than columns");
    announced.take(to.first(announced.count()));
    return announced.count();
}

}  // namespace d2b
