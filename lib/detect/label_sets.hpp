#pragma once

#include <vector>

#include "core/band.hpp"
#include "core/disjoint_sets.hpp"

namespace d2b {

/// Disjoint sets of labels that turned out to be the same region. The smallest label represents its set.
/// Label 0 is reserved.
class LabelSets {
  public:
    LabelSets() : sets_(1) {}
    Label add() { return sets_.add(); }
    [[nodiscard]] Label find(Label label) { return sets_.find(label); }
    /// @returns the label that represents both
    Label join(Label a, Label b) { return sets_.join(a, b); }
    /// Returns a table from labels to consecutive numbers from 1, one per set, in the order of the
    /// representatives.
    [[nodiscard]] std::vector<Label> numbered() {
        std::vector<Label> number(sets_.size(), 0);
        Label next = 0;
        for (Label i = 1; i < sets_.size(); ++i) {
            const Label first = sets_.find(i);
            number[i] = first == i ? ++next : number[first];
        }
        return number;
    }

  private:
    DisjointSets sets_;
};

}  // namespace d2b
