#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace d2b {

/// How closely a stretch of a chain follows its trace, from the form that is asked for to the one that is in
/// nobody's way: as long as the ends of arcs stay where they were traced, no two stretches of the last form
/// have a point in common that their traces have not.
enum class Form : std::uint8_t {
    walls,    ///< straight walls and arcs of circles
    middles,  ///< lines through middles of steps, within 0.6 cells of the trace
    close,    ///< the same, within 0.45 cells
    cut       ///< the trace, with the corners of its staircases cut off half-way along their steps
};

/// The form of each step of a chain. Stretches in the way of others take a closer form; the rest keeps its
/// walls.
class ChainForm {
  public:
    /// A stretch of one form, in steps. In a closed chain it may reach round the end: last <= first + steps.
    struct Stretch {
        std::size_t first;
        std::size_t last;
        Form form;
    };

    ChainForm() = default;
    ChainForm(std::size_t steps, bool closed) : forms_(steps, Form::walls), closed_(closed) {}

    [[nodiscard]] Form at(std::size_t step) const { return forms_[step % forms_.size()]; }
    /// Steps of a range count from 0 to twice the chain's; those beyond an open chain's ends are left out.
    [[nodiscard]] Form least(std::size_t first, std::size_t last) const;
    /// Gives a range the next closer form than the least close one in it.
    /// @param margin steps on either side that follow @return false: it has the closest one
    bool follow_closer(std::size_t first, std::size_t last, std::size_t margin);
    /// At least this form for a range.
    /// @return whether anything has changed
    bool raise(std::size_t first, std::size_t last, std::size_t margin, Form form);
    bool raise_all(Form form) { return raise(0, forms_.size(), 0, form); }
    [[nodiscard]] bool has_walls() const { return std::ranges::find(forms_, Form::walls) != forms_.end(); }
    /// Whether all of it has the closest form.
    [[nodiscard]] bool all_cut() const {
        return std::ranges::all_of(forms_, [](Form form) { return form == Form::cut; });
    }
    /// Whether the trace is kept on both sides of the point at which a step begins.
    [[nodiscard]] bool cut_around(std::size_t step) const;
    /// In order; an open chain's from its first step on, a closed one's from where a form ends. Walls that
    /// are too short to stand between others are left out.
    [[nodiscard]] std::vector<Stretch> stretches() const;

  private:
    std::vector<Form> forms_;
    bool closed_ = false;
};

}  // namespace d2b
