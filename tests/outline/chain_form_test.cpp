#include "outline/walls/chain_form.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

std::vector<Form> forms_of(const ChainForm& form, std::size_t steps) {
    std::vector<Form> forms;
    for (std::size_t step = 0; step < steps; ++step)
        forms.push_back(form.at(step));
    return forms;
}

constexpr Form on_walls = Form::walls;
constexpr Form on_middles = Form::middles;
constexpr Form on_cut = Form::cut;

TEST(ChainForm, FollowsCloserWhereItIsAskedToWithAMargin) {
    ChainForm form(8, false);
    EXPECT_TRUE(form.follow_closer(3, 4, 1));
    EXPECT_EQ(forms_of(form, 8), (std::vector<Form>{on_walls, on_walls, on_middles, on_middles, on_middles,
                                                    on_walls, on_walls, on_walls}));
    // The margin does not go beyond an open chain's ends.
    EXPECT_TRUE(form.follow_closer(7, 8, 2));
    EXPECT_EQ(forms_of(form, 8), (std::vector<Form>{on_walls, on_walls, on_middles, on_middles, on_middles,
                                                    on_middles, on_middles, on_middles}));
    EXPECT_TRUE(form.has_walls());
}

TEST(ChainForm, BringsTheLeastCloseStepsToTheNextForm) {
    ChainForm form(6, false);
    EXPECT_TRUE(form.raise(2, 3, 0, Form::close));
    EXPECT_TRUE(form.follow_closer(1, 4, 0));
    EXPECT_EQ(forms_of(form, 6),
              (std::vector<Form>{on_walls, on_middles, Form::close, on_middles, on_walls, on_walls}));
    EXPECT_EQ(form.least(1, 4), on_middles);
    EXPECT_EQ(form.least(2, 3), Form::close);
}

TEST(ChainForm, EndsWithTheTraceCut) {
    ChainForm form(4, true);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(form.follow_closer(0, 4, 0));
    EXPECT_FALSE(form.follow_closer(0, 4, 0));
    EXPECT_FALSE(form.has_walls());
    EXPECT_EQ(forms_of(form, 4), (std::vector<Form>{on_cut, on_cut, on_cut, on_cut}));
}

TEST(ChainForm, GoesRoundAClosedChain) {
    ChainForm form(10, true);
    EXPECT_TRUE(form.raise(9, 11, 1, on_cut));  // 8 .. 11
    EXPECT_EQ(forms_of(form, 10), (std::vector<Form>{on_cut, on_cut, on_walls, on_walls, on_walls, on_walls,
                                                     on_walls, on_walls, on_cut, on_cut}));
    EXPECT_TRUE(form.cut_around(0));
    EXPECT_TRUE(form.cut_around(1));
    EXPECT_FALSE(form.cut_around(2));
    EXPECT_FALSE(form.cut_around(8));
    const auto stretches = form.stretches();
    ASSERT_EQ(stretches.size(), 2U);
    EXPECT_EQ(stretches[0].first, 2U);
    EXPECT_EQ(stretches[0].last, 8U);
    EXPECT_EQ(stretches[0].form, on_walls);
    EXPECT_EQ(stretches[1].last, 12U);
    EXPECT_EQ(stretches[1].form, on_cut);
}

TEST(ChainForm, LeavesOutWallsThatAreTooShortBetweenOthers) {
    ChainForm form(20, false);
    EXPECT_TRUE(form.raise(5, 8, 0, on_middles));
    EXPECT_TRUE(form.raise(11, 14, 0, on_middles));  // three steps of walls between
    const auto stretches = form.stretches();
    ASSERT_EQ(stretches.size(), 3U);
    EXPECT_EQ(stretches[1].first, 5U);
    EXPECT_EQ(stretches[1].last, 14U);
    EXPECT_EQ(stretches[1].form, on_middles);
}

}  // namespace
}  // namespace d2b
