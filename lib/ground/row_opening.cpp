#include "ground/row_opening.hpp"

#include "core/processors.hpp"
#include "ground/down_pass.hpp"

namespace d2b::ground {
namespace {

template <typename First, typename Second, typename T>
void turn(std::span<T> row) {
    constexpr T from = First::template neutral<T>;
    constexpr T to = Second::template neutral<T>;
    for (T& value : row)
        value = value == from ? to : value;
}

template <typename First, typename Second, typename T>
void open_by(std::span<T> row, std::int32_t radius, OpeningRoom<T>& room) {
    const auto cols = static_cast<std::int32_t>(row.size());
    room.first.resize(row.size());
    along_row<First>(row.data(), cols, radius, room.lines, room.first.data());
    turn<First, Second>(std::span<T>(room.first));
    along_row<Second>(room.first.data(), cols, radius, room.lines, row.data());
}

template <typename T>
void either_open(std::span<T> row, Extremum first, std::int32_t radius, OpeningRoom<T>& room) {
    if (first == Extremum::lowest)
        open_by<Lower, Higher>(row, radius, room);
    else
        open_by<Higher, Lower>(row, radius, room);
}

template <typename T>
void either_turn(std::span<T> row, Extremum from) {
    if (from == Extremum::lowest)
        turn<Lower, Higher>(row);
    else
        turn<Higher, Lower>(row);
}

template <typename T>
void keep(std::span<const T> surface, std::span<T> opened) {
    constexpr T none = no_value_of<T>;
    for (std::size_t j = 0; j < opened.size(); ++j)
        opened[j] = surface[j] == none ? none : opened[j];
}

}  // namespace

D2B_FOR_EACH_PROCESSOR void open_row(std::span<float> row, Extremum first, std::int32_t radius,
                                     OpeningRoom<float>& room) {
    either_open(row, first, radius, room);
}

D2B_FOR_EACH_PROCESSOR void open_row(std::span<std::int16_t> row, Extremum first, std::int32_t radius,
                                     OpeningRoom<std::int16_t>& room) {
    either_open(row, first, radius, room);
}

D2B_FOR_EACH_PROCESSOR void turn_row(std::span<float> row, Extremum from) {
    either_turn(row, from);
}

D2B_FOR_EACH_PROCESSOR void turn_row(std::span<std::int16_t> row, Extremum from) {
    either_turn(row, from);
}

D2B_FOR_EACH_PROCESSOR void keep_gaps(std::span<const float> surface, std::span<float> opened) {
    keep(surface, opened);
}

D2B_FOR_EACH_PROCESSOR void keep_gaps(std::span<const std::int16_t> surface, std::span<std::int16_t> opened) {
    keep(surface, opened);
}

}  // namespace d2b::ground
