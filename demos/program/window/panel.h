// The panel of the window: the clock, the dials, what can be added, and what the selected body is about.
#pragma once

#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/play/interaction.h"

namespace scree::demos {

struct Rates {
    double steps = 0;     // a second of the wall clock
    double pictures = 0;  // a second
};

class Panel {
public:
    // Lays out the panel and the line of a pull, in Dear ImGui's present frame. `color` is a word of color_words(), which the
    // person may change.
    void lay_out(Session& session, Interaction& interaction, const Rates& rates, std::string& color);

    bool shown = true;

private:
    void show_clock(Session& session, Interaction& interaction, const Rates& rates);
    void show_dials(Session& session, Interaction& interaction);
    void show_additions(Interaction& interaction);
    void show_selected(Session& session, Interaction& interaction);
    void show_vehicle(Session& session, Interaction& interaction);
    void show_pull(Interaction& interaction) const;

    std::vector<BodyContact> touching_;  // of the selected body, looked at some times a second
    double looked_at_ = -1;              // s, of Dear ImGui's clock
    std::size_t looked_body_ = 0;
};

}  // namespace scree::demos
