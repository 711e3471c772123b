#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace d2b {

/// Degrees of fidelity to the trace, from fully regularized to conflict-free: as long as the ends of arcs
/// keep their traced positions, two stretches of the last mode only share points that their traces share.
enum class Form : std::uint8_t {
    walls,    ///< straight walls and circular arcs
    middles,  ///< lines through midpoints of steps, within 0.6 cells of the trace
    close,    ///< same, within 0.45 cells
    cut       ///< the trace with the corners of its staircases cut off at the midpoints of steps
};

/// Mode of each step of a chain. Stretches that conflict with others switch to a closer mode; the rest keeps
/// its walls.
class ChainForm {
  public:
    /// A range of steps of one mode. It may wrap around in a closed chain: last <= first + steps.
    struct Stretch {
        std::size_t first;
        std::size_t last;
        Form form;
    };

    ChainForm() = default;
    ChainForm(std::size_t steps, bool closed) : forms_(steps, Form::walls), closed_(closed) {}

    [[nodiscard]] Form at(std::size_t step) const { return forms_[step % forms_.size()]; }
    /// Least close mode in a range. Steps may be up to twice the number of the chain's; those beyond the ends
    /// of an open chain are ignored.
    [[nodiscard]] Form least(std::size_t first, std::size_t last) const;
    /// Raises a range to the mode next to the least close one in it.
    /// @param margin steps on either side to be raised as well @return false if the mode is the closest
    /// already
    bool follow_closer(std::size_t first, std::size_t last, std::size_t margin);
    /// Raises a range to at least this mode.
    /// @return true if anything has changed
    bool raise(std::size_t first, std::size_t last, std::size_t margin, Form form);
    bool raise_all(Form form) { return raise(0, forms_.size(), 0, form); }
    [[nodiscard]] bool has_walls() const { return std::ranges::find(forms_, Form::walls) != forms_.end(); }
    /// True if every step has the closest mode.
    [[nodiscard]] bool all_cut() const {
        return std::ranges::all_of(forms_, [](Form form) { return form == Form::cut; });
    }
    /// True if the trace is kept on both sides of the point at which a step begins.
    [[nodiscard]] bool cut_around(std::size_t step) const;
    /// Stretches in order, beginning at the first step of an open chain, or at a change of mode in a closed
    /// one. Walls too short to stand between other modes are left out.
    [[nodiscard]] std::vector<Stretch> stretches() const;

  private:
    std::vector<Form> forms_;
    bool closed_ = false;
};

}  // namespace d2b
