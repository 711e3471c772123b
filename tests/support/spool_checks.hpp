#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b::test {

inline std::vector<std::byte> some_bytes(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(size);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random());
    return bytes;
}

/// Entries of many sizes, among them empty and large ones, read back in another order.
inline void expect_gives_back(Spool& spool, std::size_t largest) {
    const std::vector<std::size_t> sizes{3, 0, largest, 1, 1 << 20, 17, largest / 2, 0, 5};
    std::vector<std::uint64_t> begins;
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        begins.push_back(spool.append(some_bytes(sizes[i], static_cast<unsigned>(i))));
        EXPECT_EQ(begins.back(), end);
        end += sizes[i];
    }
    for (std::size_t i = sizes.size(); i-- > 0;) {
        std::vector<std::byte> bytes(sizes[i]);
        spool.read(begins[i], bytes);
        EXPECT_EQ(bytes, some_bytes(sizes[i], static_cast<unsigned>(i))) << i;
    }
}

/// Threads append and read their own bytes, side by side.
inline void expect_serves_threads(Spool& spool) {
    Executor threads(4);
    std::vector<int> wrong(200, 0);
    threads.for_each(wrong.size(), [&](std::size_t i) {
        const auto seed = static_cast<unsigned>(i);
        const std::vector<std::byte> bytes = some_bytes(1000 + 97 * i, seed);
        const std::uint64_t begin = spool.append(bytes);
        std::vector<std::byte> back(bytes.size());
        spool.read(begin, back);
        wrong[i] = back == bytes ? 0 : 1;
    });
    EXPECT_EQ(wrong, std::vector<int>(200, 0));
}

}  // namespace d2b::test
