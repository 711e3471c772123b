#include "dem2buildings/commit_list.hpp"

#include <algorithm>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// Joins "Cannot write a.tif: the disk is full." and "\"a.gpkg\" has been changed already" into one sentence.
std::string with_clauses(std::string sentence, const std::string& clauses) {
    if (clauses.empty())
        return sentence;
    if (sentence.ends_with('.'))
        sentence.pop_back();
    return sentence + clauses + ".";
}

}  // namespace

void CommitList::show_all(std::size_t& shown) {
    std::ranges::stable_sort(results_, {}, &PendingResult::kind);
    for (PendingResult* result : results_)
        result->check();
    for (; shown < results_.size(); ++shown)
        results_[shown]->show();
    for (PendingResult* result : results_)
        result->confirm();
}

std::string CommitList::roll_back(std::size_t shown) const {
    std::string clauses;
    for (; shown > 0; --shown)
        if (const std::string left = results_[shown - 1]->roll_back(); !left.empty())
            clauses += "; " + left;
    return clauses;
}

void CommitList::publish(const std::function<void()>& tell) {
    std::size_t shown = 0;
    try {
        show_all(shown);
        if (tell)
            tell();
    } catch (const OutputError& error) {
        throw OutputError(with_clauses(error.what(), roll_back(shown)));
    } catch (...) {
        static_cast<void>(roll_back(shown));
        throw;
    }
    for (PendingResult* result : results_)
        result->keep();
    results_.clear();
}

}  // namespace d2b
