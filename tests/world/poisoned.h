// A runner one of whose steps finds bodies beyond all scenes, as a law that fails would leave them: no scene is known to.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"

namespace scree::tests {

template <class Base>
class Poisoned : public Base {
public:
    template <class... Arguments>
    Poisoned(std::vector<std::size_t> bodies, int poisoned_step, float height, Arguments&&... arguments)
        : Base(std::forward<Arguments>(arguments)...),
          bodies_(std::move(bodies)),
          poisoned_step_(poisoned_step),
          height_(height) {}
    void attach(State& state) override {
        state_ = &state;
        Base::attach(state);
    }
    bool step() override {
        if (++steps_ == poisoned_step_)
            for (const std::size_t body : bodies_) poison(body);
        return Base::step();
    }
    bool was_share = false;

private:
    void poison(std::size_t body) {
        was_share = state_->is_share();
        const std::uint32_t row = state_->row_of(body);
        if (row == physics::NONE || (!state_->presence.empty() && !state_->is_owned(row))) return;
        if (!this->in_place()) this->download({{Table::poses, row, 1}});
        state_->poses[row].position.y = height_;
        if (!this->in_place()) this->upload({{Table::poses, row, 1}});
    }

    std::vector<std::size_t> bodies_;
    int poisoned_step_;
    float height_;
    State* state_ = nullptr;
    int steps_ = 0;
};

}  // namespace scree::tests
