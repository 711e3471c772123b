#include "outline/walls/chain_form.hpp"

namespace d2b {
namespace {

constexpr std::size_t least_wall = 4;  // fewest steps of a wall between stretches of closer modes

Form next(Form form) {
    return form == Form::cut ? form : static_cast<Form>(static_cast<int>(form) + 1);
}

}  // namespace

Form ChainForm::least(std::size_t first, std::size_t last) const {
    Form least = Form::cut;
    for (std::size_t step = first; step < std::max(last, first + 1); ++step)
        if (closed_ || step < forms_.size())
            least = std::min(least, at(step));
    return least;
}

bool ChainForm::follow_closer(std::size_t first, std::size_t last, std::size_t margin) {
    const Form form = least(first, last);
    return form != Form::cut && raise(first, last, margin, next(form));
}

bool ChainForm::raise(std::size_t first, std::size_t last, std::size_t margin, Form form) {
    const std::size_t n = forms_.size();
    std::size_t begin = 0;
    std::size_t end = n;
    if (!closed_) {
        begin = first - std::min(first, margin);
        end = std::min(last + margin, n);
    } else if (last - first + 2 * margin < n) {
        begin = first + n - margin;
        end = last + n + margin;
    }
    bool changed = false;
    for (std::size_t k = begin; k < end; ++k) {
        Form& own = forms_[k % n];
        changed = changed || own < form;
        own = std::max(own, form);
    }
    return changed;
}

bool ChainForm::cut_around(std::size_t step) const {
    const std::size_t n = forms_.size();
    if (!closed_ && (step == 0 || step >= n))
        return at(step == 0 ? 0 : n - 1) == Form::cut;
    return at(step) == Form::cut && at(step + n - 1) == Form::cut;
}

std::vector<ChainForm::Stretch> ChainForm::stretches() const {
    const std::size_t n = forms_.size();
    std::size_t begin = 0;
    if (closed_)
        while (begin < n && at(begin) == at(begin + n - 1))
            ++begin;
    if (begin == n)
        begin = 0;
    std::vector<Stretch> found;
    for (std::size_t k = begin; k < begin + n; ++k)
        if (found.empty() || found.back().form != at(k))
            found.push_back({k, k + 1, at(k)});
        else
            ++found.back().last;
    std::vector<Stretch> result;
    for (std::size_t i = 0; i < found.size(); ++i) {
        Stretch stretch = found[i];
        if (stretch.form == Form::walls && found.size() > 1 && stretch.last - stretch.first < least_wall)
            stretch.form = Form::middles;
        if (!result.empty() && result.back().form == stretch.form)
            result.back().last = stretch.last;
        else
            result.push_back(stretch);
    }
    return result;
}

}  // namespace d2b
