#include <gtest/gtest.h>

#include "ground/random_surface.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {
namespace {

template <typename T>
using Pass = void (*)(const Grid<T>&, Grid<T>&, Line, Extremum, std::int32_t);

template <typename T>
void any(const Grid<T>& from, Grid<T>& into, Line line, Extremum which, std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

#ifdef __x86_64__
template <typename T>
__attribute__((target("sse4.2"), flatten)) void second(const Grid<T>& from, Grid<T>& into, Line line,
                                                       Extremum which, std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

template <typename T>
__attribute__((target("avx2"), flatten)) void third(const Grid<T>& from, Grid<T>& into, Line line,
                                                    Extremum which, std::int32_t radius) {
    rank_filter_impl(from, into, line, which, radius);
}

bool supports_second() {
    return __builtin_cpu_supports("sse4.2") != 0;
}
bool supports_third() {
    return __builtin_cpu_supports("avx2") != 0;
}
#endif

template <typename T>
void expect_same(const Grid<T>& grid, Pass<T> pass) {
    for (const Line line : {Line::row, Line::column, Line::right_diagonal, Line::left_diagonal})
        for (const Extremum which : {Extremum::lowest, Extremum::highest})
            for (const std::int32_t radius : {1, 3, 4, 9, 40}) {
                Grid<T> expected(grid.rows, grid.cols);
                Grid<T> found(grid.rows, grid.cols);
                any<T>(grid, expected, line, which, radius);
                pass(grid, found, line, which, radius);
                ASSERT_EQ(found.values, expected.values) << static_cast<int>(line) << " " << radius;
                rank_filter(grid, found, line, which, radius);  // the build of this processor
                ASSERT_EQ(found.values, expected.values) << static_cast<int>(line) << " " << radius;
            }
}

template <typename T>
void expect_same_on_all(const Grid<T>& grid) {
    expect_same<T>(grid, any<T>);
#ifdef __x86_64__
    if (supports_second())
        expect_same<T>(grid, second<T>);
    if (supports_third())
        expect_same<T>(grid, third<T>);
#endif
}

TEST(Processors, GiveTheSameBits) {
    for (const std::int32_t cols : {1, 7, 130, 2100}) {
        MetreGrid grid = test::random_surface(11, 60, cols, 4);
        for (float& z : grid.values)
            z = z == no_value ? z : z * 0.37F - 9;
        expect_same_on_all(grid);
        Grid<std::int16_t> steps(grid.rows, grid.cols);
        for (std::size_t i = 0; i < grid.size(); ++i)
            steps.values[i] = grid.values[i] == no_value ? no_value_of<std::int16_t>
                                                         : static_cast<std::int16_t>(grid.values[i] * 1000);
        expect_same_on_all(steps);
    }
}

}  // namespace
}  // namespace d2b::ground
