#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace d2b::test {

/// A roof over a ring of corners in steps, counter-clockwise.
struct MadeBlock {
    std::string name;
    std::vector<std::pair<std::int64_t, std::int64_t>> ring;
    std::int64_t base = 0;
    std::int64_t top = 0;
};

[[nodiscard]] MadeBlock made_box(const std::string& name, std::int64_t left, std::int64_t low,
                                 std::int64_t right, std::int64_t high, std::int64_t top,
                                 std::int64_t base = 0);

/// 10 m by 5 m and 9 m high, and beside it 5 m by 5 m and 4 m high, 2.5 m of its side against it.
[[nodiscard]] std::vector<MadeBlock> two_boxes();

/// CityJSON with a solid a block: a step is a 16th of a metre, heights are millimetres.
[[nodiscard]] nlohmann::json made_city(const std::vector<MadeBlock>& blocks);

}  // namespace d2b::test
