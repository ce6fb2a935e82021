// The window's panel: clock, rates, settings, and data of the selected body.
#pragma once

#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/play/interaction.h"

namespace scree::demos {

struct Rates {
    double steps = 0;     // steps per second of wall clock
    double pictures = 0;  // pictures per second
};

class Panel {
public:
    // Lays out the panel and the line of the grab spring in Dear ImGui's current frame. `color` is one of
    // color_words(), which the user may change.
    void lay_out(Session& session, Interaction& interaction, const Rates& rates, std::string& color);

    bool shown = true;

private:
    void show_clock(Session& session, Interaction& interaction, const Rates& rates);
    void show_dials(Session& session, Interaction& interaction);
    void show_additions(Interaction& interaction);
    void show_selected(Session& session, Interaction& interaction);
    void show_vehicle(Session& session, Interaction& interaction);
    void show_pull(Interaction& interaction) const;

    std::vector<BodyContact> touching_;  // contacts of the selected body, updated several times per second
    double looked_at_ = -1;              // time of the update, s of Dear ImGui's clock
    std::size_t looked_body_ = 0;
};

}  // namespace scree::demos
