#include "pipeline/tiles/drawn_sequence.hpp"

namespace d2b {

DrawnSequence::DrawnSequence(std::vector<DrawnStream>& streams, FeatureWriter& writer, PartNumbers* parts,
                             std::unique_ptr<Spool> spool)
    : streams_(streams), writer_(writer), parts_(parts), numbers_(std::move(spool), streams.size()) {
    for (std::size_t i = 0; i < streams.size(); ++i)
        if (const auto key = streams[i].key())
            next_.emplace(*key, i);
}

void DrawnSequence::write_before(const std::optional<ContourKey>& end) {
    while (!next_.empty() && (!end || next_.top().first < *end)) {
        const auto [key, i] = next_.top();
        next_.pop();
        if (parts_ != nullptr)
            parts_->set_tile(static_cast<std::int64_t>(i));
        writer_.add(numbers_.of(i), 0, streams_[i].take());
        const auto after = streams_[i].key();
        if (after)
            next_.emplace(*after, i);
        if (!after || after->level != key.level)
            numbers_.put_aside(i);
    }
}

}  // namespace d2b
