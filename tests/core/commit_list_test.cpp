#include "dem2buildings/commit_list.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

using Words = std::vector<std::string>;

/// Notes the calls that it receives.
class NotedResult final : public PendingResult {
  public:
    NotedResult(Words& notes, std::string name, Kind kind = Kind::file)
        : notes_(notes), name_(std::move(name)), kind_(kind) {}

    [[nodiscard]] Kind kind() const override { return kind_; }
    void check() override { note("check"); }
    void show() override { note("show"); }
    void confirm() override { note("confirm"); }
    [[nodiscard]] std::string roll_back() override {
        note("back");
        return left;
    }
    void keep() override { note("keep"); }

    std::string fails;  ///< the step that does
    std::string left;   ///< message of roll_back()

  private:
    void note(const std::string& step) {
        notes_.push_back(step + " " + name_);
        if (step == fails)
            throw OutputError("Cannot write " + name_ + ": the disk is full.");
    }
    Words& notes_;
    std::string name_;
    Kind kind_;
};

class CommitListTest : public testing::Test {
  protected:
    std::string refused(const std::function<void()>& tell = {}) {
        return error_of<OutputError>([&] { list_.publish(tell); });
    }
    Words notes_;
    CommitList list_;
};

TEST_F(CommitListTest, ShowsDatabasesFirstThenFilesThenLayersThenStreams) {
    NotedResult layers(notes_, "layers", PendingResult::Kind::dataset);
    NotedResult stream(notes_, "stream", PendingResult::Kind::stream);
    NotedResult one(notes_, "one");
    NotedResult database(notes_, "database", PendingResult::Kind::transaction);
    NotedResult two(notes_, "two");
    for (NotedResult* result : {&layers, &stream, &one, &database, &two})
        list_.add(*result);
    list_.publish([&] { notes_.emplace_back("tell"); });
    EXPECT_EQ(notes_, (Words{"check database", "check one",      "check two",        "check layers",
                             "check stream",   "show database",  "show one",         "show two",
                             "show layers",    "show stream",    "confirm database", "confirm one",
                             "confirm two",    "confirm layers", "confirm stream",   "tell",
                             "keep database",  "keep one",       "keep two",         "keep layers",
                             "keep stream"}));
}

TEST_F(CommitListTest, ShowsNothingWhereOneHasChanged) {
    NotedResult one(notes_, "one");
    NotedResult two(notes_, "two");
    two.fails = "check";
    list_.add(one);
    list_.add(two);
    EXPECT_EQ(refused(), "Cannot write two: the disk is full.");
    EXPECT_EQ(notes_, (Words{"check one", "check two"}));
}

TEST_F(CommitListTest, TakesBackWhatWasShownTheLastFirst) {
    NotedResult one(notes_, "one");
    NotedResult two(notes_, "two");
    NotedResult three(notes_, "three");
    three.fails = "show";
    for (NotedResult* result : {&one, &two, &three})
        list_.add(*result);
    EXPECT_EQ(refused(), "Cannot write three: the disk is full.");
    EXPECT_EQ(notes_, (Words{"check one", "check two", "check three", "show one", "show two", "show three",
                             "back two", "back one"}));
}

TEST_F(CommitListTest, SaysWhatCannotBeTakenBack) {
    NotedResult database(notes_, "database", PendingResult::Kind::transaction);
    NotedResult one(notes_, "one");
    NotedResult two(notes_, "two");
    database.left = "\"database\" has been changed already";
    one.left = "old files of \"one\" lie in \"folder\" now";
    two.fails = "show";
    for (NotedResult* result : {&database, &one, &two})
        list_.add(*result);
    EXPECT_EQ(refused(),
              "Cannot write two: the disk is full; old files of \"one\" lie in \"folder\" now; \"database\" "
              "has been changed already.");
}

TEST_F(CommitListTest, TakesAllBackWhereItCannotBeTold) {
    NotedResult one(notes_, "one");
    NotedResult two(notes_, "two");
    list_.add(one);
    list_.add(two);
    EXPECT_EQ(refused([] { throw OutputError("Cannot write to stdout; make room."); }),
              "Cannot write to stdout; make room.");
    const Words back{"back two", "back one"};
    EXPECT_EQ(Words(notes_.end() - 2, notes_.end()), back);
    EXPECT_THROW(list_.publish([] { throw Cancelled(); }), Cancelled);
    EXPECT_EQ(Words(notes_.end() - 2, notes_.end()), back);
}

}  // namespace
}  // namespace d2b::test
